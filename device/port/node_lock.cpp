#include "device/port/node_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <fstream>
#include <string>
#include <system_error>

#include "device/link/port.h"

namespace hapticwall::device::hid {
namespace {

// "00:05:123", as /proc/locks names a file.
std::string name_in_locks(const struct stat& file) {
  char text[48];
  std::snprintf(text, sizeof text, "%02x:%02x:%llu", ::major(file.st_dev), ::minor(file.st_dev),
                static_cast<unsigned long long>(file.st_ino));
  return text;
}

// Process that holds the flock of a file; 0: it has ended, or is in another container.
long holder_of(int descriptor) {
  struct stat file {};
  if (::fstat(descriptor, &file) != 0) return 0;
  const std::string wanted = name_in_locks(file);
  std::ifstream locks("/proc/locks");
  // 1: FLOCK  ADVISORY  WRITE 1234 00:05:123 0 EOF; a process that waits has "->" after the number.
  std::string number;
  std::string kind;
  std::string advisory;
  std::string access;
  std::string rest;
  std::string where;
  for (long process = 0; locks >> number >> kind; std::getline(locks, rest)) {
    if (kind == "FLOCK" && locks >> advisory >> access >> process >> where && where == wanted) {
      return process;
    }
  }
  return 0;
}

std::string program_of(long process) {
  if (process <= 0) return "another program";
  std::string name;
  std::ifstream comm("/proc/" + std::to_string(process) + "/comm");
  std::getline(comm, name);
  // A process chooses its name, which could hold a terminal's commands.
  std::ranges::replace_if(
      name, [](char letter) { return letter < ' ' || letter > '~'; }, '?');
  const std::string number = "process " + std::to_string(process);
  return name.empty() ? number : name + " (" + number + ")";
}

}  // namespace

Result<std::shared_ptr<NodeLock>> NodeLock::take(const std::string& node, const std::string& path) {
  const int descriptor = ::open(node.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK);
  const auto lock = std::shared_ptr<NodeLock>(new NodeLock(descriptor));
  if (descriptor >= 0 && ::flock(descriptor, LOCK_EX | LOCK_NB) == 0) return lock;
  if (descriptor >= 0 && errno == EWOULDBLOCK) {
    return device_error(in_use_text(path, program_of(holder_of(descriptor))));
  }
  return device_error(path + " cannot be opened: " + std::generic_category().message(errno));
}

NodeLock::~NodeLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

bool NodeLock::is_of(const std::string& node) const {
  struct stat locked {};
  struct stat there {};
  return ::fstat(descriptor_, &locked) == 0 && ::stat(node.c_str(), &there) == 0 &&
         locked.st_dev == there.st_dev && locked.st_ino == there.st_ino;
}

}  // namespace hapticwall::device::hid
