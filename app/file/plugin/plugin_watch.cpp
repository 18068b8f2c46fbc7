#include "app/file/plugin/plugin_watch.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <utility>

#include "app/file/plugin/plugin_file.h"
#include "app/file/text/text.h"
#include "core/algorithm/algorithm.h"
#include "core/algorithm/plugin/plugin_list.h"

namespace hapticwall::file {

std::vector<PluginNews> PluginWatch::look(double now_s) {
  std::vector<PluginNews> news;
  if (looked_s_ && now_s - *looked_s_ < kIntervalS) return news;
  looked_s_ = now_s;
  files_.resize(algorithms().size() - first_plugin());
  for (std::size_t i = 0; i < files_.size(); ++i) {
    if (auto one = look_at(first_plugin() + i, files_[i])) news.push_back(std::move(*one));
  }
  return news;
}

// Empty for a file that is not there: a linker removes it before it writes a new one.
std::optional<PluginWatch::Stamp> PluginWatch::stamp_of(const std::string& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0) return std::nullopt;
  return Stamp{status.st_dev, status.st_ino, status.st_size, status.st_mtim.tv_sec,
               status.st_mtim.tv_nsec};
}

std::optional<PluginNews> PluginWatch::look_at(std::size_t algorithm, Watched& watched) {
  const PluginFile* const file = plugin_file(algorithm);
  if (file == nullptr) return std::nullopt;
  const std::string path = file->path;
  const std::optional<Stamp> stamp = stamp_of(path);
  const bool rests = std::exchange(watched.seen, stamp) == stamp;
  if (!stamp || !rests || stamp == watched.tried) return std::nullopt;
  watched.tried = stamp;
  const Result<bool> reloaded = reload_plugin(algorithm);
  if (!reloaded) {
    return PluginNews{algorithm, false,
                      fmt::format("{}; the algorithm stays as it was", reloaded.error().message)};
  }
  if (!*reloaded) return std::nullopt;
  return PluginNews{algorithm, true, fmt::format("{}: loaded again", shown(path))};
}

}  // namespace hapticwall::file
