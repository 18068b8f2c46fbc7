#include "app/file/disk/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <system_error>
#include <utility>

#include "app/file/text/text.h"

namespace hapticwall::file {
namespace {

constexpr mode_t kNewFileMode = 0666;  // before the umask
constexpr mode_t kWriteOfOthers = S_IWGRP | S_IWOTH;
constexpr int kMaxLinks = 40;  // the kernel's limit

Error system_error_of(const std::string& path, std::string_view what, int code) {
  return file_error(
      fmt::format("{}: {}: {}", shown(path), what, std::generic_category().message(code)));
}

std::filesystem::path folder_of(const std::filesystem::path& path) {
  return path.has_parent_path() ? path.parent_path() : ".";
}

// True if the name still refers to the open file: another process may rename it between open and
// lock.
bool is_still_named(int descriptor, const std::string& path) {
  struct stat opened {};
  struct stat named {};
  return fstat(descriptor, &opened) == 0 && lstat(path.c_str(), &named) == 0 &&
         opened.st_ino == named.st_ino && opened.st_dev == named.st_dev;
}

// Read from /proc, because umask() would set it for the other threads, too.
mode_t file_mask() {
  constexpr mode_t kUsual = 0022;
  constexpr std::string_view kKey = "Umask:";
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with(kKey)) {
      return static_cast<mode_t>(std::strtoul(line.c_str() + kKey.size(), nullptr, 8));
    }
  }
  return kUsual;
}

// Reason why an older file must not be overwritten, or an empty text. A folder from elsewhere could
// hold a link that leads out of the folder, or a file whose rows another process may still change.
// `mode`: of a new file.
std::string_view strangeness(const struct stat& status, mode_t mode) {
  if (S_ISLNK(status.st_mode)) return "is a symbolic link";
  if (!S_ISREG(status.st_mode)) return "is not a regular file";
  if (status.st_nlink > 1) return "has a second name";
  if (status.st_uid != geteuid()) return "belongs to another user";
  const mode_t given = mode & ~file_mask();
  return (status.st_mode & kWriteOfOthers & ~given) != 0 ? "can be written by others" : "";
}

// Creates the file or opens an older one; on failure returns -1, and why the file is strange.
int open_checked(const char* path, int flags, mode_t mode, std::string_view& strange) {
  flags |= O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC;
  const int created = open(path, flags | O_CREAT | O_EXCL, mode);
  // Some file systems give a new file other permissions or another owner: only an older one is
  // checked.
  if (created >= 0 || errno != EEXIST) return created;
  const int descriptor = open(path, flags);
  const int code = errno;
  struct stat status {};
  const int known = descriptor < 0 ? lstat(path, &status) : fstat(descriptor, &status);
  if (known == 0) strange = strangeness(status, mode);
  if (descriptor >= 0 && strange.empty()) return descriptor;
  if (descriptor >= 0) close(descriptor);
  errno = code;
  return -1;
}

// A link in /proc leads to an open file: returns its `descriptor` if this process has it open.
bool leads_to_open_file(const std::filesystem::path& link, std::optional<int>& descriptor) {
  std::error_code failed;
  const auto folder = std::filesystem::canonical(folder_of(link), failed);
  if (failed || !folder.string().starts_with("/proc/")) return false;
  if (folder == std::filesystem::canonical("/proc/self/fd", failed)) {
    descriptor = parsed<int>(link.filename().string());
  }
  return true;
}

Error cannot_write(const std::string& path, std::string_view why) {
  return file_error(fmt::format("{}: cannot be written: {}", shown(path), why));
}

}  // namespace

void sync_folder(const std::string& path) {
  const int descriptor = open(folder_of(path).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  fsync(descriptor);
  close(descriptor);
}

Result<OutputPlace> output_place(const std::string& path) {
  OutputPlace place{path, PlaceKind::kFile, std::nullopt};
  struct stat status {};
  for (int links = 0; lstat(place.path.c_str(), &status) == 0 && S_ISLNK(status.st_mode);) {
    if (leads_to_open_file(place.path, place.descriptor)) {
      place.kind = PlaceKind::kStream;
      return place;
    }
    if (status.st_uid != geteuid() && status.st_uid != 0) {
      return cannot_write(path, "it is a symbolic link of another user");
    }
    std::error_code failed;
    const auto target = std::filesystem::read_symlink(place.path, failed);
    if (failed || ++links > kMaxLinks) return cannot_write(path, "its link leads nowhere");
    place.path = std::filesystem::path(place.path).parent_path() / target;
  }
  if (stat(place.path.c_str(), &status) != 0) return place;
  if (S_ISDIR(status.st_mode)) place.kind = PlaceKind::kFolder;
  if (!S_ISDIR(status.st_mode) && !S_ISREG(status.st_mode)) place.kind = PlaceKind::kStream;
  if (S_ISREG(status.st_mode) && (status.st_mode & S_IWUSR) == 0) {
    return cannot_write(place.path, "it is read-only; choose another name, or 'chmod u+w' it");
  }
  return place;
}

Result<std::string> replaceable_path(const std::string& path) {
  Result<OutputPlace> place = output_place(path);
  if (!place) return place.error();
  if (place->kind == PlaceKind::kFile) return std::move(place->path);
  return cannot_write(path, "it exists and is not a regular file");
}

Result<int> open_own(const std::string& path, const OwnFile& how) {
  std::string_view strange;
  const int descriptor = open_checked(path.c_str(), how.flags, how.mode, strange);
  if (descriptor < 0 && !strange.empty()) {
    return cannot_write(how.name, path == how.name
                                      ? fmt::format("it {}; choose another name", strange)
                                      : fmt::format("{} {}; remove it", shown(path), strange));
  }
  if (descriptor < 0) return system_error_of(how.name, "cannot be written", errno);
  if (flock(descriptor, LOCK_EX | LOCK_NB) == 0 && is_still_named(descriptor, path))
    return descriptor;
  close(descriptor);
  return cannot_write(how.name, "another process is writing it");
}

Result<AtomicFile> AtomicFile::create(const std::string& path) {
  Result<AtomicFile> file = resume(path);
  if (!file || file->size() == 0) return file;
  if (Failure failed = file->keep_only(0)) return *failed;
  return file;
}

Result<AtomicFile> AtomicFile::resume(const std::string& path) {
  const Result<std::string> place = replaceable_path(path);
  if (!place) return place.error();
  const std::string partial_path = partial_of(*place);
  const Result<int> descriptor = open_own(partial_path, {O_WRONLY, kNewFileMode, *place});
  if (!descriptor) return descriptor.error();
  return AtomicFile(*place, partial_path, *descriptor);
}

AtomicFile::AtomicFile(std::string path, std::string partial_path, int descriptor)
    : path_(std::move(path)), partial_path_(std::move(partial_path)), descriptor_(descriptor) {}

AtomicFile::AtomicFile(AtomicFile&& other) noexcept
    : path_(std::move(other.path_)),
      partial_path_(std::move(other.partial_path_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      keep_partial_(other.keep_partial_) {}

AtomicFile& AtomicFile::operator=(AtomicFile&& other) noexcept {
  if (this == &other) return *this;
  discard();
  path_ = std::move(other.path_);
  partial_path_ = std::move(other.partial_path_);
  descriptor_ = std::exchange(other.descriptor_, -1);
  keep_partial_ = other.keep_partial_;
  return *this;
}

AtomicFile::~AtomicFile() { discard(); }

void AtomicFile::discard() {
  if (descriptor_ < 0) return;
  // A new file of this name belongs to another process.
  if (!keep_partial_ && is_still_named(descriptor_, partial_path_)) unlink(partial_path_.c_str());
  close(std::exchange(descriptor_, -1));
}

Error AtomicFile::failure(std::string_view what) const {
  Error error = system_error_of(path_, what, errno);
  if (keep_partial_) {
    error.message += fmt::format(" (the written part is in {})", shown(partial_path_));
  }
  return error;
}

std::uint64_t AtomicFile::size() const {
  struct stat status {};
  if (fstat(descriptor_, &status) != 0 || !S_ISREG(status.st_mode)) return 0;
  return static_cast<std::uint64_t>(status.st_size);
}

Failure AtomicFile::keep_only(std::uint64_t bytes) {
  const auto length = static_cast<off_t>(bytes);
  if (ftruncate(descriptor_, length) != 0 || lseek(descriptor_, length, SEEK_SET) < 0) {
    return failure("cannot be written");
  }
  return {};
}

// True if the last name was removed: the data is unreachable. A moved file is not removed.
bool AtomicFile::is_removed() const {
  struct stat status {};
  return fstat(descriptor_, &status) == 0 && status.st_nlink == 0 &&
         !is_still_named(descriptor_, partial_path_);
}

Error AtomicFile::lost() const {
  return file_error(fmt::format("{}: could not be written: {} was {} during the writing",
                                shown(path_), shown(partial_path_),
                                is_removed() ? "removed" : "moved"));
}

Failure AtomicFile::write(std::string_view bytes) {
  if (is_removed()) return lost();
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return failure("could not be written");
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return {};
}

Failure AtomicFile::secure() {
  // EINVAL: the file system does not support fsync.
  if (fsync(descriptor_) != 0 && errno != EINVAL) return failure("could not be written");
  return {};
}

Failure AtomicFile::sync() {
  if (!is_still_named(descriptor_, partial_path_)) return lost();
  return secure();
}

Failure AtomicFile::commit() {
  if (Failure failed = sync()) return failed;
  if (std::rename(partial_path_.c_str(), path_.c_str()) != 0) return failure("cannot be renamed");
  close(std::exchange(descriptor_, -1));
  sync_folder(path_);
  return {};
}

Failure rename_file(const std::string& from, const std::string& to) {
  if (std::rename(from.c_str(), to.c_str()) != 0)
    return system_error_of(to, "cannot be renamed", errno);
  sync_folder(to);
  return {};
}

Failure write_file(const std::string& path, std::string_view bytes) {
  Result<AtomicFile> file = AtomicFile::create(path);
  if (!file) return file.error();
  if (Failure failed = file->write(bytes)) return failed;
  return file->commit();
}

}  // namespace hapticwall::file
