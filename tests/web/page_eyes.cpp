// What the test of the page sees: Module.see() notes the controls of the last frame, and facts of
// the session, in Module.controls and Module.facts.
#include <emscripten.h>
#include <imgui_internal.h>

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "app/ui/window/application.h"

namespace hapticwall::web {
ui::Application& application_of_page();  // app/web/main.cpp
}

namespace {

struct Control {
  ImGuiID id = 0;
  ImRect box;
  std::string label;  // lists have none
};
std::vector<Control> controls;
int frame_of_controls = 0;

// clang-format off
EM_JS(void, note, (const char* controls, const char* facts), {
  Module.controls = JSON.parse(UTF8ToString(controls));
  Module.facts = JSON.parse(UTF8ToString(facts));
})
// clang-format on

}  // namespace

extern "C" EMSCRIPTEN_KEEPALIVE void see() {
  using namespace hapticwall;
  ImGui::GetCurrentContext()->TestEngineHookItems = true;
  nlohmann::json list = nlohmann::json::array();
  for (const Control& each : controls) {
    const ImVec2 centre = each.box.GetCenter();
    list.push_back({{"id", each.id}, {"x", centre.x}, {"y", centre.y}, {"label", each.label}});
  }
  ui::Application& shown = web::application_of_page();
  const session::Snapshot now = shown.session().snapshot();
  const Scene& scene = shown.session().scene();
  const bool walls = !scene.x().walls.empty();
  const nlohmann::json facts{{"time_s", now.newest.x().time_s},
                             {"missed", now.timing.missed_ticks},
                             {"scene", scene.name},
                             {"algorithm", scene.algorithm.index},
                             {"stiffness", walls ? scene.x().walls.front().stiffness_n_per_m : 0.0},
                             {"tour", shown.state().tour.step},
                             {"seen", shown.state().tour.seen.count()},
                             {"led", shown.state().hand.led},
                             {"scale", ImGui::GetIO().DisplayFramebufferScale.x},
                             {"frames", ImGui::GetFrameCount()}};
  note(list.dump().c_str(), facts.dump().c_str());
}

// Dear ImGui calls these for each item that it draws.
void ImGuiTestEngineHook_ItemAdd(ImGuiContext* ctx, ImGuiID id, const ImRect& bb,
                                 const ImGuiLastItemData* /*item*/) {
  if (std::exchange(frame_of_controls, ctx->FrameCount) != ctx->FrameCount) controls.clear();
  ImRect seen = bb;
  if (ctx->CurrentWindow != nullptr) seen.ClipWithFull(ctx->CurrentWindow->ClipRect);
  if (id != 0 && seen.GetWidth() > 1.0F && seen.GetHeight() > 1.0F)
    controls.push_back({id, seen, ""});
}

void ImGuiTestEngineHook_ItemInfo(ImGuiContext* /*ctx*/, ImGuiID id, const char* label,
                                  ImGuiItemStatusFlags /*flags*/) {
  if (!controls.empty() && controls.back().id == id) controls.back().label = label;
}

void ImGuiTestEngineHook_Log(ImGuiContext* /*ctx*/, const char* /*format*/, ...) {}
const char* ImGuiTestEngine_FindItemDebugLabel(ImGuiContext* /*ctx*/, ImGuiID /*id*/) {
  return nullptr;
}
