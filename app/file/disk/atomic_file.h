// A file that takes its name only when it is whole.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/result.h"

namespace hapticwall::file {

// What is not whole yet.
inline constexpr std::string_view kPartialEnding = ".partial";

// Written as PATH.partial (locked: one writer at a time); commit() puts it on the disk and gives it
// its name, which replaces an older file at once. Every error is of ErrorKind::kFile and names the
// file. Realtime-safe: no.
class AtomicFile {
 public:
  // Refuses a PATH that exists and is no regular file, a PATH.partial that another process holds,
  // and one that leads elsewhere: a symbolic link, a pipe, a file that has another name too.
  [[nodiscard]] static Result<AtomicFile> create(const std::string& path);
  // The same, but what stands in PATH.partial stays, and writing goes on behind it.
  [[nodiscard]] static Result<AtomicFile> resume(const std::string& path);

  AtomicFile(AtomicFile&& other) noexcept;
  AtomicFile& operator=(AtomicFile&& other) noexcept;
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  // Without commit() the final name is not touched; the partial file goes, unless it is to be kept.
  ~AtomicFile();

  void keep_partial() { keep_partial_ = true; }
  // Cuts the file to its first `bytes`; writing goes on there.
  [[nodiscard]] Failure keep_only(std::uint64_t bytes);
  // Fails at once where somebody has removed PATH.partial, or its folder.
  [[nodiscard]] Failure write(std::string_view bytes);
  // On the disk, still without its name. Fails where PATH.partial was moved, too: what was written
  // is where it was moved to.
  [[nodiscard]] Failure sync();
  [[nodiscard]] Failure commit();  // sync(), then the name

  [[nodiscard]] std::uint64_t size() const;  // bytes; 0 where it is no regular file

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

// Gives a file another name, which replaces what had it.
[[nodiscard]] Failure rename_file(const std::string& from, const std::string& to);

// A whole small file in one call.
[[nodiscard]] Failure write_file(const std::string& path, std::string_view bytes);

}  // namespace hapticwall::file
