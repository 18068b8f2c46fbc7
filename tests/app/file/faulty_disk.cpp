#include "tests/app/file/faulty_disk.h"

#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <condition_variable>
#include <mutex>

namespace hapticwall::file::test {
namespace {

struct Disk {
  std::mutex mutex;
  std::condition_variable released;
  bool limited = false;
  std::size_t room = 0;  // bytes, where it is limited
  int write_code = 0;
  int sync_code = 0;
  bool held = false;
  int waiting = 0;
};

Disk& disk() {
  static Disk one;
  return one;
}

// How many of `size` bytes may be written; none: errno says why.
std::size_t allowed(std::size_t size) {
  Disk& one = disk();
  std::unique_lock lock(one.mutex);
  ++one.waiting;
  one.released.wait(lock, [&] { return !one.held; });
  --one.waiting;
  if (!one.limited) return size;
  const std::size_t taken = std::min(size, one.room);
  one.room -= taken;
  if (taken == 0) errno = one.write_code;
  return taken;
}

int sync_code() {
  const std::scoped_lock lock(disk().mutex);
  return disk().sync_code;
}

void change(void (*how)(Disk&)) {
  const std::scoped_lock lock(disk().mutex);
  how(disk());
  disk().released.notify_all();
}

void repair(Disk& one) {
  one.limited = false;
  one.sync_code = 0;
  one.held = false;
}

}  // namespace

FaultyDisk::FaultyDisk() { change(repair); }
FaultyDisk::~FaultyDisk() { change(repair); }

void FaultyDisk::fail_after(std::size_t bytes, int code) {
  const std::scoped_lock lock(disk().mutex);
  disk().limited = true;
  disk().room = bytes;
  disk().write_code = code;
}

void FaultyDisk::fail_sync(int code) {
  const std::scoped_lock lock(disk().mutex);
  disk().sync_code = code;
}

void FaultyDisk::hold() {
  change([](Disk& one) { one.held = true; });
}

bool FaultyDisk::holds_somebody() const {
  const std::scoped_lock lock(disk().mutex);
  return disk().held && disk().waiting > 0;
}

void FaultyDisk::release() {
  change([](Disk& one) { one.held = false; });
}

}  // namespace hapticwall::file::test

extern "C" {

ssize_t write(int descriptor, const void* bytes, std::size_t size) {
  const std::size_t allowed = hapticwall::file::test::allowed(size);
  if (allowed == 0 && size > 0) return -1;
  return syscall(SYS_write, descriptor, bytes, allowed);
}

int fsync(int descriptor) {
  if (const int code = hapticwall::file::test::sync_code(); code != 0) {
    errno = code;
    return -1;
  }
  return static_cast<int>(syscall(SYS_fsync, descriptor));
}

}  // extern "C"
