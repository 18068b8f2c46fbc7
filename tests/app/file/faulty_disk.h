// A disk that fills up, has a quota or takes its time: write() and fsync() of this process, as a
// test wants them.
#pragma once

#include <cstddef>

namespace hapticwall::file::test {

// One at a time. Without any call of it the disk is the real one; so it is again when it goes.
class FaultyDisk {
 public:
  FaultyDisk();
  FaultyDisk(const FaultyDisk&) = delete;
  FaultyDisk& operator=(const FaultyDisk&) = delete;
  ~FaultyDisk();

  // So many bytes still find room, the last of them in a write that is cut short; then every write
  // fails with `code`, of errno.
  void fail_after(std::size_t bytes, int code);
  void fail_sync(int code);

  // Whoever writes now waits for release().
  void hold();
  [[nodiscard]] bool holds_somebody() const;
  void release();
};

}  // namespace hapticwall::file::test
