// A signal as it is drawn: its line; where it oscillates within a few pixels, its mean line over
// the band of its extremes.
#pragma once

#include <cstddef>
#include <vector>

#include "app/draw/plot/sample_history.h"

namespace hapticwall::draw {

// The mean of an oscillation is that of so many columns of pixels on either side, its extremes are
// those of half as many: a cycle of a few pixels gives an even band.
inline constexpr double kBandReach = 8.0;
// The signal oscillates where it goes so many times up or down through its range within that
// reach: a cycle of up to five pixels is a band, a longer one a line.
inline constexpr double kBandTravel = 4.0;
// A band ends only below this, so that a cycle in between is not now the one and now the other.
inline constexpr double kKeptTravel = 3.0;

struct BandColumn {
  double time_s = 0.0;
  double low = 0.0;
  double high = 0.0;
};

struct SignalShape {
  Trace line;                    // kMasked: a gap
  std::vector<BandColumn> band;  // where the signal oscillates, in order of time
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
