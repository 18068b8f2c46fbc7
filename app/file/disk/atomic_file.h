// A file that gets its name only when it is complete.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/result.h"

namespace hapticwall::file {

// Ending of an incomplete file.
inline constexpr std::string_view kPartialEnding = ".partial";
[[nodiscard]] inline std::string partial_of(const std::string& path) {
  return path + std::string(kPartialEnding);
}

enum class PlaceKind : std::uint8_t { kFile, kFolder, kStream };

// Destination of an output: its path with links followed.
struct OutputPlace {
  std::string path;
  PlaceKind kind = PlaceKind::kFile;  // kFile also for a new file
  // Descriptor of a stream that this process has open, as /dev/stdout.
  std::optional<int> descriptor;
};

// A pipe, a device and a link of /proc to an open file are streams: they have no name to replace.
// Fails for a file without write permission, also as root, and for a link of another user.
[[nodiscard]] Result<OutputPlace> output_place(const std::string& path);

// The path of the place; fails for a folder or a stream.
[[nodiscard]] Result<std::string> replaceable_path(const std::string& path);

struct OwnFile {
  int flags = 0;     // O_WRONLY, O_RDWR, O_APPEND
  mode_t mode = 0;   // mode of a new file, before the umask
  std::string name;  // name in messages
};

// Creates a file, or opens one of this user, and locks it as long as the descriptor is open.
// Refuses a file that another process holds, and an older one that is a link, a pipe or a file with
// another name, belongs to another user or can be written by more users than a new one.
// Realtime-safe: no.
[[nodiscard]] Result<int> open_own(const std::string& path, const OwnFile& how);

// Writes to PATH.partial, which it locks. commit() syncs the file and renames it, which replaces an
// older file atomically. A link keeps its name: its target is the PATH. Errors are ErrorKind::kFile
// and name the file. Realtime-safe: no.
class AtomicFile {
 public:
  // Refuses what replaceable_path() refuses, and a PATH.partial that open_own() refuses.
  [[nodiscard]] static Result<AtomicFile> create(const std::string& path);
  // create(), but keeps the content of PATH.partial; writing continues after keep_only().
  [[nodiscard]] static Result<AtomicFile> resume(const std::string& path);

  AtomicFile(AtomicFile&& other) noexcept;
  AtomicFile& operator=(AtomicFile&& other) noexcept;
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  // Removes the partial file if it was not committed, unless keep_partial() was called.
  ~AtomicFile();

  void keep_partial() { keep_partial_ = true; }
  // Truncates the file to `bytes`; writing continues there.
  [[nodiscard]] Failure keep_only(std::uint64_t bytes);
  // Fails at once if PATH.partial or its folder was removed.
  [[nodiscard]] Failure write(std::string_view bytes);
  // Puts on the disk what is written so far.
  [[nodiscard]] Failure secure();
  [[nodiscard]] Failure sync();    // secure(); fails also if PATH.partial was moved
  [[nodiscard]] Failure commit();  // sync(), then rename

  [[nodiscard]] std::uint64_t size() const;  // bytes; 0 if it is no regular file

  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] const std::string& partial_path() const { return partial_path_; }

 private:
  AtomicFile(std::string path, std::string partial_path, int descriptor);
  void discard();
  [[nodiscard]] bool is_removed() const;
  [[nodiscard]] Error lost() const;
  [[nodiscard]] Error failure(std::string_view what) const;  // reads errno

  std::string path_;
  std::string partial_path_;
  int descriptor_ = -1;
  bool keep_partial_ = false;
};

// Syncs the folder of a file, so that its name is durable. Best effort: some file systems cannot.
void sync_folder(const std::string& path);

// Renames a file, and replaces an existing one.
[[nodiscard]] Failure rename_file(const std::string& from, const std::string& to);

// Writes a small file in one call.
[[nodiscard]] Failure write_file(const std::string& path, std::string_view bytes);

}  // namespace hapticwall::file
