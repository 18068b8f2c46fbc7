// A person uses the whole application in a real window. Without a display these tests are skipped.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "app/ui/window/window.h"
#include "tests/app/ui/fake_session.h"
#include "tests/temporary_folder.h"
#include "tests/window/person.h"

namespace hapticwall::test {

// The home folder of one test, with settings, recordings and scenes.
class Home {
 public:
  Home();

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_.path(); }
  // The path that the program derives from this home.
  [[nodiscard]] std::string settings_path() const;
  // Writes a built-in scene with --set changes under this name; returns its path.
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

class WindowTest : public ::testing::Test {
 protected:
  void SetUp() override;

  // Opens the window, runs the script, and closes the window.
  void use(const Script& script);

  // The next use() has a device, with a fake session that the test controls.
  void connect_device();
  [[nodiscard]] FakeSession& device() const { return *device_; }

  Home home_;
  session::WindowOptions options_;
  ItemLog log_;

 private:
  FakeSession* device_ = nullptr;
};

}  // namespace hapticwall::test
