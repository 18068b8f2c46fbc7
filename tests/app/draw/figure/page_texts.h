// The texts of a drawn page: what they cover, and places that they name.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "app/draw/figure/paper.h"
#include "app/draw/figure/shapes.h"
#include "app/file/picture.h"

namespace hapticwall::test {

struct PixelArea {
  int left = 0;
  int top = 0;
  int right = 0;
  int bottom = 0;
};

inline const std::vector<file::DrawnText>& texts_of(const file::Picture& figure) {
  return figure.shapes.front().shapes->texts;
}

// By how far the boxes overlap in the direction in which they do so less; at most 0: they do not.
inline double overlap(const cairo_rectangle_t& a, const cairo_rectangle_t& b) {
  const double across = std::min(a.x + a.width, b.x + b.width) - std::max(a.x, b.x);
  const double down = std::min(a.y + a.height, b.y + b.height) - std::max(a.y, b.y);
  return std::min(across, down);
}

inline bool lies_within(const cairo_rectangle_t& box, const cairo_rectangle_t& area) {
  constexpr double kExact = 0.5;  // pixels; a letter's edge is smoothed
  return box.x >= area.x - kExact && box.y >= area.y - kExact &&
         box.x + box.width <= area.x + area.width + kExact &&
         box.y + box.height <= area.y + area.height + kExact;
}

// No text is too small, beyond the page, cut off, or over another one.
inline void expect_readable(const file::Picture& figure) {
  constexpr double kMinPoints = 6.5;
  constexpr double kRounding = 0.01;  // points
  for (const file::PlacedShapes& part : figure.shapes) {
    const std::vector<file::DrawnText>& texts = part.shapes->texts;
    ASSERT_FALSE(texts.empty());
    for (std::size_t i = 0; i < texts.size(); ++i) {
      EXPECT_GE(draw::points_of_pixels(texts[i].em), kMinPoints - kRounding) << texts[i].text;
      EXPECT_TRUE(lies_within(texts[i].ink, part.shapes->page)) << texts[i].text << ": the edge";
      EXPECT_TRUE(lies_within(texts[i].ink, texts[i].clip)) << texts[i].text << " is cut off";
      for (std::size_t j = 0; j < i; ++j) {
        EXPECT_LE(overlap(texts[i].ink, texts[j].ink), 0.0)
            << "'" << texts[i].text << "' over '" << texts[j].text << "'";
      }
    }
  }
}

// Texts from the first to the last, one line each, without their order on the page.
inline std::string all_texts(const file::Picture& figure) {
  std::string all;
  for (const file::DrawnText& each : texts_of(figure)) all += each.text + "\n";
  return all;
}

// The first text that begins so; fails without one.
inline const file::DrawnText& find_text(const file::Picture& figure, std::string_view start) {
  const auto& texts = texts_of(figure);
  const auto found = std::ranges::find_if(
      texts, [&](const file::DrawnText& each) { return each.text.starts_with(start); });
  EXPECT_NE(found, texts.end()) << all_texts(figure) << "no text '" << start << "'";
  return found == texts.end() ? texts.front() : *found;
}

}  // namespace hapticwall::test
