// The plug-ins of these tests: an example, one that is built again, and one of the test itself.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace hapticwall::test {

// Its file is a copy of test plug-in `full`: its force is the wall's. `half` has half of it.
[[nodiscard]] std::size_t rebuilt_plugin();
[[nodiscard]] const std::string& rebuilt_path();
// Replaces the file by rename() with another test plug-in.
void rebuild(const std::string& plugin);

// Its force is the wall's; each step calls this.
[[nodiscard]] std::size_t hooked_plugin();
[[nodiscard]] std::function<void()>& in_each_step();

}  // namespace hapticwall::test
