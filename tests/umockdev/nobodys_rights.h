// Root may open anything: for the life of this object the process is somebody else.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

namespace hapticwall::test {

class NobodysRights {
 public:
  NobodysRights() : changed_(::geteuid() == 0 && ::setresuid(kNobody, kNobody, 0) == 0) {}
  NobodysRights(const NobodysRights&) = delete;
  NobodysRights& operator=(const NobodysRights&) = delete;
  ~NobodysRights() {
    if (changed_) EXPECT_EQ(::setresuid(0, 0, 0), 0);
  }

 private:
  static constexpr uid_t kNobody = 65534;
  bool changed_;
};

}  // namespace hapticwall::test
