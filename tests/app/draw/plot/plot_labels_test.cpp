#include "app/draw/plot/plot_labels.h"

#include <gtest/gtest.h>
#include <imgui.h>

#include <array>
#include <limits>

namespace hapticwall::draw {
namespace {

constexpr PixelBox kArea{{0.0F, 0.0F}, {400.0F, 100.0F}};
constexpr ImVec2 kSize{50.0F, 10.0F};

class PlotLabelsTest : public ::testing::Test {
 protected:
  void SetUp() override { ImGui::NewFrame(); }
  void TearDown() override { ImGui::EndFrame(); }

 private:
  class Gui {
   public:
    Gui() {
      ImGui::CreateContext();
      ImGui::GetIO().DisplaySize = {400.0F, 100.0F};
      ImGui::GetIO().IniFilename = nullptr;
      ImGui::GetIO().BackendFlags |= ImGuiBackendFlags_RendererHasTextures;
    }
    Gui(const Gui&) = delete;
    Gui& operator=(const Gui&) = delete;
    ~Gui() { ImGui::DestroyContext(); }
  } gui_;
};

TEST_F(PlotLabelsTest, ALabelTakesTheFirstPlaceThatNoTraceCrosses) {
  PlotInk ink;
  ink.take(std::array{ImVec2(0.0F, 50.0F), ImVec2(400.0F, 50.0F)}, 2.0F);
  const std::array corners{ImVec2(340.0F, 45.0F), ImVec2(340.0F, 38.0F), ImVec2(340.0F, 52.0F)};
  const auto place = take_free_place(ink, kArea, kSize, corners);
  ASSERT_TRUE(place.has_value());
  EXPECT_EQ(place->y, 38.0F);
  const auto second = take_free_place(ink, kArea, kSize, corners);
  ASSERT_TRUE(second.has_value());
  EXPECT_EQ(second->y, 52.0F) << "nor on another label";
  EXPECT_FALSE(take_free_place(ink, kArea, kSize, corners).has_value());
}

TEST_F(PlotLabelsTest, ALabelStaysWithinThePlot) {
  PlotInk ink;
  const std::array outside{ImVec2(360.0F, 20.0F), ImVec2(-1.0F, 20.0F), ImVec2(50.0F, -1.0F),
                           ImVec2(50.0F, 95.0F)};
  EXPECT_FALSE(take_free_place(ink, kArea, kSize, outside).has_value());
}

TEST_F(PlotLabelsTest, AGapInATraceTakesNoPlace) {
  constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();
  PlotInk ink;
  ink.take(std::array{ImVec2(0.0F, 5.0F), ImVec2(200.0F, kNothing), ImVec2(390.0F, 95.0F)}, 2.0F);
  EXPECT_TRUE(take_free_place(ink, kArea, kSize, std::array{ImVec2(200.0F, 40.0F)}).has_value());
}

}  // namespace
}  // namespace hapticwall::draw
