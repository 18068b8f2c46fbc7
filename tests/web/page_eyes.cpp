// What the test of the page sees: Module.see() notes the controls of the last frame, and facts of
// the session, in Module.controls and Module.facts.
#include <emscripten.h>
#include <fmt/format.h>
#include <imgui_internal.h>

#include <cstdarg>
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

std::string escaped(const std::string& text) {
  std::string out;
  for (const char each : text) {
    if (each == '"' || each == '\\') out += '\\';
    out += static_cast<unsigned char>(each) < 0x20 ? ' ' : each;
  }
  return out;
}

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
  std::string list;
  for (const Control& each : controls) {
    list +=
        fmt::format(R"({}{{"id":{},"x":{},"y":{},"label":"{}"}})", list.empty() ? "" : ",", each.id,
                    each.box.GetCenter().x, each.box.GetCenter().y, escaped(each.label));
  }
  ui::Application& shown = web::application_of_page();
  const session::Snapshot now = shown.session().snapshot();
  const Scene& scene = shown.session().scene();
  const std::string facts =
      fmt::format(R"({{"time_s":{},"missed":{},"scene":"{}","algorithm":{},"stiffness":{},)"
                  R"("tour":{},"seen":{},"led":{},"scale":{},"frames":{}}})",
                  now.newest.x().time_s, now.timing.missed_ticks, scene.name, scene.algorithm.index,
                  scene.x().walls.empty() ? 0.0 : scene.x().walls.front().stiffness_n_per_m,
                  shown.state().tour.step, shown.state().tour.seen.count(), shown.state().hand.led,
                  ImGui::GetIO().DisplayFramebufferScale.x, ImGui::GetFrameCount());
  note(("[" + list + "]").c_str(), facts.c_str());
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
