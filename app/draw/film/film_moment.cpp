#include "app/draw/film/film_moment.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include "app/file/text/text.h"
#include "core/units.h"

namespace hapticwall::draw {
namespace {

using file::fixed;

constexpr double kMinDepthShare = 1.0 / 12.0;  // of the view: the contact is not magnified more
constexpr double kBesideDepth = 1.25;          // shown depth, in multiples of the deepest one

// The samples after `from_s` up to `to_s`; at least one.
IndexRange samples_within(const SampleHistory& history, double from_s, double to_s) {
  const std::size_t last = *history.nearest(to_s) + 1;
  const IndexRange range = history.range_within(from_s, to_s);
  if (range.count() == 0) return {last - 1, last};
  return range;
}

double face_of(std::span<const FilmRun> runs, const Extremes& places_m) {
  for (const FilmRun& run : runs) {
    double face_m = 0.0;
    bool found = false;
    for (const WallSettings& wall : run.scenes.front().scene.x().walls) {
      face_m = found ? std::min(face_m, wall.position_m) : wall.position_m;
      found = true;
    }
    if (found) return face_m;
  }
  return 0.5 * (places_m.minimum + places_m.maximum);
}

// The wall's picture: the face to the right of the middle, with room for the handle before it. A
// hand that aims deeper stays at the edge.
Extremes view_of(const Extremes& places_m, double face_m) {
  constexpr double kMinOutsideM = 0.01;
  constexpr double kRoom = 1.2;
  const double outside_m = std::max(face_m - places_m.minimum, kMinOutsideM);
  const double inside_m = std::max(places_m.maximum - face_m, 0.75 * outside_m);
  return {face_m - kRoom * outside_m, face_m + kRoom * inside_m};
}

}  // namespace

const FilmScene& FilmRun::at(std::uint64_t tick) const {
  const auto next = std::ranges::upper_bound(scenes, tick, {}, &FilmScene::from_tick);
  return next == scenes.begin() ? scenes.front() : *std::prev(next);
}

FilmScales film_scales(std::span<const FilmRun> runs, double from_s, double to_s) {
  std::optional<Extremes> places;
  FilmScales scales;
  for (const FilmRun& run : runs) {
    const IndexRange range = samples_within(run.history, from_s - kFilmWindowS, to_s);
    include(places, run.history.extremes(&PlantTruth::position_m, range));
    scales.force_n.include(run.history.extremes(&Sample::force_n, range));
    const double limit_n = run.scenes.front().scene.x().device.force_limit_n.value_or(0.0);
    scales.force_n.include({0.0, limit_n});
  }
  scales.face_m = face_of(runs, *places);
  scales.view_m = view_of(*places, scales.face_m);
  const double deepest_m =
      std::max(places->maximum - scales.face_m,
               kMinDepthShare * (scales.view_m.maximum - scales.view_m.minimum));
  const double beside_m = kBesideDepth * deepest_m;
  scales.contact_m = {scales.face_m - beside_m, scales.face_m + beside_m};
  const double margin_n = 0.12 * (scales.force_n.maximum - scales.force_n.minimum);
  scales.force_n = {scales.force_n.minimum - 0.5 * margin_n, scales.force_n.maximum + margin_n};
  return scales;
}

FilmMoment moment_of(const FilmRun& run, const FilmScales& scales, double since_s, double time_s) {
  const SampleHistory& history = run.history;
  const IndexRange range = samples_within(history, since_s, time_s);
  const Sample sample = history.sample(range.last - 1);
  const FilmScene& now = run.at(sample.tick);
  FilmMoment moment{run,
                    now,
                    scales,
                    time_s,
                    wall_picture(now.scene, sample),
                    sample.position_m,
                    tail_of(history, now.scene, range.last, run.knows_truth)};
  if (!run.knows_truth) moment.picture.hand_m.reset();
  sweep(moment.picture, Axis::kX,
        {history.extremes(&PlantTruth::position_m, range),
         history.extremes(&Sample::force_n, range), sample.tick + 1});
  return moment;
}

}  // namespace hapticwall::draw
