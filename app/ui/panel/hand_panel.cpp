#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "app/file/scene/hand_description.h"
#include "app/ui/panel/hand_drag.h"
#include "app/ui/panel/hand_state.h"
#include "app/ui/panel/sections.h"
#include "app/ui/state/changes.h"
#include "app/ui/state/scene_state.h"
#include "app/ui/widget/parameter_rows.h"
#include "app/ui/widget/sliders.h"
#include "app/ui/widget/widgets.h"
#include "core/units.h"

namespace hapticwall::ui {
namespace {

// A script with one move at constant speed.
struct Approach {
  double start_m = 0.0;
  double end_m = 0.0;
  double speed_m_per_s = 0.0;
};

std::optional<Approach> approach_of(const HandSettings& hand) {
  if (hand.path.size() != 2) return std::nullopt;
  const PathPoint& from = hand.path.front();
  const PathPoint& to = hand.path.back();
  const double duration_s = to.time_s - from.time_s;
  if (duration_s <= 0.0) return std::nullopt;
  return Approach{from.position_m, to.position_m,
                  std::abs(to.position_m - from.position_m) / duration_s};
}

void want_approach(const PanelContext& context, const Approach& approach) {
  if (!(approach.speed_m_per_s > 0.0)) {
    refuse(context, "approach speed", "the approach speed must be more than 0 mm/s");
    return;
  }
  Scene changed = context.session.scene();
  PathPoint& to = changed.x().hand->path.edit().back();
  to.position_m = approach.end_m;
  to.time_s = changed.x().hand->path.front().time_s +
              std::abs(approach.end_m - approach.start_m) / approach.speed_m_per_s;
  context.scene.wanted = WantedScene{std::move(changed)};
}

void draw_approach(const PanelContext& context, Approach approach) {
  const auto row = [&](const char* name, const char* unit, const char* tooltip, double& value_si) {
    const auto typed =
        number_row(context, {name, name, unit, tooltip, value_si * kMillimetresPerMetre});
    if (!typed) return;
    value_si = *typed / kMillimetresPerMetre;
    want_approach(context, approach);
  };
  row("end position", "mm",
      "The last point of the script p(t), in mm. Restarts the script from rest.", approach.end_m);
  row("approach speed", "mm/s",
      "p', speed of the approach, in mm/s. Restarts the script from rest.", approach.speed_m_per_s);
}

double hand_mm(const PanelContext& context) {
  return context.snapshot.newest.x().truth.hand_path_m * kMillimetresPerMetre;
}

void draw_withdrawal(const PanelContext& context) {
  double& speed_mm_per_s = context.hand.withdraw_mm_per_s;
  const auto typed =
      number_row(context, {"withdraw speed", "withdraw speed", "mm/s",
                           "Speed at which the key H takes the hand back to where the scene "
                           "begins, 1 to 1000 mm/s",
                           speed_mm_per_s});
  if (typed) speed_mm_per_s = std::clamp(*typed, 1.0, kMaxWithdrawMmPerS);
  if (button("Withdraw the hand (H)###withdraw hand",
             "Takes the hand back to its position at the start of the scene and keeps it there"))
    withdraw_hand(context);
}

void draw_pointer(const PanelContext& context, const HandSettings& hand) {
  if (context.hand.led) {
    ImGui::TextColored(context.theme.colour(draw::Tone::kHand), "Led by you, now at %.1f mm",
                       hand_mm(context));
    muted_text(context, "It stays where you leave it. Reset (R) starts its script again.");
  } else {
    muted_text(context, hand.follows_mouse
                            ? "Waits for you: drag in the view."
                            : "Follows its script. Drag in the view to lead it yourself.");
  }
  draw_withdrawal(context);
}

const std::array kHandRows{
    ParameterText{"mass_kg", "mass",
                  "m_h of the hand: joined to the handle, or holding it through the grip", 0.4},
    ParameterText{"stiffness_n_per_m", "spring",
                  "k_h in F_h = k_h (p - x) + b_h (p' - v): of the arm, to the intended position "
                  "p",
                  250.0},
    ParameterText{"damping_n_s_per_m", "damping",
                  "b_h in F_h = k_h (p - x) + b_h (p' - v): of the arm", 33.0},
    ParameterText{"grip_stiffness_n_per_m", "grip",
                  "k_g in F_h = k_g (x_h - x) + b_g (v_h - v): the spring from hand to handle",
                  1000.0},
    ParameterText{"grip_damping_n_s_per_m", "grip damping",
                  "b_g in F_h = k_g (x_h - x) + b_g (v_h - v): the damper beside the grip's spring",
                  1.0}};

// Removing the grip removes its damping.
void edit_hand(HandSettings& hand, const NumberKey<HandSettings>& key, const ParameterEdit& edit) {
  assign(key, hand, edit.value);
  if (!hand.has_grip() && key.key == "grip_stiffness_n_per_m") hand.grip_damping_n_s_per_m.reset();
}

void take_hand(const PanelContext& context, const HandSettings& numbers) {
  Scene wanted = context.session.scene();
  HandSettings hand = numbers;
  hand.path = wanted.x().hand->path;
  hand.follows_mouse = wanted.x().hand->follows_mouse;
  wanted.x().hand = std::move(hand);
  if (const auto problem = ask_for(context, wanted)) tell(context.toasts, *problem);
}

// Each number of the hand is replaced, so that none of the hand before is left.
void draw_hand_list(const PanelContext& context) {
  constexpr const char* kMeaning =
      "Replaces the numbers below by those of a hand with a published source, as --set hand=NAME "
      "does. The path stays. The tooltips name the sources.";
  field_label(context, "numbers of", kMeaning, "");
  if (ImGui::BeginCombo("##hand numbers", "a named hand ...")) {
    for (const file::BuiltinHand& builtin : file::builtin_hands()) {
      const auto hand = file::load_hand_description(builtin.name);
      if (hand && list_choice(fmt::format("{}###take hand {}", hand->name, builtin.name), false,
                              hand->source))
        take_hand(context, hand->hand);
    }
    ImGui::EndCombo();
  }
  explain(kMeaning);
}

void draw_body(const PanelContext& context) {
  draw_hand_list(context);
  const auto& loaded = context.scene.loaded.x().hand;
  for (const ParameterText& text : kHandRows) {
    const auto& key = key_called<HandSettings>(text.key);
    const HandSettings& in_force = *context.session.scene().x().hand;
    const ParameterRow row =
        parameter_row("hand.", key, text, in_force, loaded ? *loaded : in_force);
    const auto edit = draw_parameter_row(context, row);
    if (!edit) continue;
    change_parameters(context, row.key,
                      [&](Scene& scene) { edit_hand(*scene.x().hand, key, *edit); });
  }
}

// Short text: who leads the hand.
std::string summary(const PanelContext& context) {
  const auto& hand = context.session.scene().x().hand;
  if (!hand) return context.session.device_info().is_simulated ? "none" : "yours";
  if (context.hand.led) return fmt::format("led by you, {:.1f} mm", hand_mm(context));
  if (hand->follows_mouse) return "waits for the pointer";
  if (const auto approach = approach_of(*hand)) {
    return fmt::format("to {} mm at {} mm/s",
                       rounded_number(approach->end_m * kMillimetresPerMetre),
                       rounded_number(approach->speed_m_per_s * kMillimetresPerMetre));
  }
  return fmt::format("a script of {} points", hand->path.size());
}

}  // namespace

void draw_hand_section(const PanelContext& context) {
  if (!folding_section(context, "Hand", summary(context), asked_for(context).hand)) return;
  const auto& hand = context.session.scene().x().hand;
  if (!hand) {
    muted_text(context, context.session.device_info().is_simulated
                            ? "This scene has no hand: nothing holds the handle."
                            : "A person's own hand is on the handle.");
    return;
  }
  if (const auto approach = approach_of(*hand)) {
    draw_approach(context, *approach);
  } else if (!hand->path.empty()) {
    muted_text(context, fmt::format("A script of {} points, from the scene.", hand->path.size()));
  }
  draw_pointer(context, *hand);
  draw_body(context);
}

}  // namespace hapticwall::ui
