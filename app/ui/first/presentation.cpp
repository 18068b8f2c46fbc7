#include "app/ui/first/presentation.h"

#include <algorithm>

#include "app/ui/computed/other_wall.h"
#include "app/ui/state/compare_state.h"
#include "app/ui/state/messages.h"
#include "app/ui/state/window_state.h"

namespace hapticwall::ui {
namespace {

constexpr float kRoomyWidth = 1000.0F;  // of a window that shows it at scale 1, pixels
constexpr float kRoomyHeight = 680.0F;
constexpr float kLeastWidth = 640.0F;  // of a window that has room for the first window at scale 1
constexpr float kLeastHeight = 400.0F;
constexpr float kMinScale = 0.8F;
constexpr float kMaxScale = 4.0F;

}  // namespace

std::optional<std::string> why_no_two_walls(const PanelContext& context) {
  if (context.shows.live == nullptr) return "a recording has one wall: open a scene, then press F5";
  if (context.shows.hides_algorithm || context.compare.transient.test)
    return "a blind test hides what F5 shows: end it first";
  if (!context.shows.live->device_info().is_simulated)
    return "F5 presents two walls of the simulator: a device has one, and its controls stay in "
           "sight";
  if (!OtherWall::exists_for(context.session))
    return "F5 presents walls of one axis: open a scene with one axis";
  return std::nullopt;
}

void toggle_presentation(const PanelContext& context) {
  bool& presents = context.window.presents;
  const std::optional<std::string> refused = why_no_two_walls(context);
  if (refused && !presents) return context.toasts.tell(MessageKind::kNote, *refused);
  presents = !presents;
}

void keep_presentation(const PanelContext& context) {
  if (why_no_two_walls(context)) context.window.presents = false;
}

float presented_scale() {
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  const float room = std::min(window.x / kRoomyWidth, window.y / kRoomyHeight);
  return std::clamp(room, kMinScale, kMaxScale);
}

float fitting_scale() {
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  const float room = std::min(window.x / kLeastWidth, window.y / kLeastHeight);
  return std::min(ImGui::GetStyle().FontScaleMain, std::max(room, kMinScale));
}

ScaleScope::ScaleScope(float scale) : before_(ImGui::GetStyle().FontScaleMain) {
  ImGui::GetStyle().FontScaleMain = scale;
  ImGui::PushFont(nullptr, draw::kFontSize);
}

ScaleScope::~ScaleScope() {
  ImGui::GetStyle().FontScaleMain = before_;
  ImGui::PopFont();
}

}  // namespace hapticwall::ui
