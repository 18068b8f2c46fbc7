// The loop's side of a link never allocates.
#include <gtest/gtest.h>

#include <cstdlib>
#include <new>

#include "tests/device/link/link_rig.h"

namespace {

// Allocations of this thread, since the count was last set to 0.
thread_local std::size_t allocations = 0;

void* counted(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}

}  // namespace

// GCC reports a mismatch if it inlines free() but not `new`.
[[gnu::noinline]] void* operator new(std::size_t size) { return counted(size); }
[[gnu::noinline]] void* operator new[](std::size_t size) { return counted(size); }
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete[](void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t /*size*/) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete[](void* memory, std::size_t /*size*/) noexcept {
  std::free(memory);
}

namespace hapticwall::device {
namespace {

using testing::Rig;

std::size_t allocations_of_a_turn(Rig& rig) {
  allocations = 0;
  rig.host.loop.enable(false);
  rig.host.loop.enable(true);
  const AxesReading reading = rig.host.loop.read();
  rig.host.loop.write({reading.position_m[0], 0.0});
  const LinkStats stats = rig.host.loop.stats();
  EXPECT_GE(stats.age_s, 0.0);
  return allocations;
}

TEST(LinkPurity, TheLoopsSideAllocatesNothing) {
  Rig rig;
  EXPECT_EQ(allocations_of_a_turn(rig), 0U);  // before the first link-up
  rig.drive_until_ms(100);
  EXPECT_EQ(allocations_of_a_turn(rig), 0U);  // up
  rig.plug.hidden = true;
  for (int i = 0; i < 30; ++i) {
    rig.host.tick();
    ASSERT_EQ(allocations_of_a_turn(rig), 0U);  // lost
  }
  // The counter works.
  allocations = 0;
  int* volatile seen = new int(7);  // volatile: an unused pair could be removed
  delete seen;
  EXPECT_GE(allocations, 1U);
}

}  // namespace
}  // namespace hapticwall::device
