#include "app/draw/plot/plot_lines.h"

#include <algorithm>

namespace hapticwall::draw {
namespace {

using enum LineKind;

constexpr std::array kPositionLines{
    PlotLine{&PlantTruth::hand_path_m, "hand", "intended position of the hand", Tone::kHand, kTruth,
             Dash::kDashed, Side::kLeft, true},
    PlotLine{&Sample::position_m, "handle", "x, the position that the encoder measures",
             Tone::kPosition},
    PlotLine{&PlantTruth::position_m, "true position",
             "true position of the handle, between two counts", Tone::kText, kTruth, Dash::kDotted,
             Side::kLeft, false, Quantity(&Sample::position_m)},
    PlotLine{&Sample::penetration_m, "penetration", "p = x - x_w, into the outermost wall",
             Tone::kForce, kExtra},
    PlotLine{&Sample::velocity_m_per_s, "velocity", "v, the backward difference of the position",
             Tone::kStiffness, kExtra, Dash::kSolid, Side::kRight},
    PlotLine{&PlantTruth::velocity_m_per_s, "true velocity",
             "true velocity of the handle at the tick", Tone::kStiffness, kSimulator, Dash::kDotted,
             Side::kRight, false, Quantity(&Sample::velocity_m_per_s)}};
constexpr std::array kForceLines{
    PlotLine{&Sample::wall_force_n, "wall F_e",
             "F_e, the force that the virtual wall wishes; the actuator may have less",
             Tone::kWallForce, kUsual, Dash::kSolid, Side::kLeft, true},
    PlotLine{&Sample::force_n, "actuator F_d",
             "F_d, the force that the algorithm commands to the handle", Tone::kForce},
    PlotLine{&PlantTruth::hand_force_n, "hand F_h", "F_h, of the hand on the handle", Tone::kHand,
             kSimulator, Dash::kDashed}};
constexpr std::array kStiffnessLines{
    PlotLine{Derived::kStiffness, "force / penetration",
             "mean F_d over mean penetration of the last 100 ms in contact;\n"
             "none until the penetration has reached a count of the encoder",
             Tone::kStiffness}};
constexpr std::array kPassivityLines{
    PlotLine{&Sample::energy_budget_j, "budget",
             "−T Σ b v²: limit of the energy that the hold may generate (Eq. 22)", Tone::kBudget,
             kUsual, Dash::kDashDot},
    PlotLine{&Sample::energy_hold_j, "hold (9)", "Eq. 9: energy of the sample-and-hold",
             Tone::kHold},
    PlotLine{&Sample::energy_scv_j, "SCV (10)",
             "Eq. 10: energy between handle and actuator, as the encoder measures it", Tone::kScv},
    PlotLine{&Sample::energy_cv_j, "observer (6)",
             "Eq. 6: the passivity observer of Hannaford and Ryu; misses the energy of the hold",
             Tone::kObserver, kUsual, Dash::kDashed},
    PlotLine{&PlantTruth::actuator_work_j, "actuator work",
             "∫ F_d v dt: energy from the handle to the actuator; negative: to the handle",
             Tone::kForce, kSimulator, Dash::kDotted},
    PlotLine{&PlantTruth::dissipation_j, "losses", "∫ (b v² + f_c |v|) dt: heat in the device",
             Tone::kStiffness, kSimulator, Dash::kDashDot},
    PlotLine{&PlantTruth::hand_work_j, "hand's work",
             "∫ F_h v dt: energy from the hand; negative: extracted by the hand", Tone::kHand,
             kSimulator, Dash::kDashed},
    PlotLine{&PlantTruth::kinetic_j, "kinetic", "½ m v² of the handle", Tone::kObserver, kSimulator,
             Dash::kDotted}};

const std::array<PlotDescription, kPlotCount> kPlots{PlotDescription{PlotId::kPosition,
                                                                     "Position",
                                                                     "position x",
                                                                     {"mm", 1e3, 0.5},
                                                                     {},
                                                                     {"mm/s", 1e3, 1.0},
                                                                     {"m/s²", 1.0, 1.0},
                                                                     kPositionLines},
                                                     PlotDescription{PlotId::kForce,
                                                                     "Force",
                                                                     "force F",
                                                                     {"N", 1.0, 1.0},
                                                                     {},
                                                                     {"N/s", 1.0, 10.0},
                                                                     {"N·s/m", 1.0, 0.1},
                                                                     kForceLines},
                                                     PlotDescription{PlotId::kStiffness,
                                                                     "Stiffness",
                                                                     "stiffness K",
                                                                     {"kN/m", 1e-3, 1.0},
                                                                     {},
                                                                     {"kN/m/s", 1e-3, 10.0},
                                                                     {},
                                                                     kStiffnessLines},
                                                     PlotDescription{PlotId::kPassivity,
                                                                     "Passivity",
                                                                     "energy E",
                                                                     {"mJ", 1e3, 0.1},
                                                                     {"J", 1.0, 0.1},
                                                                     {"mW", 1e3, 1.0},
                                                                     {},
                                                                     kPassivityLines}};

// Place of a signal, by the unit at the end of its name.
struct UnitPlace {
  std::string_view ending;
  PlotId plot;
  Side side;
};
constexpr std::array kUnitPlaces{UnitPlace{"_m", PlotId::kPosition, Side::kLeft},
                                 UnitPlace{"_m_per_s", PlotId::kPosition, Side::kRight},
                                 UnitPlace{"_m_per_s2", PlotId::kPosition, Side::kFarRight},
                                 UnitPlace{"_n", PlotId::kForce, Side::kLeft},
                                 UnitPlace{"_n_per_s", PlotId::kForce, Side::kRight},
                                 UnitPlace{"_n_s_per_m", PlotId::kForce, Side::kFarRight},
                                 UnitPlace{"_n_per_m", PlotId::kStiffness, Side::kLeft},
                                 UnitPlace{"_j", PlotId::kPassivity, Side::kLeft},
                                 UnitPlace{"_w", PlotId::kPassivity, Side::kRight}};

// The longest ending that fits; null: none does.
const UnitPlace* unit_place(std::string_view signal) {
  const UnitPlace* found = nullptr;
  for (const UnitPlace& place : kUnitPlaces) {
    if (!signal.ends_with(place.ending)) continue;
    if (found == nullptr || place.ending.size() > found->ending.size()) found = &place;
  }
  return found;
}

// "law: step bound" of "step_bound_n".
std::string signal_label(std::string_view signal, const UnitPlace& place) {
  std::string label(signal.substr(0, signal.size() - place.ending.size()));
  std::ranges::replace(label, '_', ' ');
  return "law: " + label;
}

ChosenLines find_usual_lines() {
  ChosenLines usual{};
  for (std::size_t i = 0; i < kPlotCount; ++i) {
    for (const PlotLine& line : kPlots[i].lines) {
      if (line.kind == kUsual || line.kind == kTruth) usual[i] |= line_bit(line.quantity);
    }
  }
  return usual;
}

}  // namespace

const PlotDescription& plot_description(PlotId id) { return usual_plots()[id]; }

PlotTable::PlotTable(const SignalNames& signals) : plots_(kPlots) {
  for (std::size_t i = 0; i < kPlotCount; ++i)
    lines_[i].assign(kPlots[i].lines.begin(), kPlots[i].lines.end());
  for (std::size_t place = 0; place < signals.size(); ++place) add(place, signals[place]);
  for (std::size_t i = 0; i < kPlotCount; ++i) plots_[i].lines = lines_[i];
}

void PlotTable::add(std::size_t place, std::string_view signal) {
  // Alternately, because the signals of one algorithm follow each other.
  constexpr std::array kTones{Tone::kText, Tone::kStiffness, Tone::kHand, Tone::kPosition};
  const UnitPlace* const unit = unit_place(signal);
  if (unit == nullptr) return;
  const auto known = find_algorithm_signal(signal);
  signals_[place] = signal_label(signal, *unit);
  meanings_[place] = known ? algorithm_signals()[*known].meaning : "a signal of the algorithm";
  PlotLine line{Quantity::signal(place),
                signals_[place].c_str(),
                meanings_[place].c_str(),
                kTones[place % kTones.size()],
                kExtra,
                Dash::kDashDot,
                unit->side};
  lines_[static_cast<std::size_t>(unit->plot)].push_back(line);
}

template <typename Wanted>
std::optional<PlottedLine> PlotTable::find_line(Wanted&& wanted) const {
  for (const PlotDescription& plot : plots_) {
    for (const PlotLine& line : plot.lines) {
      if (wanted(line)) return PlottedLine{&plot, &line};
    }
  }
  return std::nullopt;
}

std::optional<PlottedLine> PlotTable::find(Quantity quantity) const {
  return find_line([&](const PlotLine& line) { return line.quantity == quantity; });
}

std::optional<PlottedLine> PlotTable::find(std::string_view name) const {
  return find_line([&](const PlotLine& line) { return line.name == name; });
}

const PlotTable& usual_plots() {
  static const PlotTable kUsualPlots;
  return kUsualPlots;
}

const ChosenLines& usual_lines() {
  static const ChosenLines kUsualLines = find_usual_lines();
  return kUsualLines;
}

ChosenLines lines_with(const SignalNames& signals) {
  ChosenLines lines = usual_lines();
  const PlotTable table(signals);
  for (std::size_t place = 0; place < signals.size(); ++place) {
    const auto found = table.find(Quantity::signal(place));
    if (found) lines[static_cast<std::size_t>(found->plot->id)] |= line_bit(found->line->quantity);
  }
  return lines;
}

}  // namespace hapticwall::draw
