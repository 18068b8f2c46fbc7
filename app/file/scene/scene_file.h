// Scenes from TOML files, and the built-in scenes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"
#include "core/sample.h"
#include "core/scene.h"

namespace hapticwall::file {

// A note that the user made at a tick of a recording.
struct Mark {
  std::uint64_t tick = 0;
  std::string text;  // may be empty

  friend bool operator==(const Mark&, const Mark&) = default;
};

// Max changes of one recording; dragging a slider makes sixty changes a second.
inline constexpr std::size_t kMaxChanges = 10'000;
inline constexpr std::string_view kTooManyChanges = "more than 10000 changes of parameters";
// Together well below kMaxSidecarBytes.
inline constexpr std::size_t kMaxMarks = 1000;     // marks of one recording
inline constexpr std::size_t kMaxMarkBytes = 200;  // bytes of one text, UTF-8

// The text of a mark from user input: cut to kMaxMarkBytes, without control characters and invalid
// UTF-8.
[[nodiscard]] std::string mark_text(std::string_view typed);

// A scene; if the file is the sidecar of a recording, also what repeats its session.
struct LoadedScene {
  Scene scene;
  std::vector<ScheduledChange> changes;
  std::uint64_t first_recorded_tick = 0;
  std::string not_repeatable_because;    // empty: a repetition gives the same rows
  std::string changed_plugin;            // plug-in path; empty: as recorded, or another algorithm
  std::vector<std::string> named_files;  // of device and hands; also built-in names and ""
  std::vector<Mark> marks;               // marks in order
  std::string csv_sha256;                // hash of the rows; empty: not known
  bool edited = false;                   // the sidecar was changed since it was written
  // Tick of each axis at which the recorded run diverged, which the rows do not show.
  std::array<std::optional<std::uint64_t>, kMaxAxes> diverged_at_tick;
};

// Parses and validates; `origin` names the text in messages ("scene.toml:12: wall.stiffness_n_per_m
// …"). `overrides` are "KEY=VALUE" texts of --set, applied in order before validation.
[[nodiscard]] Result<LoadedScene> parse_scene(std::string_view toml_text, const std::string& origin,
                                              std::span<const std::string> overrides = {});

// `name_or_path`: a built-in scene or a file. Fails for files that are too large.
[[nodiscard]] Result<LoadedScene> load_scene(const std::string& name_or_path,
                                             std::span<const std::string> overrides = {});

// The scene with the numbers of a device file on axis x, as by --set device=NAME; its description
// stays. A name without a built-in device is a file in the current folder.
[[nodiscard]] Result<Scene> with_device(Scene scene, const std::string& name);

// The table that makes a file the sidecar of a recording or of a map.
inline constexpr std::string_view kRecordingTable = "recording";
inline constexpr std::string_view kMapTable = "map";

// A larger file is not a sidecar. A change of all walls, device and hand takes at most 4 KB.
inline constexpr std::size_t kMaxSidecarBytes = std::size_t{1} << 26U;

// Keys of [recording] for the tick at which a run diverged, by axis.
inline constexpr std::array<std::string_view, kMaxAxes> kDivergedKeys{"diverged_at_tick",
                                                                      "y_diverged_at_tick"};

// True if the file at `path` has this table and is no larger than a sidecar.
[[nodiscard]] bool is_sidecar(const std::string& path, std::string_view table);

struct BuiltinScene {
  std::string name;
  std::string description;
  std::string_view toml_text;
};
[[nodiscard]] const std::vector<BuiltinScene>& builtin_scenes();

// The whole scene as TOML, with every number in the shortest form that reads back the same.
[[nodiscard]] std::string scene_to_toml(const Scene& scene);

}  // namespace hapticwall::file
