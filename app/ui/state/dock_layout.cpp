#include "app/ui/state/dock_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "app/file/text/text.h"

namespace hapticwall::ui {
namespace {

constexpr std::size_t kMaxLayoutBytes = 2000;
constexpr int kMaxSplitDepth = 8;
constexpr double kWholePercent = 100.0;
constexpr std::string_view kMarks = "();,*+@";

void append_part(std::string& text, const DockPart& part) {
  if (part.split != DockSplit::kNone) {
    text += part.split == DockSplit::kColumns ? 'X' : 'Y';
    text += part.ems != 0.0 ? fmt::format("{:.2f}em", part.ems)
                            : fmt::format("{:.2f}%", part.share * kWholePercent);
    text += '(';
    append_part(text, part.parts.front());
    text += ';';
    append_part(text, part.parts.back());
    text += ')';
    return;
  }
  for (std::size_t i = 0; i < part.tabs.size(); ++i) {
    text += (i > 0 ? "," : "") + part.tabs[i];
    if (i == part.front && part.tabs.size() > 1) text += '*';
  }
}

// Reads from the front of `rest`. After a fault everything fails.
class LayoutReader {
 public:
  explicit LayoutReader(std::string_view text) : rest_(text) {}

  std::optional<DockLayout> layout() {
    DockLayout layout;
    if (!rest_.empty() && rest_.front() != '+') layout.docked = part(0);
    while (!failed_ && take('+')) layout.floating.push_back(floating());
    if (failed_ || !rest_.empty()) return std::nullopt;
    std::vector<std::string> windows = windows_of(layout);
    std::ranges::sort(windows);
    if (std::ranges::adjacent_find(windows) != windows.end()) return std::nullopt;
    return layout;
  }

 private:
  bool take(char mark) {
    if (rest_.empty() || rest_.front() != mark) return false;
    rest_.remove_prefix(1);
    return true;
  }

  void need(bool held) { failed_ = failed_ || !held; }

  // Takes the text before the next of these marks.
  std::string_view before(std::string_view marks) {
    const std::string_view found =
        rest_.substr(0, std::min(rest_.find_first_of(marks), rest_.size()));
    rest_.remove_prefix(found.size());
    return found;
  }

  double number(std::string_view text, double least, double most) {
    const std::optional<double> value = file::parsed<double>(text);
    need(value && *value >= least && *value <= most);
    return value.value_or(0.0);
  }

  double percent(std::string_view text, double least, double most) {
    need(text.ends_with('%'));
    text.remove_suffix(std::min<std::size_t>(text.size(), 1));
    return number(text, least * kWholePercent, most * kWholePercent) / kWholePercent;
  }

  void size(DockPart& part) {
    std::string_view text = before(kMarks);
    if (!text.ends_with("em")) {
      part.share = percent(text, kMinDockShare, kMaxDockShare);
      return;
    }
    text.remove_suffix(2);
    part.ems = number(text, -kMaxColumnEms, kMaxColumnEms);
    need(part.split == DockSplit::kColumns && std::abs(part.ems) >= kMinColumnEms);
  }

  // A name begins with X or Y, too, but no size and parenthesis follow.
  bool split_follows() const {
    const std::size_t mark = rest_.find_first_of(kMarks);
    return mark != std::string_view::npos && rest_[mark] == '(';
  }

  DockPart part(int depth) {
    need(depth <= kMaxSplitDepth);
    if (failed_ || !split_follows()) return leaf();
    DockPart part;
    part.split = take('X') ? DockSplit::kColumns : DockSplit::kRows;
    need(part.split == DockSplit::kColumns || take('Y'));
    size(part);
    need(take('('));
    part.parts.push_back(this->part(depth + 1));
    need(take(';'));
    part.parts.push_back(this->part(depth + 1));
    need(take(')'));
    return part;
  }

  DockPart leaf() {
    DockPart leaf;
    do {
      leaf.tabs.emplace_back(before(kMarks));
      need(!leaf.tabs.back().empty());
      if (take('*')) leaf.front = leaf.tabs.size() - 1;
    } while (!failed_ && take(','));
    return leaf;
  }

  FloatingPart floating() {
    FloatingPart floating{part(0), {}};
    DockPlace& place = floating.place;
    need(take('@'));
    for (double* value : {&place.x, &place.y, &place.width, &place.height}) {
      const bool length = value == &place.width || value == &place.height;
      *value = percent(before(kMarks), length ? kMinDockShare : 0.0, 1.0);
      need(value == &place.height || take(','));
    }
    return floating;
  }

  std::string_view rest_;
  bool failed_ = false;
};

void append_windows(std::vector<std::string>& windows, const DockPart& part) {
  windows.insert(windows.end(), part.tabs.begin(), part.tabs.end());
  for (const DockPart& each : part.parts) append_windows(windows, each);
}

DockPart part_without(DockPart part, std::span<const std::string> windows) {
  if (part.split == DockSplit::kNone) {
    const std::string front = part.tabs.empty() ? "" : part.tabs[part.front];
    std::erase_if(part.tabs, [&](const std::string& tab) {
      return std::ranges::find(windows, tab) != windows.end();
    });
    const auto kept = std::ranges::find(part.tabs, front);
    part.front = kept == part.tabs.end() ? 0 : static_cast<std::size_t>(kept - part.tabs.begin());
    return part;
  }
  for (DockPart& each : part.parts) each = part_without(std::move(each), windows);
  if (part.parts.front().empty()) return std::exchange(part.parts.back(), {});
  if (part.parts.back().empty()) return std::exchange(part.parts.front(), {});
  return part;
}

DockPart& last_leaf(DockPart& part) {
  return part.parts.empty() ? part : last_leaf(part.parts.back());
}

DockPart* leaf_of(DockPart& part, std::string_view window) {
  if (std::ranges::find(part.tabs, window) != part.tabs.end()) return &part;
  for (DockPart& each : part.parts) {
    if (DockPart* leaf = leaf_of(each, window)) return leaf;
  }
  return nullptr;
}

DockPart* leaf_of(DockLayout& layout, std::string_view window) {
  if (DockPart* leaf = leaf_of(layout.docked, window)) return leaf;
  for (FloatingPart& each : layout.floating) {
    if (DockPart* leaf = leaf_of(each.part, window)) return leaf;
  }
  return nullptr;
}

}  // namespace

std::string layout_text(const DockLayout& layout) {
  std::string text;
  append_part(text, layout.docked);
  for (const auto& [part, place] : layout.floating) {
    text += '+';
    append_part(text, part);
    text += fmt::format("@{:.2f}%,{:.2f}%,{:.2f}%,{:.2f}%", place.x * kWholePercent,
                        place.y * kWholePercent, place.width * kWholePercent,
                        place.height * kWholePercent);
  }
  return text;
}

std::optional<DockLayout> parse_layout(std::string_view text) {
  if (text.size() > kMaxLayoutBytes) return std::nullopt;
  return LayoutReader(text).layout();
}

std::vector<std::string> windows_of(const DockLayout& layout) {
  std::vector<std::string> windows;
  append_windows(windows, layout.docked);
  for (const FloatingPart& each : layout.floating) append_windows(windows, each.part);
  return windows;
}

DockLayout without(const DockLayout& layout, std::span<const std::string> windows) {
  DockLayout rest{part_without(layout.docked, windows), {}};
  for (const auto& [part, place] : layout.floating)
    rest.floating.push_back({part_without(part, windows), place});
  std::erase_if(rest.floating, [](const FloatingPart& each) { return each.part.empty(); });
  return rest;
}

void bring_to_front(DockLayout& layout, const std::string& window) {
  DockPart* leaf = leaf_of(layout, window);
  if (leaf == nullptr) {
    leaf = leaf_of(layout, kPlotsPage);
    if (leaf == nullptr) leaf = &last_leaf(layout.docked);
    leaf->tabs.push_back(window);
  }
  leaf->front =
      static_cast<std::size_t>(std::ranges::find(leaf->tabs, window) - leaf->tabs.begin());
}

}  // namespace hapticwall::ui
