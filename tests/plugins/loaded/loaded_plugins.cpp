#include "tests/plugins/loaded/loaded_plugins.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>

#include "app/file/plugin/plugin_file.h"
#include "core/algorithm/plugin/include/hapticwall/plugin.h"
#include "core/algorithm/plugin/plugin_list.h"
#include "tests/paths.h"
#include "tests/temporary_folder.h"

namespace hapticwall::test {
namespace {

std::string library(const std::string& name) { return plugin_folder() + "/" + name + ".so"; }

double hooked_step(void* /*state*/, const hw_input* in, double* /*signals*/) {
  if (in_each_step()) in_each_step()();
  return in->wall_force_n;
}

const hw_plugin kHooked{HAPTICWALL_PLUGIN_ABI,
                        sizeof(hw_plugin),
                        3000,  // the largest state: there is room for twice as much
                        0,
                        0,
                        nullptr,
                        nullptr,
                        "test-hooked",
                        "Hooked",
                        "for tests",
                        "",
                        [](void* /*state*/, const hw_context* /*context*/) {},
                        [](void* /*state*/) {},
                        hooked_step};

class LoadsPlugins : public ::testing::Environment {
 public:
  void SetUp() override {
    rebuild("full");
    rebuilt = load(rebuilt_path());
    load(library("bounding_c"));
    hooked = add_plugin(kHooked);
  }

  TemporaryFolder folder;
  std::size_t rebuilt = 0;
  std::size_t hooked = 0;

 private:
  static std::size_t load(const std::string& path) {
    const Result<std::size_t> index = file::load_plugin(path);
    if (!index) throw std::runtime_error(index.error().message);
    return *index;
  }
};

LoadsPlugins& loaded() {
  static auto* const kEnvironment = new LoadsPlugins;  // GoogleTest deletes it
  return *kEnvironment;
}
const ::testing::Environment* const kRegistered = ::testing::AddGlobalTestEnvironment(&loaded());

}  // namespace

std::size_t rebuilt_plugin() { return loaded().rebuilt; }
const std::string& rebuilt_path() {
  static const std::string kPath = loaded().folder.file("mine.so");
  return kPath;
}

void rebuild(const std::string& plugin) {
  const std::string next = rebuilt_path() + ".next";
  std::filesystem::copy_file(library("plugin_" + plugin), next,
                             std::filesystem::copy_options::overwrite_existing);
  std::filesystem::rename(next, rebuilt_path());
}

std::size_t hooked_plugin() { return loaded().hooked; }
std::function<void()>& in_each_step() {
  static std::function<void()> call;
  return call;
}

}  // namespace hapticwall::test
