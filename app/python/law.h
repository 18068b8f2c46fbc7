// Algorithms that Python brings: functions by their address, and plug-ins by their file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/algorithm/plugin/include/hapticwall/plugin.h"
#include "core/scene.h"

namespace hapticwall::python {

// Fields as in hw_parameter; NaN as fallback lets configure() choose.
struct LawParameter {
  std::string key;
  std::string unit;
  double minimum = 0.0;
  double maximum = 0.0;
  double fallback = 0.0;
  std::string meaning;

  friend bool operator==(const LawParameter& a, const LawParameter& b);
};

// Texts, state and parameters as in hw_plugin and hw_environment.
struct OwnPart {
  std::string name;
  std::string title;
  std::string idea;
  std::string equation;
  std::uint32_t state_bytes = 0;
  std::vector<LawParameter> parameters;
  bool takes_lock = false;  // its force is of Python: more threads would wait for each other
};

// Functions are addresses as in hw_plugin; 0: none.
struct Law : OwnPart {
  std::uintptr_t step = 0;
  std::uintptr_t configure = 0;
  std::uintptr_t reset = 0;
};

// Max laws of different names in a process. A law under the name of an earlier one takes its place.
inline constexpr std::size_t kMaxLaws = 64;

// Puts a law into the list of algorithms and gives its index. Raises ValueError for what a plug-in
// must not be, for another law's name with other parameters, and RuntimeError during a run.
std::size_t add_law(const Law& law);

// The index of a name or of a plug-in's path. Raises ValueError or OSError.
[[nodiscard]] std::size_t algorithm_index(const std::string& name_or_path);

// True if the algorithm's step() takes the interpreter's lock.
[[nodiscard]] bool takes_lock(std::size_t algorithm);
// True if the algorithm or the environment of a scene takes it.
[[nodiscard]] bool scene_takes_lock(const Scene& scene);

// The parameters as a plug-in has them; they point into `parameters`.
[[nodiscard]] std::vector<hw_parameter> c_parameters(const std::vector<LawParameter>& parameters);
// Raises RuntimeError during a run.
void refuse_while_running();

// Called where Python reports an exception that nobody can catch. True if a law of this thread
// raised it: the law's force is then NaN, and the law is not called again in this run.
[[nodiscard]] bool note_raised();

}  // namespace hapticwall::python
