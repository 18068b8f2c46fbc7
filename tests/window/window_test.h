// The whole window as it is shipped, used by somebody: in a real window on the display, and without
// any display.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "app/ui/window/window.h"
#include "tests/app/ui/fake_session.h"
#include "tests/temporary_folder.h"
#include "tests/window/person.h"

namespace hapticwall::test {

enum class Screen : std::uint8_t { kNone, kDisplay };
[[nodiscard]] std::string screen_name(const ::testing::TestParamInfo<Screen>& info);

// A home of its own for each test: settings, recordings and scenes lie in it.
class Home {
 public:
  Home();

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_.path(); }
  // As the program finds it, in this home.
  [[nodiscard]] std::string settings_path() const;
  // Writes a scene of this name, which is a built-in one with --set changes; returns its path.
  [[nodiscard]] std::string write_scene(const std::string& name, const std::string& builtin,
                                        const std::vector<std::string>& changes = {}) const;
  // The scene 'press' with a second wall behind the first.
  [[nodiscard]] std::string write_scene_of_two_walls(const std::string& name) const;
  [[nodiscard]] std::vector<std::string> files(const std::string& ending) const;

 private:
  [[nodiscard]] std::string write(Scene scene, const std::string& name) const;

  TemporaryFolder folder_;
};

using Script = std::function<void(Person&)>;

class WindowTest : public ::testing::TestWithParam<Screen> {
 protected:
  void SetUp() override;

  // Opens the window, lets somebody do what the script says, and closes it.
  void use(const Script& script);

  // The next use() is of a device: a session without a clock, which a test can look into.
  void connect_device();
  [[nodiscard]] FakeSession& device() const { return *device_; }

  Home home_;
  runtime::WindowOptions options_;
  ItemLog log_;

 private:
  FakeSession* device_ = nullptr;
};

}  // namespace hapticwall::test

// Both kinds of screen for a class of tests.
#define HAPTICWALL_ON_BOTH_SCREENS(suite)                                                         \
  INSTANTIATE_TEST_SUITE_P(                                                                       \
      Screens, suite,                                                                             \
      ::testing::Values(::hapticwall::test::Screen::kNone, ::hapticwall::test::Screen::kDisplay), \
      ::hapticwall::test::screen_name)
