// Calls of functions that Python brings, which hear of their exceptions.
#pragma once

#include <cstdint>
#include <exception>
#include <utility>

namespace hapticwall::python {

enum class Calling : std::uint8_t { kNothing, kFunction, kFunctionThatRaised };

// Call that this thread is in. The fast model of thread-local storage: one load a tick.
#if defined(__GNUC__)
__attribute__((tls_model("initial-exec")))
#endif
inline constinit thread_local Calling calling = Calling::kNothing;

// Ends in the host of the plug-in, which takes NaN for the force.
struct FunctionRaised : std::exception {};

// Calls a function of Python. ctypes and numba print an exception and return 0; note_raised() hears
// of it.
template <typename Call>
auto heard(const Call& call) {
  calling = Calling::kFunction;
  const auto result = call();
  if (std::exchange(calling, Calling::kNothing) == Calling::kFunctionThatRaised)
    throw FunctionRaised();
  return result;
}
// heard() for a function without a result. An address of 0 is not called.
template <typename Function, typename... Arguments>
void heard_if_given(Function* function, Arguments... arguments) {
  if (function == nullptr) return;
  heard([&] {
    function(arguments...);
    return true;
  });
}

}  // namespace hapticwall::python
