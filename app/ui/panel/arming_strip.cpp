#include "app/ui/panel/arming_strip.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/ui/panel/identify_state.h"
#include "app/ui/state/timing_state.h"
#include "app/ui/widget/widgets.h"
#include "core/units.h"

namespace hapticwall::ui {
namespace {

using session::ArmingState;

constexpr float kStripHeightEms = 2.3F;
constexpr float kArmButtonEms = 9.0F;

// Off is calm; on must be obvious.
draw::Tone tone_of(ArmingState state) {
  switch (state) {
    case ArmingState::kRamping:
      return draw::Tone::kWarning;
    case ArmingState::kOn:
      return draw::Tone::kBad;
    default:
      return draw::Tone::kFaint;
  }
}

// Width proportional to the gain of the force.
void draw_background(const PanelContext& context, const ImVec2& corner, const ImVec2& size) {
  const session::ArmingStatus& arming = context.snapshot.arming;
  const float share = std::clamp(static_cast<float>(arming.gain), 0.0F, 1.0F);
  ImDrawList* list = ImGui::GetWindowDrawList();
  const float rounding = ImGui::GetStyle().FrameRounding;
  const ImVec2 end(corner.x + size.x, corner.y + size.y);
  list->AddRectFilled(corner, end, context.theme.packed(draw::Tone::kFaint, 0.6F), rounding);
  if (share > 0.0F && arming.state != ArmingState::kOff) {
    list->AddRectFilled(corner, ImVec2(corner.x + share * size.x, end.y),
                        context.theme.packed(tone_of(arming.state), 0.75F), rounding);
  }
}

void draw_button(const PanelContext& context) {
  const bool off = context.snapshot.arming.state == ArmingState::kOff;
  const char* tooltip =
      off ? "Enables the force, which rises over half a second. Refused while the handle is "
            "inside the wall. Any fault removes the force."
          : "Removes the force at once (Space, even while text is typed).";
  if (button(off ? "Arm (A)###arm" : "Stop (Space)###arm", tooltip, {.width = ems(kArmButtonEms)}))
    off ? ask_to_arm(context) : disarm(context);
}

void tell_without_device(const PanelContext& context, const char* meaning) {
  if (context.shows.live != nullptr && !context.session.device_info().is_simulated) return;
  context.toasts.tell(MessageKind::kNote,
                      fmt::format("{}; none is connected, and nothing pushes. P pauses.", meaning));
}

}  // namespace

std::string arming_text(const session::Snapshot& snapshot) {
  const session::ArmingStatus& arming = snapshot.arming;
  if (arming.state == ArmingState::kOn && arming.limit_share < 1.0)
    return fmt::format("FORCE WEAK: {}", session::kWeakText);
  if (arming.state == ArmingState::kOn) return "FORCE ON";
  if (arming.state == ArmingState::kRamping) {
    return fmt::format("FORCE RISING  {:.0f} %", kPercent * arming.gain);
  }
  std::string why(session::arming_note_text(arming.note));
  if (snapshot.link.trouble != device::Trouble::kNone) {
    why = device::trouble_text(snapshot.link.trouble);
  }
  return why.empty() ? "FORCE OFF" : "FORCE OFF: " + why;
}

void draw_arming_strip(const PanelContext& context) {
  if (context.snapshot.arming.state == ArmingState::kNotNeeded) return;
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float em = ImGui::GetFontSize();
  const ImVec2 size(ImGui::GetContentRegionAvail().x, kStripHeightEms * em);
  draw_background(context, corner, size);
  const float inset = 0.5F * (size.y - ImGui::GetFrameHeight());
  ImGui::SetCursorScreenPos(ImVec2(corner.x + inset, corner.y + inset));
  draw_button(context);
  ImGui::SameLine(0.0F, em);
  ImGui::AlignTextToFramePadding();
  const std::string silence = silence_text(context.timing.answer);
  draw::strong_text(context.theme, silence.empty() ? arming_text(context.snapshot) : silence,
                    draw::kTitleFontSize);
  explain(context.session.device_trouble());
  if (context.snapshot.arming.mostly_at_limit(context.session.scene().sampling.rate_hz)) {
    ImGui::SameLine(0.0F, em);
    muted_text(context, session::kAtLimitText);
  }
  if (!context.snapshot.link.acknowledges) {
    ImGui::SameLine(0.0F, em);
    muted_text(context, "never tried on this model: hands off the spokes");
  }
  ImGui::SetCursorScreenPos(ImVec2(corner.x, corner.y + size.y + ImGui::GetStyle().ItemSpacing.y));
  ImGui::Dummy(ImVec2(size.x, 0.0F));
}

void ask_to_arm(const PanelContext& context) {
  if (context.shows.live != nullptr) context.shows.live->arm(true);
  tell_without_device(context, "A arms the force of a device");
}

void disarm(const PanelContext& context) {
  const auto& experiment = context.identify.experiment;
  if (experiment) experiment->stop("switched off");
  if (context.shows.live != nullptr) context.shows.live->arm(false);
  // In a text field, Space also types a blank.
  if (!ImGui::GetIO().WantTextInput && !experiment)
    tell_without_device(context, "Space takes the force of a device away");
}

}  // namespace hapticwall::ui
