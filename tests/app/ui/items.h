// What the window has drawn in the last frame, as Dear ImGui's own test hooks and text calls tell
// it.
//
// An item is called by its id: "###record" and "##rate" are "record" and "rate". A text is called
// by what it says, a child window by its name, a plot by "plot " and its title.
#pragma once

#include <imgui.h>

#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace hapticwall::test {

struct ItemRect {
  ImVec2 from;
  ImVec2 to;
  ImGuiID id = 0;  // 0: nothing that takes the pointer by itself

  [[nodiscard]] ImVec2 centre() const { return {0.5F * (from.x + to.x), 0.5F * (from.y + to.y)}; }
};

using Items = std::map<std::string, ItemRect, std::less<>>;

// Everything of the last frame. The newest toast is called "message", too.
[[nodiscard]] Items drawn_items();
// The item or text of this name; "FORCE…" is the first text that begins with "FORCE".
[[nodiscard]] std::optional<ItemRect> find_item(std::string_view name);

// Dear ImGui reports items only after this; call it for every frame without the test engine.
void watch_items();
// The same with the test engine, which decides for every new frame: call it once, after the start
// of the engine.
void watch_items_beside_engine();

}  // namespace hapticwall::test
