// A full, limited or slow disk: replaces write() and fsync() of this process.
#pragma once

#include <cstddef>

namespace hapticwall::file::test {

// One at a time. Without any call, and after destruction, the disk is real.
class FaultyDisk {
 public:
  FaultyDisk();
  FaultyDisk(const FaultyDisk&) = delete;
  FaultyDisk& operator=(const FaultyDisk&) = delete;
  ~FaultyDisk();

  // Room for this many bytes; then every write fails with `code` of errno.
  void fail_after(std::size_t bytes, int code);
  void fail_sync(int code);

  // Writes wait for release().
  void hold();
  [[nodiscard]] bool holds_somebody() const;
  void release();
};

}  // namespace hapticwall::file::test
