// Shape of a drawn signal: its line; where it oscillates within a few pixels, its mean line over
// the band of its extremes.
#pragma once

#include <cstddef>
#include <vector>

#include "app/draw/plot/sample_history.h"

namespace hapticwall::draw {

// Reach in columns of pixels to either side over which an oscillation's mean is taken; its extremes
// use half the reach. A cycle of a few pixels then gives an even band.
inline constexpr double kBandReach = 8.0;
// Minimum travel within the reach, in multiples of the signal's range, that counts as oscillation.
// A cycle of up to five pixels becomes a band, a longer one a line.
inline constexpr double kBandTravel = 4.0;
// A band ends only below this travel; the hysteresis keeps a cycle in between from alternating.
inline constexpr double kKeptTravel = 3.0;

struct BandColumn {
  double time_s = 0.0;
  double low = 0.0;
  double high = 0.0;
};

struct SignalShape {
  Trace line;                    // kMasked: a gap
  std::vector<BandColumn> band;  // columns where the signal oscillates, in order of time
  // Scratch memory, by group of samples.
  std::vector<SampleGroup> groups;
  // extremes[n][i] covers 2^n groups from group i on.
  std::vector<std::vector<Extremes>> extremes;
  std::vector<double> travelled;      // up and down, to the end of the group
  std::vector<std::size_t> line_end;  // end of the group's line in `strokes`
  Trace strokes;                      // the line without a band
};

// The range, multiplied by `scale` (not 0), for `columns` columns of pixels. Overwrites `shape`.
// Costs O(columns) steps for any number of samples.
void shape_signal(const SampleHistory& history, Quantity quantity, IndexRange range,
                  std::size_t columns, double scale, SignalShape& shape);

}  // namespace hapticwall::draw
