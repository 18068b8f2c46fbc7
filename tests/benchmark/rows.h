// The scenes that are measured, and the rows of the table that they become.
#pragma once

#include <string>

#include "core/scene.h"

namespace hapticwall::benchmark_rows {

// Counters of a row, beside its time.
inline constexpr const char* kTicksCounter = "ticks";
inline constexpr const char* kEventsCounter = "events";
inline constexpr const char* kSimulatedCounter = "simulated_s";  // in rows that use all cores
// Rows that another row is told with: what is paid before the first tick, and the same scene
// without what the row is about.
inline constexpr const char* kSetUpSuffix = " (set-up)";
inline constexpr const char* kWithoutSuffix = " (without)";
// The friction kernel on the same scene: a peer of its own.
inline constexpr const char* kKernelSuffix = " (friction kernel)";
// All rows are ratios to this one.
inline constexpr const char* kBareLoop = "bare loop, golden-soft";

// A built-in scene; ends the program where it is missing.
[[nodiscard]] Scene builtin(const char* name);
[[nodiscard]] Scene under(const char* algorithm, Scene scene);

// One scene under simulate(), and its set-up.
void add_scene(const std::string& name, const Scene& scene);

// Linear → encoder → force limit → friction → grip → delay → lag: each with all before it, then
// each alone on the linear scene.
void add_ladder();
// The friction kernel beside the row `name` of a scene without encoder under `none`.
void add_friction_kernel(const std::string& name, const Scene& scene);
// Adds the rows for the cost of a friction event.
void add_friction_events();
// Each scene under each algorithm, plug-ins included, and a live tick under each.
void add_algorithms();
void add_environments();
// Maps of 200 x 200 scenes of 2 s, on all cores.
void add_maps();

}  // namespace hapticwall::benchmark_rows
