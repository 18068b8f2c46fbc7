// Compiled by itself: the paths of a checkout are in no other object, so that ccache serves the
// others to every checkout.
#include "tests/paths.h"

namespace hapticwall::test {

const std::string& data_folder() {
  static const std::string kPath = HAPTICWALL_TEST_DATA_DIR;
  return kPath;
}

const std::string& program() {
  static const std::string kPath = HAPTICWALL_BINARY;
  return kPath;
}

const std::string& emulator_program() {
  static const std::string kPath = HAPTICWALL_EMULATOR_BINARY;
  return kPath;
}

const std::string& plugin_folder() {
  static const std::string kPath = HAPTICWALL_TEST_PLUGINS_DIR;
  return kPath;
}

}  // namespace hapticwall::test
