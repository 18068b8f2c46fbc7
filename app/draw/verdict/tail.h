// The last second of a session, by the formulas of a run's summary.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "app/draw/plot/sample_history.h"
#include "core/sample.h"
#include "core/scene.h"
#include "core/summary.h"

namespace hapticwall::draw {

struct Tail {
  std::uint64_t end_tick = 0;  // tick after the newest sample; 0: none yet
  Summary summary;             // its tail and its verdict; the rest is that of the last second
  // Frequency of the position, or of the force if only the force shakes.
  std::optional<double> frequency_hz;
};
using Tails = std::array<Tail, kMaxAxes>;

// The second before the sample `end`, or all of it if it is shorter, judged alone. `scene`: of its
// axis. `knows_truth`: see SampleSource. Precondition: end <= history.size().
[[nodiscard]] Tail tail_of(const SampleHistory& history, const Scene& scene, std::size_t end,
                           bool knows_truth);

// Keeps the tails of all axes up to date: of the newest second, or of that before `at_s`. Costs
// nothing without a new sample.
void note_tails(Tails& tails, const TickHistory& history, const Scene& scene, bool knows_truth,
                std::optional<double> at_s = std::nullopt);

// "50.0 Hz · 2.825 mm p-p"; empty without a rhythm.
[[nodiscard]] std::string rhythm_text(const Tail& tail);
// "settled · 0.000 mm p-p · 4.967 ± 0.128 N · 30.12 kN/m", with the digits of `run`.
[[nodiscard]] std::string figures_text(const Summary& summary);
// tail_text() without the verdict's word: "0.000 mm p-p · … · quiet".
[[nodiscard]] std::string tail_numbers_text(const Tail& tail);
// figures_text() and the rhythm: "… · quiet".
[[nodiscard]] std::string tail_text(const Tail& tail);

}  // namespace hapticwall::draw
