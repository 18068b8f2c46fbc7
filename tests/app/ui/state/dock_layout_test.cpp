// Arrangements of windows and their text.
#include "app/ui/state/dock_layout.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <random>
#include <string>

namespace hapticwall::test {
namespace {

using ::testing::ElementsAre;
using ui::bring_to_front;
using ui::DockLayout;
using ui::layout_text;
using ui::parse_layout;
using ui::without;

constexpr const char* kBench =
    "X21.50em(Controls;Y40.00%(X62.00%(Wall;Contact);Plots,Timing*,Map))"
    "+Blind test@10.00%,20.00%,30.00%,40.00%";

TEST(DockLayout, AnArrangementIsReadBackFromItsText) {
  for (const char* text :
       {kBench, "Wall", "", "X-21.50em(Plots;Controls)", "Y5.00%(Wall;Plots*,Map)",
        "+Y50.00%(Wall;Map)@0.00%,0.00%,100.00%,5.00%"}) {
    const auto layout = parse_layout(text);
    ASSERT_TRUE(layout.has_value()) << text;
    EXPECT_EQ(layout_text(*layout), text);
  }
  const DockLayout bench = *parse_layout(kBench);
  EXPECT_THAT(windows_of(bench),
              ElementsAre("Controls", "Wall", "Contact", "Plots", "Timing", "Map", "Blind test"));
  EXPECT_EQ(bench.docked.ems, 21.5);
  EXPECT_EQ(bench.docked.parts.back().share, 0.4);
  EXPECT_EQ(bench.docked.parts.back().parts.back().front, 1U);
  EXPECT_EQ(bench.floating.front().place, (ui::DockPlace{0.1, 0.2, 0.3, 0.4}));
}

TEST(DockLayout, ADamagedTextIsRefused) {
  std::string deep = "Wall";
  for (int i = 0; i < 9; ++i) deep.insert(0, "Y50%(" + std::to_string(i) + ";").append(")");
  for (const std::string& text :
       {std::string("X50%(Wall"),       std::string("X50%(Wall;)"),
        std::string("X50%(;Wall)"),     std::string("X50%(Wall;Map;Plots)"),
        std::string("X50%(Wall;Map))"), std::string("Z50%(Wall;Map)"),
        std::string("X(Wall;Map)"),     std::string("X50(Wall;Map)"),
        std::string("X99%(Wall;Map)"),  std::string("Xnan%(Wall;Map)"),
        std::string("X7em(Wall;Map)"),  std::string("X61em(Wall;Map)"),
        std::string("Y20em(Wall;Map)"), std::string("Wall,"),
        std::string("Wall,Wall"),       std::string("X50%(Wall;Wall)"),
        std::string("Wall+Map"),        std::string("+Map@0%,0%,1%,50%"),
        std::string("+Map@0%,0%,50%"),  std::string("Wall+"),
        std::string("+@0%,0%,50%,50%"), std::string("Wall@"),
        std::string(2001, 'W'),         deep}) {
    EXPECT_FALSE(parse_layout(text).has_value()) << text;
  }
}

// A text of which a few bytes are others is refused, or is that of another arrangement.
TEST(DockLayout, AnyBytesAreReadOrRefused) {
  std::mt19937 random(5);
  const std::string whole = kBench;
  std::uniform_int_distribution<std::size_t> place(0, whole.size() - 1);
  const std::string bytes = "XY(;)%,*+@. 019emWall";
  std::uniform_int_distribution<std::size_t> byte(0, bytes.size() - 1);
  int read = 0;
  for (int round = 0; round < 20000; ++round) {
    std::string text = whole;
    for (int i = 0; i <= round % 4; ++i) text[place(random)] = bytes[byte(random)];
    if (round % 7 == 0) text.resize(place(random));
    const auto layout = parse_layout(text);
    if (!layout) continue;
    ++read;
    const auto again = parse_layout(layout_text(*layout));
    ASSERT_TRUE(again.has_value()) << text;
    EXPECT_EQ(windows_of(*again), windows_of(*layout));
  }
  EXPECT_GT(read, 500);
}

TEST(DockLayout, WhatIsLeftFillsThePlaceOfWhatIsTakenOut) {
  const DockLayout bench = *parse_layout(kBench);
  const std::array<std::string, 4> hidden{"Contact", "Plots", "Timing", "Map"};
  EXPECT_EQ(layout_text(without(bench, hidden)),
            "X21.50em(Controls;Wall)+Blind test@10.00%,20.00%,30.00%,40.00%");
  EXPECT_EQ(layout_text(without(bench, std::array<std::string, 2>{"Plots", "Blind test"})),
            "X21.50em(Controls;Y40.00%(X62.00%(Wall;Contact);Timing*,Map))");
  const std::vector<std::string> all = windows_of(bench);
  EXPECT_EQ(layout_text(without(bench, all)), "");
}

TEST(DockLayout, AWindowComesToTheFrontOrBesideThePlots) {
  DockLayout layout = *parse_layout("Y40%(Wall;Plots*,Timing)");
  bring_to_front(layout, "Timing");
  EXPECT_EQ(layout_text(layout), "Y40.00%(Wall;Plots,Timing*)");
  bring_to_front(layout, "Map");
  EXPECT_EQ(layout_text(layout), "Y40.00%(Wall;Plots,Timing,Map*)");
  layout = *parse_layout("X21.5em(Controls;Wall)");
  bring_to_front(layout, "Map");
  EXPECT_EQ(layout_text(layout), "X21.50em(Controls;Wall,Map*)");
  layout = *parse_layout("");
  bring_to_front(layout, "Map");
  EXPECT_EQ(layout_text(layout), "Map");
  layout = *parse_layout("Wall+Plots@0%,0%,50%,50%");
  bring_to_front(layout, "Map");
  EXPECT_EQ(layout_text(layout), "Wall+Plots,Map*@0.00%,0.00%,50.00%,50.00%");
}

}  // namespace
}  // namespace hapticwall::test
