// Many runs at once.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "app/python/results.h"
#include "app/python/scene.h"
#include "core/summary.h"

namespace hapticwall::python {

// All raise as run() does.

// Many scenes on all cores, on one if the law of one of them is Python.
[[nodiscard]] std::vector<RunSummary> run_batch(const std::vector<SceneBox>& scenes);

// A row for each algorithm, an index in algorithms(), or for each of its forms.
[[nodiscard]] std::vector<RunSummary> compare(const SceneBox& scene,
                                              const std::vector<std::size_t>& algorithms);

using MapValues = std::pair<std::string, std::span<const double>>;  // of a key

// The numbers of the summaries of all cells; x varies fastest, then y, then the algorithm. Axis x
// only. Raises KeyError for a key that is no number of the scene.
[[nodiscard]] std::vector<NumberColumn> map(const SceneBox& scene, const MapValues& x,
                                            const MapValues& y,
                                            const std::vector<std::size_t>& algorithms);

}  // namespace hapticwall::python
