#include "app/ui/panel/hand_drag.h"

#include <algorithm>
#include <cmath>

#include "app/ui/panel/hand_state.h"
#include "app/ui/state/frame_input.h"
#include "core/units.h"

namespace hapticwall::ui {
namespace {

bool any_hand(const Scene& scene) {
  return std::ranges::any_of(scene.axes,
                             [](const AxisSettings& axis) { return axis.hand.has_value(); });
}

// Why the hand cannot be led now; empty: it can.
const char* obstacle(const PanelContext& context) {
  if (!any_hand(context.session.scene())) return "this scene has no hand that could be led";
  return context.snapshot.paused ? "the session is paused: the hand moves when it runs (key P)"
                                 : "";
}

// The place under the pointer at each event of this frame, or at the frame's own time. Events of
// the frame that sees the release may be later than the release, whose place Dear ImGui knows.
void follow_pointer(const PanelContext& context, const WallCamera& camera, bool held) {
  HandDrag& drag = context.hand.drag;
  const auto follow = [&](const PointerEvent& event) {
    const glm::vec2 way(event.at.x - drag.grabbed_at.x, event.at.y - drag.grabbed_at.y);
    drag.lead.follow({event.time_s, camera.place_at(drag.hand_at + way)});
    drag.pointer = event.at;
  };
  if (held && !context.input.pointer_events.empty()) {
    std::ranges::for_each(context.input.pointer_events, follow);
    return;
  }
  const ImVec2 now = ImGui::GetIO().MousePos;
  // Dear ImGui knows whole pixels.
  const bool elsewhere = std::floor(drag.pointer.x) != now.x || std::floor(drag.pointer.y) != now.y;
  if (elsewhere) follow({context.input.now_s, now});
}

// The picture of the hand moves with the pointer, wherever the pointer is.
void grab(const PanelContext& context, const WallCamera& camera) {
  const char* problem = obstacle(context);
  if (*problem != '\0') return context.toasts.tell(MessageKind::kNote, problem);
  HandDrag& drag = context.hand.drag;
  const auto& axes = context.snapshot.newest.axes;
  drag.hand_at =
      camera.pixel_of(camera.point_of({axes[0].truth.hand_path_m, axes[1].truth.hand_path_m}));
  drag.grabbed_at = drag.pointer = ImGui::GetIO().MousePos;
  drag.lead.grab({context.input.now_s, camera.place_at(drag.hand_at)});
  context.hand.led = true;
}

}  // namespace

void lead_hand(const PanelContext& context, const WallCamera& camera, bool held) {
  session::LiveSession* live = context.shows.live;
  HandLead& lead = context.hand.drag.lead;
  if (live == nullptr || (!held && !lead.holds())) return;
  if (context.snapshot.paused) lead.release();
  if (lead.holds()) {
    follow_pointer(context, camera, held);
  } else if (held && ImGui::IsItemActivated()) {
    grab(context, camera);
  }
  if (!lead.holds()) return;
  for (const session::HandMove& move : lead.take(context.input.now_s)) live->move_hand(move);
  if (!held) lead.release();
}

void withdraw_hand(const PanelContext& context) {
  const Scene& scene = context.session.scene();
  if (context.shows.live == nullptr) return;
  const char* problem = obstacle(context);
  if (*problem != '\0') return context.toasts.tell(MessageKind::kNote, problem);
  session::HandMove move;
  for (std::size_t i = 0; i < scene.axes.size(); ++i) move.m[i] = scene.axes[i].device.start_m;
  move.speed_m_per_s = context.hand.withdraw_mm_per_s / kMillimetresPerMetre;
  move.to_place = move.at_once = true;
  context.shows.live->move_hand(move);
  context.hand.drag.lead.release();
  context.hand.led = true;
}

}  // namespace hapticwall::ui
