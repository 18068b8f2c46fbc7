// Every control and value has a tooltip.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <imgui_internal.h>

#include <set>

#include "app/ui/widget/widgets.h"
#include "tests/app/ui/gui_test.h"

namespace hapticwall::test {
namespace {

class TooltipsTest : public GuiTest {
 protected:
  // Hovers an item; returns true if a tooltip appears.
  bool explains(const std::string& item) {
    move_to(ImVec2(2.0F, 2.0F));
    frames(2);
    move_to(rect(item).centre());
    constexpr int kPatientFrames = 60;
    frames(kPatientFrames);
    const ImGuiWindow* tooltip = ImGui::FindWindowByName("##Tooltip_00");
    return tooltip != nullptr && tooltip->Active;
  }
  void expect_explained(const std::string& prefix) {
    std::set<std::string> names;
    for (const auto& [name, item] : drawn_items()) {
      const bool seen = item.from.y > 0.0F && item.to.y < static_cast<float>(kScreenHeight) - 60.0F;
      if (name.starts_with(prefix) && seen) names.insert(name);
    }
    EXPECT_FALSE(names.empty()) << prefix;
    for (const std::string& name : names) EXPECT_TRUE(explains(name)) << name;
  }
};

TEST_F(TooltipsTest, EveryParameterAndButtonSaysWhatItIs) {
  live(2000);
  press(ImGuiKey_4);
  for (const char* name : {"undo",
                           "settings",
                           "help",
                           "scene",
                           "Figure 4",
                           "none",
                           "energy-bounding",
                           "stiffness",
                           "stiffness-slider",
                           "damping",
                           "damping-slider",
                           "position",
                           "bound, passive",
                           "rate",
                           "integrator",
                           "cost of a tick",
                           "energy error",
                           "pause",
                           "step",
                           "reset",
                           "record",
                           "recording name",
                           "algorithm.rest_force_step_n",
                           "Simulator",
                           "missed",
                           "wake-up",
                           "compute",
                           "plot drops",
                           "frame"}) {
    if (std::string(name) == "undo") type("stiffness", "20000");
    EXPECT_TRUE(explains(name)) << name;
  }
}

TEST_F(TooltipsTest, EveryRowOfTheHandSaysWhatItIs) {
  click("section Hand");
  frames(2);
  expect_explained("hand.");
  expect_explained("switch hand.");
  EXPECT_TRUE(explains("end position"));
  EXPECT_TRUE(explains("approach speed"));
}

TEST_F(TooltipsTest, EveryRowOfTheDeviceSaysWhatItIs) {
  click("section Device");
  frames(2);
  expect_explained("device.");
}

}  // namespace
}  // namespace hapticwall::test
