// A verdict in words and as a grade, for window, figure and table alike.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/summary.h"

namespace hapticwall::file {

// app/draw/plot/tone.h gives each grade its colour.
enum class VerdictGrade : std::uint8_t { kGood, kNone, kWarning, kBad };

// kNone: nothing to judge. kWarning: the force shakes while the handle rests, or the wall gives
// energy. kBad: the handle shakes, or the run diverged.
[[nodiscard]] constexpr VerdictGrade grade_of(Verdict verdict) {
  if (is_good(verdict)) return VerdictGrade::kGood;
  if (verdict == Verdict::kNoContact) return VerdictGrade::kNone;
  const bool warns = verdict == Verdict::kBuzzing || verdict == Verdict::kActive;
  return warns ? VerdictGrade::kWarning : VerdictGrade::kBad;
}

// "settled"; "diverged at tick 12".
[[nodiscard]] std::string verdict_text(Verdict verdict,
                                       std::optional<std::uint64_t> diverged_at_tick);
[[nodiscard]] std::string verdict_text(const Summary& summary);

// The last second. A number that does not apply is "-".
struct TailTexts {
  std::string way;        // "2.000 mm p-p"
  std::string force;      // "0.100 ± 0.707 N": mean and standard deviation
  std::string stiffness;  // "1.25 kN/m", or "no contact"
};
[[nodiscard]] TailTexts tail_texts(const Summary& summary);

}  // namespace hapticwall::file
