// The keys of the settings file and where their values live.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>

#include "app/draw/plot/plot_lines.h"
#include "app/file/text/text.h"
#include "app/ui/state/recent_files.h"
#include "app/ui/state/settings_file.h"

namespace hapticwall::ui {
namespace {

using file::Settings;
using file::SettingValue;

constexpr const char* kRecent = "recent.file_";
constexpr const char* kOwnLayout = "layouts.own_";
constexpr double kMaxPixels = 16384.0;
constexpr double kMaxShare = 0.9;

struct Key {
  const char* name;
  std::function<SettingValue(const UiState&)> get;
  // Sets the value, or returns a text that says which values are allowed.
  std::function<std::optional<std::string>(UiState&, const SettingValue&)> set;
};

// The part of the state that holds these settings; every part exists once.
template <typename Part>
auto& part(auto& state) {
  if constexpr (std::is_same_v<Part, PersistedState>) {
    return state.persisted;
  } else if constexpr (std::is_same_v<Part, CompareState::Persisted>) {
    return state.compare.persisted;
  } else if constexpr (std::is_same_v<Part, WallState::Persisted>) {
    return state.wall.persisted;
  } else if constexpr (std::is_same_v<Part, PlotsState::Persisted>) {
    return state.plots.persisted;
  } else if constexpr (std::is_same_v<Part, draw::PhaseSettings>) {
    return state.plots.persisted.phase;
  } else if constexpr (std::is_same_v<Part, draw::SpectrumSettings>) {
    return state.plots.persisted.spectrum;
  } else {
    static_assert(std::is_same_v<Part, draw::TriggerSettings>);
    return state.plots.persisted.trigger;
  }
}

// A number from `least` to `most`.
template <typename Part, typename Number>
Key number(const char* name, Number Part::*member, double least, double most) {
  return {name,
          [member](const UiState& state) {
            return SettingValue(static_cast<double>(part<Part>(state).*member));
          },
          [=](UiState& state, const SettingValue& value) -> std::optional<std::string> {
            const double* found = std::get_if<double>(&value);
            if (found == nullptr || *found < least || *found > most)
              return fmt::format("must be a number from {} to {}", least, most);
            part<Part>(state).*member = static_cast<Number>(*found);
            return std::nullopt;
          }};
}

template <typename Part>
Key flag(const char* name, bool Part::*member) {
  return {name, [member](const UiState& state) { return SettingValue(part<Part>(state).*member); },
          [member](UiState& state, const SettingValue& value) -> std::optional<std::string> {
            const bool* found = std::get_if<bool>(&value);
            if (found == nullptr) return "must be true or false";
            part<Part>(state).*member = *found;
            return std::nullopt;
          }};
}

Key text(const char* name, const std::function<std::string(const UiState&)>& get,
         const std::function<void(UiState&, const std::string&)>& set) {
  return {name, [get](const UiState& state) { return SettingValue(get(state)); },
          [set](UiState& state, const SettingValue& value) -> std::optional<std::string> {
            const auto* found = std::get_if<std::string>(&value);
            if (found == nullptr) return "must be a string";
            set(state, *found);
            return std::nullopt;
          }};
}

template <typename Part>
Key text(const char* name, std::string Part::*member) {
  return text(
      name, [member](const UiState& state) { return part<Part>(state).*member; },
      [member](UiState& state, const std::string& value) { part<Part>(state).*member = value; });
}

template <typename Value>
struct Word {
  std::string_view name;
  Value value;
};

// One of a few words.
template <typename Part, typename Value, std::size_t kCount>
Key word(const char* name, const std::array<Word<Value>, kCount>& words, Value Part::*member) {
  return {
      name,
      [&words, member](const UiState& state) {
        const Value value = part<Part>(state).*member;
        for (const Word<Value>& candidate : words) {
          if (candidate.value == value) return SettingValue(std::string(candidate.name));
        }
        return SettingValue(std::string(words.front().name));
      },
      [&words, member](UiState& state, const SettingValue& value) -> std::optional<std::string> {
        std::string names;
        const auto* found = std::get_if<std::string>(&value);
        for (const Word<Value>& candidate : words) {
          if (found != nullptr && *found == candidate.name) {
            part<Part>(state).*member = candidate.value;
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
    Word<PlotArrangement>{"two", PlotArrangement::kTwo},
    Word<PlotArrangement>{"all", PlotArrangement::kAll},
    Word<PlotArrangement>{"figure-4", PlotArrangement::kFigure4},
    Word<PlotArrangement>{"figures-5-6", PlotArrangement::kFigure5And6}};
constexpr std::array kTriggers{Word<draw::TriggerMode>{"off", draw::TriggerMode::kOff},
                               Word<draw::TriggerMode>{"auto", draw::TriggerMode::kAuto},
                               Word<draw::TriggerMode>{"normal", draw::TriggerMode::kNormal},
                               Word<draw::TriggerMode>{"single", draw::TriggerMode::kSingle}};

std::string spectrum_signal(const UiState& state) {
  const draw::PlotTable table(signal_names());
  const auto found = table.find(state.plots.persisted.spectrum.quantity);
  return found ? found->line->name : "";
}

std::optional<std::string> take_spectrum_signal(UiState& state, const SettingValue& value) {
  const auto* name = std::get_if<std::string>(&value);
  const draw::PlotTable table(signal_names());
  const auto found = name != nullptr ? table.find(*name) : std::nullopt;
  // A signal that version 0.1.0 derived, "derivative(handle)".
  if (!found && name != nullptr && name->ends_with(')')) return std::nullopt;
  if (!found) return "must be the name of a signal";
  state.plots.persisted.spectrum.quantity = found->line->quantity;
  return std::nullopt;
}

Key docked() {
  Key key = text("window.docked", &PersistedState::docked);
  key.set = [set = key.set](UiState& state, const SettingValue& value) {
    const auto* arranged = std::get_if<std::string>(&value);
    const bool damaged = arranged != nullptr && !arranged->empty() && !parse_layout(*arranged);
    return damaged
               ? std::optional<std::string>("is damaged: the windows are as the layout has them")
               : set(state, value);
  };
  return key;
}

std::vector<Key> plain_keys() {
  using Compare = CompareState::Persisted;
  using Plots = PlotsState::Persisted;
  constexpr double kMaxPercent = runtime::kMaxScalePercent;
  return {
      word("window.theme", kLooks, &PersistedState::look),
      number("window.scale_percent", &PersistedState::scale_percent, 0.0, kMaxPercent),
      number("window.width", &PersistedState::window_width, 0.0, kMaxPixels),
      number("window.height", &PersistedState::window_height, 0.0, kMaxPixels),
      flag("window.maximised", &PersistedState::window_maximised),
      flag("window.more", &PersistedState::more),
      flag("window.tour_offered", &PersistedState::tour_offered),
      text("window.layout", &PersistedState::layout),
      docked(),
      number("hand.withdraw_mm_per_s", &PersistedState::withdraw_mm_per_s, 1.0, kMaxWithdrawMmPerS),
      text("recording.folder", &PersistedState::recording_folder),
      flag("recording.signals", &PersistedState::records_signals),
      number("plots.time_window_s", &PersistedState::time_window_s, kTimeWindowsS.front(),
             kTimeWindowsS.back()),
      word("plots.arrangement", kArrangementWords, &PersistedState::arrangement),
      flag("plots.loop", &draw::PhaseSettings::shown),
      flag("plots.loop_of_last_contact", &draw::PhaseSettings::last_contact),
      flag("plots.spectrum", &draw::SpectrumSettings::shown),
      {"plots.spectrum_signal", spectrum_signal, take_spectrum_signal},
      flag("plots.bounds", &Plots::show_bounds),
      word("plots.trigger", kTriggers, &draw::TriggerSettings::mode),
      number("plots.before_trigger", &draw::TriggerSettings::pre_share, 0.0, kMaxShare),
      number("wall.magnification", &WallState::Persisted::magnification, 0.0,
             kMagnifications.back()),
      number("sound.volume", &PersistedState::sound_volume, 0.0, 1.0),
      flag("compare.ghost", &Compare::ghost_shown),
      text("blind_test.question", &Compare::question),
      number("blind_test.trials", &Compare::trials, 1.0, static_cast<double>(compare::kMaxTrials)),
      number("blind_test.confidence", &Compare::confidence, kMinConfidence, kMaxConfidence),
      flag("blind_test.masking_noise", &Compare::masking_noise)};
}

// Lines are stored by name, because bit positions change between versions.
std::string names_of(draw::PlotId id, draw::LineSet set) {
  const draw::PlotTable table(signal_names());
  std::string names;
  for (const draw::PlotLine& line : table[id].lines) {
    if ((set & line_bit(line.quantity)) == 0) continue;
    names += (names.empty() ? "" : ", ") + std::string(line.name);
  }
  return names;
}

draw::LineSet lines_called(draw::PlotId id, std::string_view names) {
  const draw::PlotTable table(signal_names());
  draw::LineSet set = 0;
  for (const draw::PlotLine& line : table[id].lines) {
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
  return text(
      name,
      [=](const UiState& state) { return names_of(id, state.plots.persisted.lines.at(index)); },
      [=](UiState& state, const std::string& names) {
        state.plots.persisted.lines.at(index) = lines_called(id, names);
      });
}

// One set of hidden lines serves all plots.
Key hidden_lines(draw::PlotId id, const char* name) {
  return text(
      name, [id](const UiState& state) { return names_of(id, state.persisted.hidden_lines); },
      [id](UiState& state, const std::string& names) {
        state.persisted.hidden_lines |= lines_called(id, names);
      });
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
    std::vector<Key> all = plain_keys();
    for (Key& key : line_keys()) all.push_back(std::move(key));
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

// "NAME: TEXT". A name may hold ": ", a text does not.
constexpr std::string_view kAfterName = ": ";

std::optional<OwnLayout> own_layout(std::string_view kept) {
  const std::size_t end = kept.rfind(kAfterName);
  if (end == 0 || end == std::string_view::npos) return std::nullopt;
  const std::string_view text = kept.substr(end + kAfterName.size());
  const std::optional<DockLayout> layout = parse_layout(text);
  if (!layout) return std::nullopt;
  return OwnLayout{std::string(kept.substr(0, end)), *layout};
}

void apply_own_layouts(const Settings& settings, std::vector<OwnLayout>& own,
                       std::vector<std::string>& problems) {
  own.clear();
  for (auto found = settings.lower_bound(kOwnLayout);
       found != settings.end() && found->first.starts_with(kOwnLayout); ++found) {
    const auto* kept = std::get_if<std::string>(&found->second);
    const auto layout = kept != nullptr ? own_layout(*kept) : std::nullopt;
    const bool twice =
        layout && std::ranges::find(own, layout->name, &OwnLayout::name) != own.end();
    if (layout && !twice) {
      own.push_back(*layout);
    } else {
      problems.push_back(found->first + " is damaged: this layout is left out");
    }
  }
}

}  // namespace

Settings settings_of(const UiState& state) {
  Settings settings;
  for (const Key& key : all_setting_keys()) settings.insert_or_assign(key.name, key.get(state));
  const std::vector<std::string>& recent = state.persisted.recent;
  for (std::size_t i = 0; i < recent.size(); ++i)
    settings.insert_or_assign(fmt::format("{}{}", kRecent, i + 1), recent[i]);
  const std::vector<OwnLayout>& own = state.persisted.own_layouts;
  for (std::size_t i = 0; i < own.size(); ++i)
    settings.insert_or_assign(fmt::format("{}{:02}", kOwnLayout, i + 1),
                              own[i].name + std::string(kAfterName) + layout_text(own[i].layout));
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
  apply_own_layouts(settings, state.persisted.own_layouts, problems);
  return problems;
}

}  // namespace hapticwall::ui
