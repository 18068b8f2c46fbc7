#include "app/ui/page/pages.h"

#include <array>

#include "app/ui/computed/all_runs.h"
#include "app/ui/computed/study_state.h"
#include "app/ui/page/blind_test_page.h"
#include "app/ui/page/identify_page.h"
#include "app/ui/page/magnifier.h"
#include "app/ui/page/map_state.h"
#include "app/ui/page/plots_panel.h"
#include "app/ui/page/timing_page.h"
#include "app/ui/panel/wall_view.h"
#include "app/ui/state/timing_state.h"
#include "app/ui/wall/wall_state.h"

namespace hapticwall::ui {
namespace {

constexpr ImGuiWindowFlags kStill =
    ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse;

// Scale of the initial wall view at the contact, pixels per metre.
double view_scale(const PanelContext& context) {
  constexpr double kProbeM = 1e-3;
  const Scene& scene = context.session.scene();
  const ImVec2 view = context.wall.transient.view_size;
  const ImVec2 size = view.x > 0.0F ? view : ImGui::GetContentRegionAvail();
  if (scene.x().walls.empty()) return 1.0;
  const WallCamera camera = wall_view_camera(scene, size);
  const double face_m = scene.x().walls.front().position_m;
  const glm::vec2 face = camera.pixel_of({camera.x_of(face_m), 0.0F, 0.0F});
  const glm::vec2 beside = camera.pixel_of({camera.x_of(face_m + kProbeM), 0.0F, 0.0F});
  return static_cast<double>(glm::distance(face, beside)) / kProbeM;
}

void draw_controls(const PageParts& parts) { draw_controls_page(parts.context); }

void draw_wall(const PageParts& parts) {
  parts.context.wall.transient.view_size = ImGui::GetContentRegionAvail();
  draw_wall_view(parts.context, parts.renderer);
}

void draw_contact(const PageParts& parts) {
  draw_magnifier(parts.context, parts.history, view_scale(parts.context));
}

void draw_plots(const PageParts& parts) {
  show_ghost(parts.context);
  draw_plots_panel(parts.context, parts.history);
}

void draw_timing(const PageParts& parts) { draw_timing_page(parts.context); }
void draw_blind_test(const PageParts& parts) { draw_blind_test_page(parts.context); }
void draw_map(const PageParts& parts) { draw_map_page(parts.context, parts.map); }
void draw_all(const PageParts& parts) { draw_all_page(parts.context, parts.all_runs); }
void draw_study(const PageParts& parts) { draw_study_page(parts.context, parts.studies); }
void draw_identify(const PageParts& parts) { draw_identify_page(parts.context); }

void notice_timing(const PageParts& parts, bool seen) { parts.context.timing.page_seen = seen; }
void notice_map(const PageParts& parts, bool seen) {
  if (!seen) parts.map.live.stop();
}
void notice_all(const PageParts& parts, bool seen) {
  if (!seen) parts.all_runs.stop();
}
void notice_study(const PageParts& parts, bool seen) {
  if (!seen) parts.studies.stop();
}
void notice_identify(const PageParts& parts, bool seen) {
  if (!seen) leave_identify_page(parts.context.identify);
}

constexpr std::array kPages{
    Page{{kControlsPage, "Scene, algorithm and parameters"}, draw_controls},
    Page{{"Wall", "The wall, the handle and the force"},
         draw_wall,
         false,
         nullptr,
         kStill | ImGuiWindowFlags_NoBackground},  // the picture covers the background
    Page{{"Contact", "The contact, magnified"}, draw_contact, true, nullptr, kStill},
    Page{{kPlotsPage, "Position, force, stiffness and energy over time"}, draw_plots, true},
    Page{{"Timing", "Timing of the loop and of the window"},
         draw_timing,
         true,
         notice_timing,
         0,
         &Capabilities::timing},
    Page{{kBlindTestPage, "Which of two walls? A and B of Compare, in hidden order"},
         draw_blind_test,
         false,
         nullptr,
         0,
         &Capabilities::files},
    Page{{"Map",
          "Stability of the present scene over two of its numbers. A click makes a cell the "
          "running scene."},
         draw_map,
         true,
         notice_map,
         0,
         &Capabilities::threads},
    Page{{"All at once", "The present scene under all algorithms. A click puts one in force."},
         draw_all,
         true,
         notice_all},
    Page{
        {"Identify", "Mass, damping, friction and delay of the device; the handle moves by itself"},
        draw_identify,
        true,
        notice_identify,
        0,
        &Capabilities::devices},
    Page{{"Study", "Tables of the present scene: the algorithms ranked, the integrators measured"},
         draw_study,
         true,
         notice_study,
         0,
         &Capabilities::threads}};

}  // namespace

std::span<const Page> pages() { return kPages; }

}  // namespace hapticwall::ui
