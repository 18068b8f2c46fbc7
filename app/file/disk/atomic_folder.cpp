#include "app/file/disk/atomic_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <system_error>
#include <utility>

#include "app/file/disk/atomic_file.h"
#include "app/file/text/text.h"

namespace hapticwall::file {
namespace {

constexpr mode_t kNewFolderMode = 0777;  // before the umask
constexpr mode_t kNewFileInFolderMode = 0666;

Error folder_error(const std::string& path, std::string_view what) {
  return file_error(
      fmt::format("{}: {}: {}", shown(path), what, std::generic_category().message(errno)));
}

// Without slashes at the end; of a link, its target.
std::string place_of_folder(const std::string& path) {
  std::error_code failed;
  const std::filesystem::path real = std::filesystem::canonical(path, failed);
  if (!failed) return real;
  std::string place = path;
  while (place.size() > 1 && place.ends_with('/')) place.pop_back();
  return place;
}

// Why the folder cannot get this name; empty: it can.
std::string why_taken(const std::string& place) {
  std::error_code failed;
  const std::filesystem::file_status status = std::filesystem::symlink_status(place, failed);
  if (!std::filesystem::exists(status)) return "";
  if (!std::filesystem::is_directory(status)) return "it exists and is not a folder";
  const bool empty = std::filesystem::is_empty(place, failed);
  if (failed) return failed.message();
  return empty ? "" : "the folder is not empty";
}

bool write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

}  // namespace

Result<AtomicFolder> AtomicFolder::create(const std::string& path) {
  const std::string place = place_of_folder(path);
  if (const std::string why = why_taken(place); !why.empty()) {
    return file_error(
        fmt::format("{}: cannot be written: {}; choose another name", shown(path), why));
  }
  const std::string partial = partial_of(place);
  if (mkdir(partial.c_str(), kNewFolderMode) != 0) {
    if (errno != EEXIST) return folder_error(partial, "cannot be made");
    return file_error(fmt::format(
        "{}: exists: another run writes it, or one was killed; then remove it", shown(partial)));
  }
  const int descriptor = open(partial.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor >= 0) return AtomicFolder(place, partial, descriptor);
  const Error error = folder_error(partial, "cannot be opened");
  rmdir(partial.c_str());
  return error;
}

AtomicFolder::AtomicFolder(std::string path, std::string partial_path, int descriptor)
    : path_(std::move(path)), partial_path_(std::move(partial_path)), descriptor_(descriptor) {}

AtomicFolder::AtomicFolder(AtomicFolder&& other) noexcept
    : path_(std::move(other.path_)),
      partial_path_(std::move(other.partial_path_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      names_(std::move(other.names_)) {}

AtomicFolder& AtomicFolder::operator=(AtomicFolder&& other) noexcept {
  if (this == &other) return *this;
  discard();
  path_ = std::move(other.path_);
  partial_path_ = std::move(other.partial_path_);
  descriptor_ = std::exchange(other.descriptor_, -1);
  names_ = std::move(other.names_);
  return *this;
}

AtomicFolder::~AtomicFolder() { discard(); }

Failure AtomicFolder::write(const std::string& name, std::string_view bytes) {
  const int descriptor = openat(descriptor_, name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC,
                                kNewFileInFolderMode);
  if (descriptor < 0) return failure(fmt::format("{} cannot be made", shown(name)));
  names_.push_back(name);
  const bool written = write_all(descriptor, bytes);
  const int code = errno;
  const bool closed = close(descriptor) == 0;
  if (!written) errno = code;
  if (written && closed) return {};
  return failure(fmt::format("{} cannot be written", shown(name)));
}

// One sync for all files: a sync for each takes longer than to write it.
Failure AtomicFolder::commit() {
  if (syncfs(descriptor_) != 0) return failure("cannot be stored");
  if (rename(partial_path_.c_str(), path_.c_str()) != 0)
    return failure("the folder cannot get its name");
  close(std::exchange(descriptor_, -1));
  sync_folder(path_);
  return {};
}

void AtomicFolder::discard() {
  if (descriptor_ < 0) return;
  for (const std::string& name : names_) unlinkat(descriptor_, name.c_str(), 0);
  close(std::exchange(descriptor_, -1));
  rmdir(partial_path_.c_str());
}

Error AtomicFolder::failure(std::string_view what) const { return folder_error(path_, what); }

}  // namespace hapticwall::file
