// Measurements of the window.
#pragma once

namespace hapticwall::window_benchmark {

// Cost of a frame with a minute and with an hour of history, in ratio to an empty window's. Returns
// the exit status of the program.
int measure_frames();

// How late the loop wakes up while the window is drawn as fast as it can, and while it is not, in
// blocks of `block_s` that take turns for `seconds`; every core is kept busy besides, and a
// recording runs. Returns the exit status of the program.
int measure_loop(double seconds, double block_s);

// Lateness of the loop while a map of all algorithms is computed, and while it is not; the window
// is drawn throughout, and nothing else keeps the cores busy.
int measure_map_loop(double seconds, double block_s);

// Lateness of the loop without a stream, with one that is read, and with one whose reader has
// stalled. There is no window; a recording runs.
int measure_stream(double seconds, double block_s);

// When the first picture of a map of `press` stands, and when all of its cells do. Returns the exit
// status of the program.
int measure_map();

// Losses of a recording at this rate while the window is drawn as fast as it can and every core is
// kept busy besides. Returns the exit status of the program.
int measure_recording(double seconds, double rate_hz);

}  // namespace hapticwall::window_benchmark
