// The film of a run: takes its ticks, and draws the pictures into a folder.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/command/common_options.h"
#include "app/command/run/film_options.h"
#include "app/draw/film/film.h"
#include "app/file/disk/atomic_folder.h"
#include "app/file/scene/scene_file.h"
#include "core/result.h"
#include "core/sample.h"

namespace hapticwall::command {

struct FilmRequest {
  const SceneOptions& scene;
  const FilmOptions& film;
  const std::string& folder;  // of --frames; empty: no film
  bool in_real_time = false;
  bool on_simulator = true;
  bool show_progress = false;
};

class FilmOutput {
 public:
  // Checks the options, and that the folder can be made; without a folder, that no option needs
  // one.
  [[nodiscard]] static Result<FilmOutput> open(const FilmRequest& request,
                                               const file::LoadedScene& loaded);

  // True if take() must be called with every tick.
  [[nodiscard]] bool wants_ticks() const { return !folder_.empty(); }
  void take(const Tick& tick);

  // Runs the algorithm of --beside, draws all pictures and gives the folder its name; does nothing
  // without a film. False: a stop signal has ended it, and nothing is left.
  [[nodiscard]] Result<bool> finish();

 private:
  [[nodiscard]] Result<bool> run_beside();
  [[nodiscard]] Failure fit_to_ticks();
  [[nodiscard]] Result<bool> draw_pictures(file::AtomicFolder& folder);

  draw::FilmSettings settings_;
  std::string folder_;               // empty: no film
  std::optional<Scene> beside_;      // the scene with the algorithm of --beside
  std::vector<draw::FilmRun> runs_;  // the axes of the run
  std::uint64_t first_recorded_tick_ = 0;
  bool show_progress_ = false;
};

}  // namespace hapticwall::command
