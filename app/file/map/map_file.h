// The CSV of a stability map: written as the cells come, so that a run that was killed goes on
// where it stood; and read back.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/file/atomic_file.h"
#include "core/result.h"
#include "core/study/stability_map.h"

namespace hapticwall::file {

// The cells of a map that are one run's; all of them, where it is not in parts. Parts in a row have
// the cells in a row, so that their files put together are the file of the whole.
struct MapPart {
  std::size_t begin = 0;
  std::size_t end = 0;
};
// Part `index` (from 1) of `count`.
[[nodiscard]] MapPart map_part(const StabilityMap& map, std::size_t index, std::size_t count);

// The map's sidecar: the whole scene, and a table [map] that says what was made of it.
[[nodiscard]] std::string map_sidecar(const StabilityMap& map, const MapPart& part);

// NAME.csv.partial and NAME.toml.partial until both are whole.
class MapWriter {
 public:
  // Goes on from a NAME.csv.partial that is of the same map, by the same build (its
  // NAME.toml.partial says so); refuses one that is not.
  [[nodiscard]] static Result<MapWriter> open(const std::string& path, const StabilityMap& map,
                                              const MapPart& part);

  // Of the cells from part.begin on: what an earlier run left.
  [[nodiscard]] const std::vector<MapFigures>& found() const { return found_; }
  // Cells [begin, begin + figures.size()), which follow those that are there.
  [[nodiscard]] Failure append(const StabilityMap& map, std::size_t begin,
                               const std::vector<MapFigures>& figures);
  [[nodiscard]] Failure finish();

 private:
  MapWriter(AtomicFile csv, AtomicFile sidecar)
      : csv_(std::move(csv)), sidecar_(std::move(sidecar)) {}

  AtomicFile csv_;
  AtomicFile sidecar_;
  std::vector<MapFigures> found_;
};

// Whether the sidecar beside the cells at `path` is one of another map than this whole one, or of
// another version of the program. Parts that were put together have none.
[[nodiscard]] bool has_other_sidecar(const std::string& path, const StabilityMap& map);

// All cells of the map, out of the text of the whole; `origin` names it in messages.
[[nodiscard]] Result<std::vector<MapFigures>> parse_map(std::string_view text,
                                                        const std::string& origin,
                                                        const StabilityMap& map);
// The same, out of its file.
[[nodiscard]] Result<std::vector<MapFigures>> read_map(const std::string& path,
                                                       const StabilityMap& map);

}  // namespace hapticwall::file
