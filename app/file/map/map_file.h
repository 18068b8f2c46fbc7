// The CSV of a stability map. It is written cell by cell, so that an interrupted run can resume.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "app/file/disk/atomic_file.h"
#include "core/result.h"
#include "core/study/stability_map.h"

namespace hapticwall::file {

// The cells of one run, without --shard all of the map. Consecutive parts hold consecutive cells,
// so that their joined files are the file of the whole map.
struct MapPart {
  std::size_t begin = 0;
  std::size_t end = 0;
};
// Part `index` (from 1) of `count`.
[[nodiscard]] MapPart map_part(const StabilityMap& map, std::size_t index, std::size_t count);

// The sidecar of the map at `path`: the scene, and a table [map] with the plan.
[[nodiscard]] std::string map_sidecar(const StabilityMap& map, const MapPart& part,
                                      const std::string& path);

// Writes NAME.csv.partial and NAME.toml.partial, and renames both at the end.
class MapWriter {
 public:
  // Resumes a NAME.csv.partial of the same map and build, according to its NAME.toml.partial;
  // refuses any other one.
  [[nodiscard]] static Result<MapWriter> open(const std::string& named, const StabilityMap& map,
                                              const MapPart& part);

  // Cells of an earlier run, from part.begin on.
  [[nodiscard]] const std::vector<MapMetrics>& found() const { return found_; }
  // Appends cells [begin, begin + metrics.size()), in order.
  [[nodiscard]] Failure append(const StabilityMap& map, std::size_t begin,
                               const std::vector<MapMetrics>& metrics);
  [[nodiscard]] Failure finish();

 private:
  MapWriter(AtomicFile csv, AtomicFile sidecar)
      : csv_(std::move(csv)), sidecar_(std::move(sidecar)) {}

  AtomicFile csv_;
  AtomicFile sidecar_;
  std::vector<MapMetrics> found_;
};

// True if the sidecar of `path` describes another map, or comes from another version of the
// program. False without a sidecar, as for joined parts.
[[nodiscard]] bool has_other_sidecar(const std::string& path, const StabilityMap& map);

// All cells of the map; `origin` names the text in messages.
[[nodiscard]] Result<std::vector<MapMetrics>> parse_map(std::string_view text,
                                                        const std::string& origin,
                                                        const StabilityMap& map);
// parse_map() of a file.
[[nodiscard]] Result<std::vector<MapMetrics>> read_map(const std::string& path,
                                                       const StabilityMap& map);

}  // namespace hapticwall::file
