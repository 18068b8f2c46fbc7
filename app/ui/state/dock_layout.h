// Arrangements of the dock windows: a tree of splits with tabs as leaves, and its text for the
// settings file.
//
// The text of a split is "X21.5em(FIRST;SECOND)" for columns or "Y40%(FIRST;SECOND)" for rows, with
// the size of the first part. "X-21.5em" gives the width of the second one. A leaf names its tabs,
// "Plots*,Timing"; the star marks the one in front. Windows that float follow, with their place as
// shares of the dock area: "+Map@10%,10%,50%,60%" is x, y, width and height.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hapticwall::ui {

// Windows that the code names; pages() has them all.
inline constexpr const char* kControlsPage = "Controls";
inline constexpr const char* kPlotsPage = "Plots";
inline constexpr const char* kBlindTestPage = "Blind test";

enum class DockSplit : std::uint8_t { kNone, kColumns, kRows };

inline constexpr double kMinDockShare = 0.05;
inline constexpr double kMaxDockShare = 0.95;
inline constexpr double kMinColumnEms = 8.0;
inline constexpr double kMaxColumnEms = 60.0;

struct DockPart {
  DockSplit split = DockSplit::kNone;
  double share = 0.5;             // size of the first part,
  double ems = 0.0;               // or, unless 0, in text sizes: > 0 of the first, < 0 the second
  std::vector<DockPart> parts;    // two of a split
  std::vector<std::string> tabs;  // tabs of a leaf
  std::size_t front = 0;          // index of the tab in front

  [[nodiscard]] bool empty() const { return parts.empty() && tabs.empty(); }
  [[nodiscard]] bool operator==(const DockPart&) const = default;
};

// Shares of the dock area.
struct DockPlace {
  double x = 0.0;
  double y = 0.0;
  double width = 0.5;
  double height = 0.5;

  [[nodiscard]] bool operator==(const DockPlace&) const = default;
};

struct FloatingPart {
  DockPart part;
  DockPlace place;

  [[nodiscard]] bool operator==(const FloatingPart&) const = default;
};

struct DockLayout {
  DockPart docked;
  std::vector<FloatingPart> floating;

  [[nodiscard]] bool operator==(const DockLayout&) const = default;
};

[[nodiscard]] std::string layout_text(const DockLayout& layout);
// Nullopt for a damaged text: of another form, over 2000 bytes, with a size out of range, more than
// 8 splits deep, or with a window twice.
[[nodiscard]] std::optional<DockLayout> parse_layout(std::string_view text);

// All windows, from the first part to the last.
[[nodiscard]] std::vector<std::string> windows_of(const DockLayout& layout);
// The layout without these windows; the others fill their place.
[[nodiscard]] DockLayout without(const DockLayout& layout, std::span<const std::string> windows);
// Puts the window in front of its tabs. A window that the layout lacks becomes a tab beside the
// plots, else in the last leaf.
void bring_to_front(DockLayout& layout, const std::string& window);

}  // namespace hapticwall::ui
