// The host's side of a call into a library of the user: it stops exceptions, restores the settings
// of floating-point arithmetic, and says which call a thread is in.
#pragma once

#include <cfenv>
#include <cstdint>
#include <string_view>

#include "core/result.h"
#include "core/tick/pulse.h"

namespace hapticwall {

// Floating-point settings of a thread: rounding mode, denormals and traps, without the flags of
// past exceptions. `word` and `x87` are MXCSR and the x87 control word; on other processors `word`
// is FPCR or, where neither is known, the rounding mode.
struct FloatSettings {
  std::uint64_t word = 0;
  std::uint16_t x87 = 0;

  friend bool operator==(const FloatSettings&, const FloatSettings&) = default;
};

// Settings of this thread. Takes a few nanoseconds, where std::fegetenv() takes tens.
// Realtime-safe: yes, both.
[[nodiscard]] inline FloatSettings float_settings() {
  FloatSettings settings;
#if defined(__SSE__)
  constexpr std::uint32_t kFlags = 0x3F;
  settings.word = __builtin_ia32_stmxcsr() & ~kFlags;
  asm volatile("fnstcw %0" : "=m"(settings.x87));
#elif defined(__aarch64__)
  asm volatile("mrs %0, fpcr" : "=r"(settings.word));
#else
  settings.word = static_cast<std::uint64_t>(std::fegetround());
#endif
  return settings;
}

// On x86 it clears the flags of past exceptions, too: a pending one would trap once its trap is
// enabled.
inline void restore(const FloatSettings& settings) {
#if defined(__SSE__)
  __builtin_ia32_ldmxcsr(static_cast<std::uint32_t>(settings.word));
  asm volatile("fnclex\n\tfldcw %0" : : "m"(settings.x87));
#elif defined(__aarch64__)
  asm volatile("msr fpcr, %0" : : "r"(settings.word));
#else
  std::fesetround(static_cast<int>(settings.word));
#endif
}

// An exception counts before changed settings, if a call has both.
enum class LibraryFault : std::uint8_t { kNone, kThrew, kChangedFloat };

// A clause for people: "threw an exception".
[[nodiscard]] constexpr std::string_view library_fault_text(LibraryFault fault) {
  if (fault == LibraryFault::kThrew) return "threw an exception";
  return fault == LibraryFault::kChangedFloat
             ? "changed the rounding mode or another setting of floating-point arithmetic"
             : "";
}

// All pointers live until the call returns.
struct LibraryCall {
  const char* library = "";   // its name or path
  const char* function = "";  // "step()"
  ErrorKind kind = ErrorKind::kUsage;
  Pulse* pulse = nullptr;  // beats during the call; nullptr: a call that hangs holds nobody
  // Removes the force if the call ends the process; nullptr: others do. Called on this thread.
  void (*remove_force)(void* owner) noexcept = nullptr;
  void* owner = nullptr;
};

namespace detail {
inline constinit thread_local const LibraryCall* present_call = nullptr;
}

// The call that this thread is in; nullptr: none. A signal handler may ask. Realtime-safe: yes.
[[nodiscard]] inline const LibraryCall* present_library_call() { return detail::present_call; }

// Calls `function()`. Neither an exception nor other settings of floating-point arithmetic leave
// it. Realtime-safe: yes.
template <class Function>
LibraryFault call_library(const LibraryCall& call, const Function& function) {
  const FloatSettings before = float_settings();
  LibraryFault fault = LibraryFault::kNone;
  if (call.pulse != nullptr) call.pulse->beat();
  detail::present_call = &call;
  try {
    function();
  } catch (...) {
    fault = LibraryFault::kThrew;
  }
  detail::present_call = nullptr;
  if (call.pulse != nullptr) call.pulse->rest();
  if (float_settings() == before) return fault;
  restore(before);
  return fault == LibraryFault::kNone ? LibraryFault::kChangedFloat : fault;
}

}  // namespace hapticwall
