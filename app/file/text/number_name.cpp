#include "app/file/text/number_name.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "core/units.h"

namespace hapticwall::file {
namespace {

struct Entry {
  std::string_view key;  // without the table of an axis and the number of a wall
  std::string_view name;
  std::string_view symbol;
  std::string_view unit = {};  // "": that of the scene
  double scale = 1.0;
};
constexpr double kGrams = 1e3;  // in a kilogram
// The symbols are those of docs/: README, algorithms/ and maps.md.
constexpr std::array kEntries{
    Entry{"wall.stiffness_n_per_m", "wall stiffness", "K", "kN/m", 1.0 / kNewtonsPerKilonewton},
    Entry{"wall.damping_n_s_per_m", "wall damping", "B"},
    Entry{"wall.position_m", "wall position", "x_w", "mm", kMillimetresPerMetre},
    Entry{"device.mass_kg", "handle mass", "m", "g", kGrams},
    Entry{"device.damping_n_s_per_m", "device damping", "b"},
    Entry{"device.friction_n", "device friction", "f_c"},
    Entry{"device.static_friction_n", "static friction", "f_s"},
    Entry{"device.stribeck_speed_m_per_s", "Stribeck speed", "v_s", "mm/s", kMillimetresPerMetre},
    Entry{"device.encoder_m", "encoder count", "Δ", "mm", kMillimetresPerMetre},
    Entry{"device.position_noise_m", "position noise", "", "mm", kMillimetresPerMetre},
    Entry{"device.force_limit_n", "force limit", "F_max"},
    Entry{"device.max_force_rate_n_per_s", "max force rate", ""},
    Entry{"device.force_noise_n", "force noise", ""},
    Entry{"device.force_resolution_n", "force resolution", ""},
    Entry{"device.delay_ticks", "delay", "t_d"},
    Entry{"device.amplifier_time_constant_s", "amplifier time constant", "", "ms",
          kMillisecondsPerSecond},
    Entry{"device.start_m", "start position", "", "mm", kMillimetresPerMetre},
    Entry{"hand.mass_kg", "hand mass", "m_h", "g", kGrams},
    Entry{"hand.stiffness_n_per_m", "hand stiffness", "k_h"},
    Entry{"hand.damping_n_s_per_m", "hand damping", "b_h"},
    Entry{"hand.grip_stiffness_n_per_m", "grip stiffness", "k_g"},
    Entry{"hand.grip_damping_n_s_per_m", "grip damping", "b_g"},
    Entry{kPathSpeed, "speed of the hand", "", "mm/s", kMillimetresPerMetre},
    Entry{"sampling.rate_hz", "sampling rate", "1/T", "kHz", 1e-3},
    Entry{"duration_s", "duration", ""}};

// Units at the end of a key. A longer ending comes before one that it ends with.
constexpr std::array<std::string_view, 12> kEndings{
    "_n_s_per_m", "_m_per_s", "_s_per_m", "_n_per_m", "_n_per_s", "_kg",
    "_hz",        "_s",       "_m",       "_n",       "_j",       "_w"};

// "wall[2].KEY" as "wall.KEY" and its number, "device.y.KEY" as "device.KEY" and "y".
struct Place {
  std::string key;
  std::string which;  // " 3", " y"; "": the only one
};

Place place_of(std::string_view path) {
  Place place{std::string(path), ""};
  const std::size_t open = path.find('[');
  const std::size_t close = path.find("].");
  if (open != std::string_view::npos && close != std::string_view::npos) {
    const int index = std::stoi(std::string(path.substr(open + 1, close - open - 1)));
    place.key = std::string(path.substr(0, open)).append(path.substr(close + 1));
    place.which = " " + std::to_string(index + 1);
  }
  const std::size_t axis = place.key.find(".y.");
  if (axis != std::string::npos) {
    place.key.erase(axis, 2);
    place.which += " y";
  }
  return place;
}

}  // namespace

std::string key_in_words(std::string_view key) {
  std::string_view word = key.substr(key.rfind('.') + 1);
  const auto ending =
      std::ranges::find_if(kEndings, [&](std::string_view each) { return word.ends_with(each); });
  if (ending != kEndings.end()) word.remove_suffix(ending->size());
  std::string words(word);
  std::ranges::replace(words, '_', ' ');
  return words;
}

std::string NumberName::title() const {
  std::string text = name;
  if (!symbol.empty()) text += " " + symbol;
  if (!unit.empty()) text += " (" + unit + ")";
  return text;
}

NumberName number_name(const SceneNumber& number) {
  const Place place = place_of(number.path);
  const auto entry = std::ranges::find(kEntries, place.key, &Entry::key);
  if (entry == kEntries.end()) return {key_in_words(place.key) + place.which, "", number.unit, 1.0};
  return {std::string(entry->name) + place.which, std::string(entry->symbol),
          entry->unit.empty() ? number.unit : std::string(entry->unit), entry->scale};
}

}  // namespace hapticwall::file
