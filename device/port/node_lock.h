// One host a device: an exclusive flock(2) on the node itself. It holds between processes, needs no
// other file, and the kernel releases it when the process dies. A POSIX lock (fcntl) would be lost
// when the process closes any descriptor of the node, and hidapi has others.
// Realtime-safe: no, none of it.
#pragma once

#include <memory>
#include <string>

#include "core/result.h"

namespace hapticwall::device::hid {

class NodeLock {
 public:
  // Locks `node` until destroyed. Does not wait, sends nothing to the device. Fails with
  // ErrorKind::kDevice if another host has it, and names that program; `path` is for the message.
  [[nodiscard]] static Result<std::shared_ptr<NodeLock>> take(const std::string& node,
                                                              const std::string& path);

  NodeLock(const NodeLock&) = delete;
  NodeLock& operator=(const NodeLock&) = delete;
  ~NodeLock();

  // True if it is the lock of this node: a device that was plugged in again has another one.
  [[nodiscard]] bool is_of(const std::string& node) const;

 private:
  explicit NodeLock(int descriptor) : descriptor_(descriptor) {}

  int descriptor_;
};

}  // namespace hapticwall::device::hid
