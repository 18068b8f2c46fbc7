// Watches the files of the loaded plug-ins, and loads those that were built again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace hapticwall::file {

struct PluginNews {
  std::size_t algorithm = 0;
  bool loaded = false;  // a newer revision; otherwise the older one stays
  std::string text;     // for people, one line
};

// Realtime-safe: no; used by one thread.
class PluginWatch {
 public:
  static constexpr double kIntervalS = 0.25;

  // Looks at the files once in kIntervalS. Loads a file that is the same at two looks in a row: a
  // linker may still be writing it. Tells a problem once. `now_s`: the time on any clock.
  [[nodiscard]] std::vector<PluginNews> look(double now_s);

 private:
  struct Stamp {
    std::uint64_t device = 0;
    std::uint64_t file = 0;
    std::int64_t bytes = 0;
    std::int64_t changed_s = 0;
    std::int64_t changed_ns = 0;

    friend bool operator==(const Stamp&, const Stamp&) = default;
  };
  struct Watched {
    std::optional<Stamp> seen;
    std::optional<Stamp> tried;
  };
  [[nodiscard]] static std::optional<Stamp> stamp_of(const std::string& path);
  [[nodiscard]] std::optional<PluginNews> look_at(std::size_t algorithm, Watched& watched);

  std::vector<Watched> files_;  // algorithms from first_plugin() on
  std::optional<double> looked_s_;
};

}  // namespace hapticwall::file
