#include "tests/app/ui/items.h"

#include <imgui_internal.h>
#include <implot.h>
#include <implot_internal.h>

#include <algorithm>
#include <vector>

namespace hapticwall::test {
namespace {

struct DrawnItem {
  ImGuiID id;
  ImRect rect;
  ImGuiID scope;  // the id that its label was hashed with

  [[nodiscard]] bool is_called(const std::string& label) const {
    return ImHashStr(label.c_str(), 0, scope) == id;
  }
  [[nodiscard]] ItemRect place() const { return {rect.Min, rect.Max, id}; }
};
struct DrawnText {
  std::string text;
  ImRect rect;
  const ImGuiWindow* window;  // the outermost one
};

// The newest frame that drew an item or a text.
struct Log {
  int frame = -1;
  std::vector<DrawnItem> items;
  std::map<ImGuiID, std::string> names;
  std::vector<DrawnText> texts;
};
Log drawn_log;

// Returns false for a call outside the windows of the application.
bool begin_entry() {
  const ImGuiContext* context = ImGui::GetCurrentContext();
  const ImGuiWindow* window = context->CurrentWindow;
  if (window == nullptr || window->IsFallbackWindow) return false;
  if (drawn_log.frame != context->FrameCount) drawn_log = {context->FrameCount, {}, {}, {}};
  return true;
}

void note_text(ImVec2 place, const char* text, const char* end) {
  if (!begin_entry()) return;
  const std::string whole = end != nullptr ? std::string(text, end) : std::string(text);
  const std::string shown = whole.substr(0, whole.find("##"));
  const ImVec2 size = ImGui::CalcTextSize(shown.c_str());
  drawn_log.texts.push_back({shown, ImRect(place, ImVec2(place.x + size.x, place.y + size.y)),
                             ImGui::GetCurrentContext()->CurrentWindow->RootWindow});
}

// The part of a label that makes its id.
std::string name_of(std::string_view label) {
  const std::size_t mark = label.find("##");
  if (mark == std::string_view::npos) return std::string(label);
  label.remove_prefix(mark);
  while (label.starts_with('#')) label.remove_prefix(1);
  return std::string(label);
}

// "Plots###page Plots/cursor table_5678CDEF" is "cursor table".
std::string name_of(const ImGuiWindow& window) {
  std::string name = window.Name;
  if (const std::size_t slash = name.rfind('/'); slash != std::string::npos) {
    name.erase(0, slash + 1);
    name.erase(std::min(name.rfind('_'), name.size()));
  }
  return name_of(name);
}

void add_windows(Items& items) {
  std::string newest;
  for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows) {
    if (!window->WasActive && !window->Active) continue;
    std::string name = name_of(*window);
    const bool toast = name.starts_with("toast") && name != "toasts";
    if (toast) name.insert(5, " ");
    const ItemRect rect{window->Pos,
                        ImVec2(window->Pos.x + window->Size.x, window->Pos.y + window->Size.y)};
    items.insert_or_assign(name, rect);
    if (!toast || (newest.size() > name.size() || (newest.size() == name.size() && newest > name)))
      continue;
    newest = name;
    items.insert_or_assign("message", rect);
  }
}

void add_plots(Items& items) {
  if (ImPlot::GetCurrentContext() == nullptr) return;
  for (const DrawnItem& item : drawn_log.items) {
    const ImPlotPlot* plot = ImPlot::GetCurrentContext()->Plots.GetByKey(item.id);
    if (plot == nullptr) continue;
    for (const char* title : {"Position", "Force", "Stiffness", "Passivity", "Phase",
                              "Wake-up latency", "Compute time"}) {
      const std::string name = std::string("plot ") + title;
      if (item.is_called("##" + name))
        items.insert_or_assign(name, ItemRect{plot->PlotRect.Min, plot->PlotRect.Max});
    }
  }
}

// The gaps between docked windows report no label. "gap 0" is that of the whole dock area.
void add_gaps(Items& items) {
  int count = 0;
  for (const DrawnItem& item : drawn_log.items) {
    if (item.is_called("##Splitter"))
      items.insert_or_assign("gap " + std::to_string(count++), item.place());
  }
}

}  // namespace

void watch_items() { ImGui::GetCurrentContext()->TestEngineHookItems = true; }

void watch_items_beside_engine() {
  ImGuiContextHook hook;
  hook.Type = ImGuiContextHookType_NewFramePost;
  hook.Callback = [](ImGuiContext*, ImGuiContextHook*) { watch_items(); };
  ImGui::AddContextHook(ImGui::GetCurrentContext(), &hook);
}

Items drawn_items() {
  Items items;
  add_windows(items);
  for (const DrawnText& text : drawn_log.texts)
    items.try_emplace(text.text, ItemRect{text.rect.Min, text.rect.Max});
  for (const DrawnItem& item : drawn_log.items) {
    if (ImGui::FindWindowByID(item.id) != nullptr) continue;
    if (const auto name = drawn_log.names.find(item.id); name != drawn_log.names.end())
      items.insert_or_assign(name->second, item.place());
  }
  add_plots(items);
  add_gaps(items);
  return items;
}

std::optional<ItemRect> find_item(std::string_view name) {
  constexpr std::string_view kAndMore = "…";
  if (name.ends_with(kAndMore)) {
    name.remove_suffix(kAndMore.size());
    for (const DrawnText& text : drawn_log.texts) {
      if (text.text.starts_with(name)) return ItemRect{text.rect.Min, text.rect.Max};
    }
    return std::nullopt;
  }
  const Items items = drawn_items();
  const auto found = items.find(name);
  const bool is_text = found != items.end() && found->second.id == 0 &&
                       std::ranges::any_of(drawn_log.texts, [&](const DrawnText& text) {
                         return text.text == name;
                       });
  if (found != items.end() && !is_text) return found->second;
  // Lists, and items scrolled out of sight, report no label. They come before a text that says the
  // same elsewhere.
  for (const DrawnItem& item : drawn_log.items) {
    for (const char* mark : {"##", "###", ""}) {
      if (item.is_called(mark + std::string(name))) return item.place();
    }
  }
  return is_text ? std::optional(found->second) : std::nullopt;
}

bool draws_text(std::string_view window, std::string_view text) {
  return std::ranges::any_of(drawn_log.texts, [&](const DrawnText& drawn) {
    return drawn.text == text && name_of(*drawn.window) == window;
  });
}

}  // namespace hapticwall::test

// The linker leads these calls of Dear ImGui through here (tests/CMakeLists.txt).
// NOLINTBEGIN(bugprone-reserved-identifier, readability-identifier-naming)
extern "C" {

void __real__Z27ImGuiTestEngineHook_ItemAddP12ImGuiContextjRK6ImRectPK17ImGuiLastItemData(
    ImGuiContext*, ImGuiID, const ImRect&, const ImGuiLastItemData*);
void __wrap__Z27ImGuiTestEngineHook_ItemAddP12ImGuiContextjRK6ImRectPK17ImGuiLastItemData(
    ImGuiContext* context, ImGuiID id, const ImRect& rect, const ImGuiLastItemData* data) {
  if (hapticwall::test::begin_entry())
    hapticwall::test::drawn_log.items.push_back({id, rect, context->CurrentWindow->IDStack.back()});
  if (context->TestEngine != nullptr)
    __real__Z27ImGuiTestEngineHook_ItemAddP12ImGuiContextjRK6ImRectPK17ImGuiLastItemData(
        context, id, rect, data);
}

void __real__Z28ImGuiTestEngineHook_ItemInfoP12ImGuiContextjPKci(ImGuiContext*, ImGuiID,
                                                                 const char*, int);
void __wrap__Z28ImGuiTestEngineHook_ItemInfoP12ImGuiContextjPKci(ImGuiContext* context, ImGuiID id,
                                                                 const char* label, int flags) {
  if (hapticwall::test::begin_entry())
    hapticwall::test::drawn_log.names[id] = hapticwall::test::name_of(label);
  if (context->TestEngine != nullptr)
    __real__Z28ImGuiTestEngineHook_ItemInfoP12ImGuiContextjPKci(context, id, label, flags);
}

void __real__ZN5ImGui10RenderTextE6ImVec2PKcS2_b(ImVec2, const char*, const char*, bool);
void __wrap__ZN5ImGui10RenderTextE6ImVec2PKcS2_b(ImVec2 place, const char* text, const char* end,
                                                 bool hide) {
  hapticwall::test::note_text(place, text, end);
  __real__ZN5ImGui10RenderTextE6ImVec2PKcS2_b(place, text, end, hide);
}

void __real__ZN5ImGui17RenderTextWrappedE6ImVec2PKcS2_f(ImVec2, const char*, const char*, float);
void __wrap__ZN5ImGui17RenderTextWrappedE6ImVec2PKcS2_f(ImVec2 place, const char* text,
                                                        const char* end, float width) {
  hapticwall::test::note_text(place, text, end);
  __real__ZN5ImGui17RenderTextWrappedE6ImVec2PKcS2_f(place, text, end, width);
}

void __real__ZN10ImDrawList7AddTextERK6ImVec2jPKcS4_(ImDrawList*, const ImVec2&, ImU32, const char*,
                                                     const char*);
void __wrap__ZN10ImDrawList7AddTextERK6ImVec2jPKcS4_(ImDrawList* list, const ImVec2& place,
                                                     ImU32 colour, const char* text,
                                                     const char* end) {
  hapticwall::test::note_text(place, text, end);
  __real__ZN10ImDrawList7AddTextERK6ImVec2jPKcS4_(list, place, colour, text, end);
}

}  // extern "C"
// NOLINTEND(bugprone-reserved-identifier, readability-identifier-naming)
