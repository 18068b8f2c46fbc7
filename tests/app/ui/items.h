// Items and texts that the window drew in the last frame, from the test hooks and text calls of
// Dear ImGui.
//
// The name of an item is its id: "###record" and "##rate" are "record" and "rate". The name of a
// text is the text, of a child window its name, of a plot "plot " and its title.
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
  ImGuiID id = 0;  // 0: a text, a window or a plot

  // The place at these shares of width and height.
  [[nodiscard]] ImVec2 at(float x_share, float y_share) const {
    return {from.x + x_share * (to.x - from.x), from.y + y_share * (to.y - from.y)};
  }
  [[nodiscard]] ImVec2 centre() const { return at(0.5F, 0.5F); }
  [[nodiscard]] bool holds(ImVec2 place) const {
    return place.x >= from.x && place.x <= to.x && place.y >= from.y && place.y <= to.y;
  }
  [[nodiscard]] bool meets(const ItemRect& other) const {
    return from.x < other.to.x && other.from.x < to.x && from.y < other.to.y && other.from.y < to.y;
  }
};

using Items = std::map<std::string, ItemRect, std::less<>>;

// All items of the last frame. The newest toast has the second name "message".
[[nodiscard]] Items drawn_items();
// The item or text of this name; "FORCE…" is the first text that begins with "FORCE".
[[nodiscard]] std::optional<ItemRect> find_item(std::string_view name);
// True if this window has drawn this text. Text that is scrolled out of sight is not drawn.
[[nodiscard]] bool draws_text(std::string_view window, std::string_view text);

// Dear ImGui reports items only after this; call it for every frame without the test engine.
void watch_items();
// Like watch_items(), but with the test engine, which decides for every new frame: call it once,
// after the start of the engine.
void watch_items_beside_engine();

}  // namespace hapticwall::test
