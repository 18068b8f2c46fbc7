// umockdev redirects open(), stat() and access(), and does not know faccessat(): the same for it,
// for the mocked nodes. Ours wins because it is in the executable.
#include <dlfcn.h>
#include <unistd.h>

#include <cstdlib>
#include <string>

extern "C" int faccessat(int folder, const char* path, int mode, int flags) noexcept {
  using Function = int (*)(int, const char*, int, int);
  static const auto kOriginal = reinterpret_cast<Function>(::dlsym(RTLD_NEXT, "faccessat"));
  const char* root = std::getenv("UMOCKDEV_DIR");  // NOLINT(concurrency-mt-unsafe)
  const std::string wanted = path;
  if (root == nullptr || !wanted.starts_with("/dev/hidraw")) {
    return kOriginal(folder, path, mode, flags);
  }
  return kOriginal(folder, (root + wanted).c_str(), mode, flags);
}
