// The values of the settings file: their places in it and the values that are valid.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>

#include "app/draw/plot/plot_lines.h"
#include "app/file/scene/toml_settings.h"
#include "app/file/text/text.h"
#include "app/ui/state/dock_state.h"
#include "app/ui/state/plots_state.h"
#include "app/ui/state/recent_files.h"
#include "app/ui/state/time_view.h"
#include "app/ui/window/settings_file.h"
#include "core/text.h"

namespace hapticwall::ui {
namespace {

using Json = nlohmann::ordered_json;
using Problem = std::optional<std::string>;  // which values are allowed

constexpr double kMaxPixels = 16384.0;
constexpr double kMaxShare = 0.9;
constexpr int kIndent = 2;

// Limits of a number.
struct Range {
  double least = 0.0;
  double most = 1.0;
};

template <typename Value>
struct Word {
  std::string_view name;
  Value value;
};

struct AnyValue {};
struct SignalName {};
struct LinesOf {
  draw::PlotId plot;
};

constexpr std::array kLooks{Word<draw::Look>{"dark", draw::Look::kScreen},
                            Word<draw::Look>{"light", draw::Look::kLight}};
constexpr std::array kArrangements{
    Word<PlotArrangement>{"two", PlotArrangement::kTwo},
    Word<PlotArrangement>{"all", PlotArrangement::kAll},
    Word<PlotArrangement>{"figure-4", PlotArrangement::kFigure4},
    Word<PlotArrangement>{"figures-5-6", PlotArrangement::kFigure5And6}};
constexpr std::array kTriggers{Word<draw::TriggerMode>{"off", draw::TriggerMode::kOff},
                               Word<draw::TriggerMode>{"auto", draw::TriggerMode::kAuto},
                               Word<draw::TriggerMode>{"normal", draw::TriggerMode::kNormal},
                               Word<draw::TriggerMode>{"single", draw::TriggerMode::kSingle}};

constexpr std::array kPlots{std::pair{"position", draw::PlotId::kPosition},
                            std::pair{"force", draw::PlotId::kForce},
                            std::pair{"stiffness", draw::PlotId::kStiffness},
                            std::pair{"passivity", draw::PlotId::kPassivity}};

// Passes every value to `field`, with its table and key in the file and the rule for it.
template <typename State, typename Field>
void each_value(State& state, const Field& field) {
  auto& plots = state.plots.persisted;
  auto& test = state.compare.persisted;
  field("window", "theme", state.appearance.look, kLooks);
  field("window", "scale_percent", state.appearance.scale_percent,
        Range{0.0, session::kMaxScalePercent});
  field("window", "width", state.window.width, Range{0.0, kMaxPixels});
  field("window", "height", state.window.height, Range{0.0, kMaxPixels});
  field("window", "maximised", state.window.maximised, AnyValue{});
  field("window", "more", state.window.more, AnyValue{});
  field("window", "tour_offered", state.tour.offered, AnyValue{});
  field("window", "layout", state.dock.layout, AnyValue{});
  field("hand", "withdraw_mm_per_s", state.hand.withdraw_mm_per_s, Range{1.0, kMaxWithdrawMmPerS});
  field("recording", "folder", state.recording.chosen_folder, AnyValue{});
  field("recording", "signals", state.recording.chosen_signals, AnyValue{});
  field("plots", "time_window_s", state.time.window_s,
        Range{kTimeWindowsS.front(), kTimeWindowsS.back()});
  field("plots", "time_window_follows", state.time.follows_rhythm, AnyValue{});
  field("plots", "arrangement", plots.arrangement, kArrangements);
  field("plots", "loop", plots.phase.shown, AnyValue{});
  field("plots", "loop_of_last_contact", plots.phase.last_contact, AnyValue{});
  field("plots", "spectrum", plots.spectrum.shown, AnyValue{});
  field("plots", "spectrum_signal", plots.spectrum.quantity, SignalName{});
  field("plots", "bounds", plots.show_bounds, AnyValue{});
  field("plots", "encoder_counts", plots.show_counts, AnyValue{});
  field("plots", "trigger", plots.trigger.mode, kTriggers);
  field("plots", "before_trigger", plots.trigger.pre_share, Range{0.0, kMaxShare});
  for (const auto& [name, id] : kPlots) {
    field("lines", name, plots.lines.at(static_cast<std::size_t>(id)), LinesOf{id});
    field("hidden_lines", name, plots.hidden_lines, LinesOf{id});
  }
  field("wall", "magnification", state.wall.persisted.magnification,
        Range{0.0, kMagnifications.back()});
  field("sound", "volume", state.sound.volume, Range{});
  field("compare", "open", test.open, AnyValue{});
  field("compare", "ghost", test.ghost_shown, AnyValue{});
  field("blind_test", "question", test.question, AnyValue{});
  field("blind_test", "trials", test.trials, Range{1.0, compare::kMaxTrials});
  field("blind_test", "confidence", test.confidence, Range{kMinConfidence, kMaxConfidence});
  field("blind_test", "masking_noise", test.masking_noise, AnyValue{});
}

template <typename Value>
Json written(const Value& value, AnyValue /*any*/) {
  return value;
}

Problem take(const Json& json, bool& value, AnyValue /*any*/) {
  if (!json.is_boolean()) return "must be true or false";
  value = json.get<bool>();
  return std::nullopt;
}

Problem take(const Json& json, std::string& value, AnyValue /*any*/) {
  if (!json.is_string()) return "must be a string";
  value = json.get<std::string>();
  return std::nullopt;
}

template <typename Number>
Json written(Number value, Range /*range*/) {
  return value;
}

template <typename Number>
Problem take(const Json& json, Number& value, Range range) {
  const double found = json.is_number() ? json.get<double>() : range.most + 1.0;
  if (!(found >= range.least && found <= range.most))
    return fmt::format("must be a number from {} to {}", range.least, range.most);
  value = static_cast<Number>(found);
  return std::nullopt;
}

template <typename Value, std::size_t kCount>
Json written(Value value, const std::array<Word<Value>, kCount>& words) {
  const auto found = std::ranges::find(words, value, &Word<Value>::value);
  return (found == words.end() ? words.front() : *found).name;
}

template <typename Value, std::size_t kCount>
Problem take(const Json& json, Value& value, const std::array<Word<Value>, kCount>& words) {
  std::string names;
  for (const Word<Value>& word : words) {
    if (json == word.name) {
      value = word.value;
      return std::nullopt;
    }
    names += (names.empty() ? "" : ", ") + std::string(word.name);
  }
  return "must be one of: " + names;
}

Json written(draw::Quantity quantity, SignalName /*rule*/) {
  const draw::PlotTable table(signal_names());
  const auto found = table.find(quantity);
  return found ? std::string(found->line->name) : "";
}

Problem take(const Json& json, draw::Quantity& quantity, SignalName /*rule*/) {
  const std::string name = json.is_string() ? json.get<std::string>() : "";
  const draw::PlotTable table(signal_names());
  const auto found = table.find(name);
  // A signal that earlier versions derived, "derivative(handle)".
  if (!found && name.ends_with(')')) return std::nullopt;
  if (!found) return "must be the name of a signal";
  quantity = found->line->quantity;
  return std::nullopt;
}

// Lines are stored by name, because bit positions change between versions.
Json written(draw::LineSet set, LinesOf of) {
  const draw::PlotTable table(signal_names());
  std::string names;
  for (const draw::PlotLine& line : table[of.plot].lines) {
    if ((set & line_bit(line.quantity)) == 0) continue;
    names += (names.empty() ? "" : ", ") + std::string(line.name);
  }
  return names;
}

// Replaces the lines of this plot in the set. Drops unknown names.
Problem take(const Json& json, draw::LineSet& set, LinesOf of) {
  if (!json.is_string()) return "must be a string: the names of lines";
  const std::string names = ", " + json.get<std::string>() + ", ";
  const draw::PlotTable table(signal_names());
  for (const draw::PlotLine& line : table[of.plot].lines) {
    const bool named = names.find(fmt::format(", {}, ", line.name)) != std::string::npos;
    const draw::LineSet bit = line_bit(line.quantity);
    set = named ? set | bit : set & ~bit;
  }
  return std::nullopt;
}

Problem take_recent(const Json& json, std::vector<std::string>& recent) {
  if (!json.is_array()) return "must be a list of paths";
  recent.clear();
  for (const Json& path : json) {
    if (!path.is_string()) return "must be a list of paths";
    if (recent.size() < kMaxRecentFiles) recent.push_back(path.get<std::string>());
  }
  return std::nullopt;
}

Problem take_docked(const Json& json, std::string& docked) {
  const std::string text = json.is_string() ? json.get<std::string>() : "(";
  if (!text.empty() && !parse_layout(text))
    return "is damaged: the windows are as the layout has them";
  docked = text;
  return std::nullopt;
}

std::vector<std::string> take_own_layouts(const Json& json, std::vector<OwnLayout>& own) {
  std::vector<std::string> problems;
  own.clear();
  for (const auto& [name, text] : json.items()) {
    const auto layout =
        text.is_string() ? parse_layout(text.get<std::string>()) : std::optional<DockLayout>();
    if (layout && !name.empty()) {
      own.push_back({name, *layout});
    } else {
      problems.push_back(fmt::format("layouts.{} is damaged: this layout is left out", name));
    }
  }
  return problems;
}

Json json_of(const UiState& state) {
  Json json;
  each_value(state, [&](const char* table, const char* key, const auto& value, const auto& rule) {
    json[table][key] = written(value, rule);
  });
  json["window"]["docked"] = state.dock.docked;
  json["recent"] = state.scene.recent;
  json["layouts"] = Json::object();
  for (const OwnLayout& each : state.dock.own_layouts)
    json["layouts"][each.name] = layout_text(each.layout);
  return json;
}

// Text as a file may hold it: a path may hold any bytes, JSON only UTF-8.
void drop_broken_text(Json& json) {
  for (auto value = json.begin(); value != json.end();) {
    const auto* text = value->get_ptr<const std::string*>();
    if (text != nullptr && !is_utf8(*text)) {
      value = json.erase(value);
      continue;
    }
    if (value->is_structured()) drop_broken_text(*value);
    ++value;
  }
}

std::vector<std::string> unknown_keys(const Json& json, const Json& known) {
  std::vector<std::string> problems;
  for (const auto& [table, values] : json.items()) {
    if (!known.contains(table)) {
      problems.push_back(table + " is unknown");
    } else if (known[table].is_object() && !values.is_object()) {
      problems.push_back(table + " must be an object");
    } else if (values.is_object() && table != "layouts") {
      for (const auto& each : values.items()) {
        if (!known[table].contains(each.key()))
          problems.push_back(fmt::format("{}.{} is unknown", table, each.key()));
      }
    }
  }
  return problems;
}

// Takes every valid value; returns a line for each invalid one.
std::vector<std::string> take_values(const Json& json, UiState& state) {
  std::vector<std::string> problems;
  const auto take_with = [&](std::string_view table, std::string_view key, const auto& take_it) {
    if (!json.contains(table) || !json[table].is_object() || !json[table].contains(key)) return;
    if (const Problem problem = take_it(json[table][key]))
      problems.push_back(fmt::format("{}.{} {}", table, key, *problem));
  };
  each_value(state, [&](const char* table, const char* key, auto& value, const auto& rule) {
    take_with(table, key, [&](const Json& found) { return take(found, value, rule); });
  });
  take_with("window", "docked",
            [&](const Json& found) { return take_docked(found, state.dock.docked); });
  if (json.contains("recent")) {
    if (const Problem problem = take_recent(json["recent"], state.scene.recent))
      problems.push_back("recent " + *problem);
  }
  if (json.contains("layouts") && json["layouts"].is_object())
    std::ranges::move(take_own_layouts(json["layouts"], state.dock.own_layouts),
                      std::back_inserter(problems));
  return problems;
}

// Replaces the keys that earlier versions counted: recent.file_1, and layouts.own_01 = "NAME:
// TEXT".
void modernise(Json& json) {
  const Json counted_files = json.value("recent", Json::object());
  const Json counted_layouts = json.value("layouts", Json::object());
  Json recent = Json::array();
  Json layouts = Json::object();
  for (const Json& path : counted_files) {
    if (path.is_string()) recent.push_back(path);
  }
  for (const Json& each : counted_layouts) {
    const std::string kept = each.is_string() ? each.get<std::string>() : "";
    const std::size_t end = kept.rfind(": ");
    if (end != std::string::npos) layouts[kept.substr(0, end)] = kept.substr(end + 2);
  }
  json["recent"] = recent;
  json["layouts"] = layouts;
}

}  // namespace

std::string settings_text(const UiState& state) {
  Json json = json_of(state);
  drop_broken_text(json);
  return json.dump(kIndent) + "\n";
}

Result<std::vector<std::string>> apply_settings(std::string_view text, const std::string& origin,
                                                UiState& state) {
  try {
    const Json json = Json::parse(text);
    if (!json.is_object()) return usage_error(origin + ": not a JSON object");
    std::vector<std::string> problems = take_values(json, state);
    std::ranges::move(unknown_keys(json, json_of(UiState())), std::back_inserter(problems));
    return problems;
  } catch (const Json::parse_error& error) {
    const auto before = text.substr(0, std::min(error.byte, text.size()));
    return usage_error(
        fmt::format("{}:{}: not JSON", origin, 1 + std::ranges::count(before, '\n')));
  }
}

Result<std::vector<std::string>> apply_old_settings(std::string_view text,
                                                    const std::string& origin, UiState& state) {
  const Result<std::string> found = file::json_of_toml_settings(text, origin);
  if (!found) return found.error();
  Json json = Json::parse(*found);
  modernise(json);
  return take_values(json, state);
}

}  // namespace hapticwall::ui
