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

LargeScope::LargeScope() : before_(ImGui::GetStyle().FontScaleMain) {
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  const float room = std::min(window.x / kRoomyWidth, window.y / kRoomyHeight);
  ImGui::GetStyle().FontScaleMain = std::clamp(room, kMinScale, kMaxScale);
  ImGui::PushFont(nullptr, draw::kFontSize);
}

LargeScope::~LargeScope() {
  ImGui::GetStyle().FontScaleMain = before_;
  ImGui::PopFont();
}

}  // namespace hapticwall::ui
