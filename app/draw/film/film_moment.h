// A run at one moment of a film.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "app/draw/plot/plot_trace.h"
#include "app/draw/plot/sample_history.h"
#include "app/draw/verdict/tail.h"
#include "app/draw/verdict/verdict_words.h"
#include "app/draw/wall/wall_picture.h"
#include "core/scene.h"

namespace hapticwall::draw {

// The scene of one axis from a tick on.
struct FilmScene {
  std::uint64_t from_tick = 0;
  Scene scene;
  std::string name;  // of its algorithm
};

// A run along one axis.
struct FilmRun {
  std::vector<FilmScene> scenes;  // sorted by tick; the first one is that of the start
  SampleHistory history;
  bool knows_truth = true;  // false: of a device; its true positions are the measured ones

  [[nodiscard]] const FilmScene& at(std::uint64_t tick) const;
};

// The part of a run that contact and plots show, up to the moment.
inline constexpr double kFilmWindowS = 0.2;

// What all pictures and all runs of a film share, so that nothing moves but the handle.
struct FilmScales {
  Extremes view_m;      // shown by the wall's picture
  double face_m = 0.0;  // of the outermost wall; without one the middle of the positions
  Extremes contact_m;   // shown by the magnified contact and by the plot of the position
  Extremes force_n;     // shown by the plot of the force
};

// The scales for this part of the runs. Precondition: there is a run, and each has a sample.
[[nodiscard]] FilmScales film_scales(std::span<const FilmRun> runs, double from_s, double to_s);

struct FilmMoment {
  const FilmRun& run;
  const FilmScene& now;
  const FilmScales& scales;
  double time_s = 0.0;
  WallPicture picture;      // with the extremes since the moment before
  double measured_m = 0.0;  // position of the encoder
  Tail tail;

  [[nodiscard]] Tone tone() const { return tail_tone(tail); }
};

// The run at `time_s`. The handle's extremes are those after `since_s`.
[[nodiscard]] FilmMoment moment_of(const FilmRun& run, const FilmScales& scales, double since_s,
                                   double time_s);

}  // namespace hapticwall::draw
