// Paths of the tests' files and of the programs that the tests start.
#pragma once

#include <string>

namespace hapticwall::test {

const std::string& data_folder();  // tests/ of the sources
const std::string& program();      // hapticwall
const std::string& emulator_program();
const std::string& plugin_folder();  // tests/plugins and the examples, built

}  // namespace hapticwall::test
