#include "core/algorithm/plugin/library_call.h"

#include <gtest/gtest.h>

#include <cfenv>
#include <functional>
#include <stdexcept>
#include <string>

namespace hapticwall {
namespace {

LibraryFault fault_of(const std::function<void()>& function) {
  return call_library({.library = "mine", .function = "step()"}, function);
}

TEST(LibraryCall, IsKnownWhileItLasts) {
  EXPECT_EQ(present_library_call(), nullptr);
  std::string seen;
  EXPECT_EQ(fault_of([&] { seen = present_library_call()->function; }), LibraryFault::kNone);
  EXPECT_EQ(seen, "step()");
  EXPECT_EQ(present_library_call(), nullptr);
}

TEST(LibraryCall, StopsAnException) {
  EXPECT_EQ(fault_of([] { throw std::runtime_error("a fault"); }), LibraryFault::kThrew);
  EXPECT_EQ(present_library_call(), nullptr);
}

TEST(LibraryCall, RestoresTheRoundingMode) {
  for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    EXPECT_EQ(fault_of([mode] { std::fesetround(mode); }), LibraryFault::kChangedFloat);
    EXPECT_EQ(std::fegetround(), FE_TONEAREST);
  }
  EXPECT_EQ(fault_of([] {
              std::fesetround(FE_UPWARD);
              std::fesetround(FE_TONEAREST);
            }),
            LibraryFault::kNone);
}

TEST(LibraryCall, RestoresTheRoundingModeAfterAnException) {
  EXPECT_EQ(fault_of([] {
              std::fesetround(FE_UPWARD);
              throw std::runtime_error("a fault");
            }),
            LibraryFault::kThrew);
  EXPECT_EQ(std::fegetround(), FE_TONEAREST);
}

TEST(LibraryCall, AFlagOfAnInexactResultIsNoSetting) {
  EXPECT_EQ(fault_of([] { std::feraiseexcept(FE_INEXACT | FE_DIVBYZERO); }), LibraryFault::kNone);
  std::feclearexcept(FE_ALL_EXCEPT);
}

#if defined(__SSE__)
TEST(LibraryCall, RestoresDenormalsAndTheSettingsOfX87) {
  constexpr std::uint32_t kNoDenormals = 0x8040;
  const FloatSettings before = float_settings();
  EXPECT_EQ(fault_of([] { __builtin_ia32_ldmxcsr(__builtin_ia32_stmxcsr() | kNoDenormals); }),
            LibraryFault::kChangedFloat);
  EXPECT_EQ(float_settings(), before);
  EXPECT_EQ(fault_of([] {
              const std::uint16_t single_precision = 0x007F;
              asm volatile("fldcw %0" : : "m"(single_precision));
            }),
            LibraryFault::kChangedFloat);
  EXPECT_EQ(float_settings(), before);
}
#endif

}  // namespace
}  // namespace hapticwall
