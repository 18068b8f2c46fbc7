// The keys of the settings file and where their values live.
#include <fmt/format.h>

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <type_traits>

#include "app/file/text/text.h"
#include "app/ui/state/recent_files.h"
#include "app/ui/state/settings_file.h"

namespace hapticwall::ui {
namespace {

using file::Settings;
using file::SettingValue;

constexpr const char* kRecent = "recent.file_";
constexpr double kMaxPixels = 16384.0;
constexpr double kMaxPanelEms = 60.0;
constexpr double kMinPanelEms = 14.0;
constexpr double kMinShare = 0.1;
constexpr double kMaxShare = 0.9;

struct Key {
  const char* name;
  std::function<SettingValue(const UiState&)> get;
  // Sets the value, or returns a text that says which values are allowed.
  std::function<std::optional<std::string>(UiState&, const SettingValue&)> set;
};

// `place(state)` returns a reference to a number, clamped to [least, most].
template <typename Place>
Key number(const char* name, Place place, double least, double most) {
  return {name,
          [place](const UiState& state) { return SettingValue(static_cast<double>(place(state))); },
          [place, least, most](UiState& state,
                               const SettingValue& value) -> std::optional<std::string> {
            const double* found = std::get_if<double>(&value);
            if (found == nullptr || *found < least || *found > most)
              return fmt::format("must be a number from {} to {}", least, most);
            auto& owner = place(state);
            owner = static_cast<std::remove_reference_t<decltype(owner)>>(*found);
            return std::nullopt;
          }};
}

template <typename Place>
Key flag(const char* name, Place place) {
  return {name,
          [place](const UiState& state) { return SettingValue(static_cast<bool>(place(state))); },
          [place](UiState& state, const SettingValue& value) -> std::optional<std::string> {
            const bool* found = std::get_if<bool>(&value);
            if (found == nullptr) return "must be true or false";
            place(state) = *found;
            return std::nullopt;
          }};
}

template <typename Value>
struct Word {
  std::string_view name;
  Value value;
};

// One of a few words.
template <typename Value, std::size_t kCount, typename Place>
Key word(const char* name, const std::array<Word<Value>, kCount>& words, Place place) {
  return {name,
          [&words, place](const UiState& state) {
            const Value value = place(state);
            for (const Word<Value>& candidate : words) {
              if (candidate.value == value) return SettingValue(std::string(candidate.name));
            }
            return SettingValue(std::string(words.front().name));
          },
          [&words, place](UiState& state, const SettingValue& value) -> std::optional<std::string> {
            std::string names;
            const auto* found = std::get_if<std::string>(&value);
            for (const Word<Value>& candidate : words) {
              if (found != nullptr && *found == candidate.name) {
                place(state) = candidate.value;
                return std::nullopt;
              }
              names += (names.empty() ? "" : ", ") + std::string(candidate.name);
            }
            return "must be one of: " + names;
          }};
}

constexpr std::array kLooks{Word<draw::Look>{"dark", draw::Look::kScreen},
                            Word<draw::Look>{"light", draw::Look::kLight}};
constexpr std::array kArrangementWords{
    Word<PlotArrangement>{"all", PlotArrangement::kAll},
    Word<PlotArrangement>{"figure-4", PlotArrangement::kFigure4},
    Word<PlotArrangement>{"figures-5-6", PlotArrangement::kFigure5And6}};
constexpr std::array kLowerPages{Word<LowerPage>{"plots", LowerPage::kPlots},
                                 Word<LowerPage>{"timing", LowerPage::kTiming},
                                 Word<LowerPage>{"blind-test", LowerPage::kBlindTest}};
constexpr std::array kTriggers{Word<draw::TriggerMode>{"off", draw::TriggerMode::kOff},
                               Word<draw::TriggerMode>{"auto", draw::TriggerMode::kAuto},
                               Word<draw::TriggerMode>{"normal", draw::TriggerMode::kNormal},
                               Word<draw::TriggerMode>{"single", draw::TriggerMode::kSingle}};

template <typename Place>
Key text(const char* name, Place place) {
  return {name, [place](const UiState& state) { return SettingValue(std::string(place(state))); },
          [place](UiState& state, const SettingValue& value) -> std::optional<std::string> {
            const auto* found = std::get_if<std::string>(&value);
            if (found == nullptr) return "must be a string";
            place(state) = *found;
            return std::nullopt;
          }};
}

std::vector<Key> compare_keys() {
  return {
      word(
          "window.lower_page", kLowerPages,
          [](auto& s) -> auto& { return s.persisted.lower_page; }),
      flag(
          "compare.ghost", [](auto& s) -> auto& { return s.compare.persisted.ghost_shown; }),
      text(
          "blind_test.question", [](auto& s) -> auto& { return s.compare.persisted.question; }),
      number(
          "blind_test.trials", [](auto& s) -> auto& { return s.compare.persisted.trials; }, 1.0,
          static_cast<double>(compare::kMaxTrials)),
      number(
          "blind_test.confidence", [](auto& s) -> auto& { return s.compare.persisted.confidence; },
          kMinConfidence, kMaxConfidence)};
}

std::vector<Key> window_setting_keys() {
  constexpr double kMaxPercent = runtime::kMaxScalePercent;
  return {word(
              "window.theme", kLooks, [](auto& s) -> auto& { return s.persisted.look; }),
          number(
              "window.scale_percent", [](auto& s) -> auto& { return s.persisted.scale_percent; },
              0.0, kMaxPercent),
          number(
              "window.width", [](auto& s) -> auto& { return s.persisted.window_width; }, 0.0,
              kMaxPixels),
          number(
              "window.height", [](auto& s) -> auto& { return s.persisted.window_height; }, 0.0,
              kMaxPixels),
          flag(
              "window.maximised", [](auto& s) -> auto& { return s.persisted.window_maximised; }),
          number(
              "window.panel_ems", [](auto& s) -> auto& { return s.persisted.panel_ems; },
              kMinPanelEms, kMaxPanelEms),
          number(
              "window.view_share", [](auto& s) -> auto& { return s.persisted.view_share; },
              kMinShare, kMaxShare),
          number(
              "window.picture_share", [](auto& s) -> auto& { return s.persisted.picture_share; },
              kMinShare, kMaxShare),
          flag(
              "hand.stays_where_released",
              [](auto& s) -> auto& { return s.persisted.hand_stays_where_released; }),
          text(
              "recording.folder", [](auto& s) -> auto& { return s.persisted.recording_folder; })};
}

std::vector<Key> plot_setting_keys() {
  return {number(
              "plots.time_window_s", [](auto& s) -> auto& { return s.persisted.time_window_s; },
              kTimeWindowsS.front(), kTimeWindowsS.back()),
          word(
              "plots.arrangement", kArrangementWords,
              [](auto& s) -> auto& { return s.persisted.arrangement; }),
          flag(
              "plots.loop", [](auto& s) -> auto& { return s.plots.persisted.phase.shown; }),
          flag(
              "plots.loop_of_last_contact",
              [](auto& s) -> auto& { return s.plots.persisted.phase.last_contact; }),
          flag(
              "plots.bounds", [](auto& s) -> auto& { return s.plots.persisted.show_bounds; }),
          word(
              "plots.trigger", kTriggers,
              [](auto& s) -> auto& { return s.plots.persisted.trigger.mode; }),
          number(
              "plots.before_trigger",
              [](auto& s) -> auto& { return s.plots.persisted.trigger.pre_share; }, 0.0, kMaxShare),
          number(
              "wall.magnification", [](auto& s) -> auto& { return s.wall.persisted.magnification; },
              0.0, kMagnifications.back())};
}

// Lines are stored by name, because bit positions change between versions.
std::string names_of(draw::PlotId id, draw::LineSet set) {
  std::string names;
  for (const draw::PlotLine& line : plot_description(id).lines) {
    if ((set & line_bit(line.quantity)) == 0) continue;
    names += (names.empty() ? "" : ", ") + std::string(line.name);
  }
  return names;
}

draw::LineSet lines_called(draw::PlotId id, std::string_view names) {
  draw::LineSet set = 0;
  for (const draw::PlotLine& line : plot_description(id).lines) {
    std::string_view rest = names;
    while (!rest.empty()) {
      const std::size_t comma = std::min(rest.find(", "), rest.size());
      if (rest.substr(0, comma) == line.name) set |= line_bit(line.quantity);
      rest.remove_prefix(std::min(comma + 2, rest.size()));
    }
  }
  return set;
}

Key plot_lines(draw::PlotId id, const char* name) {
  const auto index = static_cast<std::size_t>(id);
  return {name,
          [id, index](const UiState& state) {
            return SettingValue(names_of(id, state.plots.persisted.lines.at(index)));
          },
          [id, index](UiState& state, const SettingValue& value) -> std::optional<std::string> {
            const auto* found = std::get_if<std::string>(&value);
            if (found == nullptr) return "must be a string";
            state.plots.persisted.lines.at(index) = lines_called(id, *found);
            return std::nullopt;
          }};
}

// One set of hidden lines serves all plots.
Key hidden_lines(draw::PlotId id, const char* name) {
  return {name,
          [id](const UiState& state) {
            return SettingValue(names_of(id, state.persisted.hidden_lines));
          },
          [id](UiState& state, const SettingValue& value) -> std::optional<std::string> {
            const auto* found = std::get_if<std::string>(&value);
            if (found == nullptr) return "must be a string";
            state.persisted.hidden_lines |= lines_called(id, *found);
            return std::nullopt;
          }};
}

std::vector<Key> line_keys() {
  return {plot_lines(draw::PlotId::kPosition, "lines.position"),
          plot_lines(draw::PlotId::kForce, "lines.force"),
          plot_lines(draw::PlotId::kStiffness, "lines.stiffness"),
          plot_lines(draw::PlotId::kPassivity, "lines.passivity"),
          hidden_lines(draw::PlotId::kPosition, "hidden_lines.position"),
          hidden_lines(draw::PlotId::kForce, "hidden_lines.force"),
          hidden_lines(draw::PlotId::kStiffness, "hidden_lines.stiffness"),
          hidden_lines(draw::PlotId::kPassivity, "hidden_lines.passivity")};
}

const std::vector<Key>& all_setting_keys() {
  static const std::vector<Key> kKeys = [] {
    std::vector<Key> all = window_setting_keys();
    for (auto&& part : {plot_setting_keys(), line_keys(), compare_keys()})
      all.insert(all.end(), part.begin(), part.end());
    return all;
  }();
  return kKeys;
}

void apply_recent(const Settings& settings, std::vector<std::string>& recent) {
  recent.clear();
  for (std::size_t i = 1; i <= kMaxRecentFiles; ++i) {
    const auto found = settings.find(fmt::format("{}{}", kRecent, i));
    if (found == settings.end()) continue;
    if (const auto* path = std::get_if<std::string>(&found->second)) recent.push_back(*path);
  }
}

}  // namespace

Settings settings_of(const UiState& state) {
  Settings settings;
  for (const Key& key : all_setting_keys()) settings.insert_or_assign(key.name, key.get(state));
  const std::vector<std::string>& recent = state.persisted.recent;
  for (std::size_t i = 0; i < recent.size(); ++i)
    settings.insert_or_assign(fmt::format("{}{}", kRecent, i + 1), recent[i]);
  return settings;
}

std::vector<std::string> apply_settings(const Settings& settings, UiState& state) {
  std::vector<std::string> problems;
  state.persisted.hidden_lines = 0;
  for (const Key& key : all_setting_keys()) {
    const auto found = settings.find(key.name);
    if (found == settings.end()) continue;
    if (const auto problem = key.set(state, found->second))
      problems.push_back(fmt::format("{} {}", key.name, *problem));
  }
  apply_recent(settings, state.persisted.recent);
  return problems;
}

}  // namespace hapticwall::ui
