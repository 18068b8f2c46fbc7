#include "app/draw/plot/plot_lines.h"

namespace hapticwall::draw {
namespace {

using enum LineKind;

constexpr std::array kPositionLines{
    PlotLine{&PlantTruth::hand_path_m, "hand",
             "intended position of the hand; the value axis ignores it", Tone::kHand},
    PlotLine{&Sample::position_m, "handle", "x, the position that the encoder measures",
             Tone::kPosition},
    PlotLine{&PlantTruth::position_m, "true position",
             "true position of the handle, between two counts", Tone::kAccent, kSimulator},
    PlotLine{&Sample::penetration_m, "penetration", "p = x - x_w, into the outermost wall",
             Tone::kBad, kExtra},
    PlotLine{&Sample::velocity_m_per_s, "velocity", "v, the backward difference of the position",
             Tone::kWarning, kExtra, true},
    PlotLine{&PlantTruth::velocity_m_per_s, "true velocity",
             "true velocity of the handle at the tick", Tone::kGood, kSimulator, true}};
constexpr std::array kForceLines{
    PlotLine{&Sample::wall_force_n, "wall F_e", "F_e, the force of the virtual wall",
             Tone::kWallForce},
    PlotLine{&Sample::force_n, "actuator F_d",
             "F_d, the force that the algorithm commands to the handle", Tone::kForce},
    PlotLine{&PlantTruth::hand_force_n, "hand F_h", "F_h, of the hand on the handle", Tone::kHand,
             kSimulator}};
constexpr std::array kStiffnessLines{PlotLine{&Sample::stiffness_n_per_m, "force / penetration",
                                              "F_d over penetration; 0 out of contact",
                                              Tone::kStiffness}};
constexpr std::array kPassivityLines{
    PlotLine{&Sample::energy_budget_j, "budget",
             "−T Σ b v²: limit of the energy that the hold may generate (Eq. 22)", Tone::kBudget},
    PlotLine{&Sample::energy_hold_j, "hold (9)", "Eq. 9: energy of the sample-and-hold",
             Tone::kHold},
    PlotLine{&Sample::energy_scv_j, "SCV (10)",
             "Eq. 10: energy between handle and actuator, as the encoder measures it", Tone::kScv},
    PlotLine{&Sample::energy_cv_j, "observer (6)",
             "Eq. 6: the passivity observer of Hannaford and Ryu; blind to the hold",
             Tone::kObserver},
    PlotLine{&PlantTruth::actuator_work_j, "actuator work",
             "∫ F_d v dt: energy from the handle to the actuator; negative: to the handle",
             Tone::kForce, kSimulator},
    PlotLine{&PlantTruth::dissipation_j, "losses", "∫ (b v² + f_c |v|) dt: heat in the device",
             Tone::kGood, kSimulator},
    PlotLine{&PlantTruth::hand_work_j, "hand's work",
             "∫ F_h v dt: energy from the hand; negative: extracted by the hand", Tone::kHand,
             kSimulator},
    PlotLine{&PlantTruth::kinetic_j, "kinetic", "½ m v² of the handle", Tone::kAccent, kSimulator}};

const std::array<PlotDescription, kPlotCount> kPlots{
    PlotDescription{
        PlotId::kPosition, "Position", {"mm", 1e3, 1.0}, {"mm/s", 1e3, 1.0}, kPositionLines},
    PlotDescription{PlotId::kForce, "Force", {"N", 1.0, 1.0}, {}, kForceLines},
    PlotDescription{PlotId::kStiffness, "Stiffness", {"kN/m", 1e-3, 1.0}, {}, kStiffnessLines},
    PlotDescription{PlotId::kPassivity, "Passivity", {"mJ", 1e3, 0.1}, {}, kPassivityLines}};

ChosenLines find_usual_lines() {
  ChosenLines usual{};
  for (std::size_t i = 0; i < kPlotCount; ++i) {
    for (const PlotLine& line : kPlots[i].lines) {
      if (line.kind == kUsual) usual[i] |= line_bit(line.quantity);
    }
  }
  return usual;
}

}  // namespace

const PlotDescription& plot_description(PlotId id) { return kPlots[static_cast<std::size_t>(id)]; }

const ChosenLines& usual_lines() {
  static const ChosenLines kUsualLines = find_usual_lines();
  return kUsualLines;
}

}  // namespace hapticwall::draw
