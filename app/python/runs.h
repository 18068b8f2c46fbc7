// Runs of scenes and recordings, and their results as Python reads them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "app/file/recording/recording_reader.h"
#include "app/file/recording/recording_writer.h"
#include "app/python/results.h"
#include "app/python/scene.h"
#include "core/study/worst_hand/hand_space.h"
#include "core/summary.h"

namespace hapticwall::python {

struct RunBox {
  SceneBox scene;
  RunSummary summary;
  Rows rows;
  file::RecordingMetadata metadata;
  std::optional<std::uint64_t> first_different_tick;  // of a re-run

  // Writes the recording and its sidecar. Raises OSError.
  void save(const std::string& path) const;
};

class RecordingBox {
 public:
  // Raises ValueError or OSError, and KeyboardInterrupt.
  explicit RecordingBox(const std::string& path);

  [[nodiscard]] const file::RecordingInfo& info() const { return reader_->info(); }
  // Reads all rows the first time.
  [[nodiscard]] const Rows& rows();
  // The scene whose hand moves as it was recorded, for any number of runs. Raises ValueError where
  // a re-run would.
  [[nodiscard]] SceneBox scene();
  [[nodiscard]] RunBox rerun(const std::string& algorithm,
                             const std::vector<std::string>& overrides);

 private:
  std::unique_ptr<file::RecordingReader> reader_;
  std::optional<Rows> rows_;
};

// Raises ValueError, RuntimeError for a scene that cannot be run, and KeyboardInterrupt.
[[nodiscard]] RunBox run(const SceneBox& scene);

// Many runs at once (studies.cpp). All raise as run() does.

// Many scenes, on one core if the law of one of them is Python. `threads` of all three: max; 0: all
// cores.
[[nodiscard]] std::vector<RunSummary> run_batch(const std::vector<SceneBox>& scenes, int threads);

// A row for each algorithm, an index in algorithms(), or for each of its forms.
[[nodiscard]] std::vector<RunSummary> compare(const SceneBox& scene,
                                              const std::vector<std::size_t>& algorithms,
                                              int threads);

using MapValues = std::pair<std::string, std::span<const double>>;  // of a key

// The numbers of the summaries of all cells; x varies fastest, then y, then the algorithm. Axis x
// only. Raises KeyError for a key that is no number of the scene.
[[nodiscard]] std::vector<NumberColumn> map(const SceneBox& scene, const MapValues& x,
                                            const MapValues& y,
                                            const std::vector<std::size_t>& algorithms,
                                            int threads);
// Raises as map(), and runs nothing.
void check_map(const SceneBox& scene, const MapValues& x, const MapValues& y,
               const std::vector<std::size_t>& algorithms);

inline constexpr std::size_t kHandBytes = sizeof(worst_hand::HandValues);
struct HandSearch {
  std::uint64_t hands = 0;
  std::uint64_t seed = 0;
  std::string bounds;
  std::string motion;
  int threads = 0;  // max; 0: all cores
  // Runs hands elsewhere: takes and gives the bytes of run_hands(). nullopt: this process runs
  // them.
  std::optional<nanobind::callable> elsewhere = {};
};
using HandDict = nanobind::typed<nanobind::dict, nanobind::str, nanobind::any>;
// The search of `hapticwall worst-hand` (worst_hand.cpp), with the keys of a row of its JSON: those
// of the hand are missing if none took energy. `numbers` are those of the hand, `scene` a SceneBox.
// Raises ValueError, KeyboardInterrupt, and what `elsewhere` raised.
[[nodiscard]] HandDict search_hand(const SceneBox& scene, const HandSearch& search);
// Results of these hands in the order of worst_hand::HandResult, three doubles each; NaN for a hand
// that the integrator refuses. `hands`: worst_hand::kHandNumbers doubles each. Raises ValueError.
[[nodiscard]] nanobind::bytes run_hands(const SceneBox& scene, const HandSearch& search,
                                        const nanobind::bytes& hands);

}  // namespace hapticwall::python
