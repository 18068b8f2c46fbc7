#include "app/draw/verdict/verdict_words.h"

#include <fmt/format.h>

#include <cmath>

#include "app/file/text/verdict.h"
#include "core/units.h"

namespace hapticwall::draw {
namespace {

// Two digits, and all digits of a larger whole number: "0.16", "2.8", "50", "1500".
std::string two_digits(double value) {
  if (std::abs(value) >= 9.95) return fmt::format("{:.0f}", value);
  return std::abs(value) >= 0.995 ? fmt::format("{:.1f}", value) : fmt::format("{:.2g}", value);
}

std::string stiffness_words(const Summary& s) {
  if (!s.displayed_stiffness_n_per_m) return {};
  const double n_per_m = *s.displayed_stiffness_n_per_m;
  if (std::abs(n_per_m) < kNewtonsPerKilonewton) return two_digits(n_per_m) + " N/m";
  return two_digits(n_per_m / kNewtonsPerKilonewton) + " kN/m";
}

std::string at_frequency(const Tail& tail) {
  return tail.frequency_hz ? " at " + two_digits(*tail.frequency_hz) + " Hz" : std::string();
}

std::string way_words(const Tail& tail) {
  const double way_mm = tail.summary.tail_peak_to_peak_m.value_or(0.0) * kMillimetresPerMetre;
  return two_digits(way_mm) + " mm" + at_frequency(tail);
}

std::string with_remark(const std::string& text, const std::string& remark) {
  return text.empty() ? remark : text + ", " + remark;
}

}  // namespace

std::string force_words(const Tail& tail) {
  const Summary& s = tail.summary;
  if (s.verdict == Verdict::kNoContact || !s.tail_force_mean_n) return {};
  std::string text = two_digits(*s.tail_force_mean_n);
  if (!is_good(s.verdict) && s.tail_force_std_n) text += " ± " + two_digits(*s.tail_force_std_n);
  return text + " N";
}

Tone tail_tone(const Tail& tail) {
  return tail.end_tick == 0 ? Tone::kMuted : verdict_tone(tail.summary.verdict);
}

std::optional<Tone> edge_tone(const Tail& tail) {
  const bool judged =
      tail.end_tick != 0 && file::grade_of(tail.summary.verdict) != file::VerdictGrade::kNone;
  return judged ? std::optional(tail_tone(tail)) : std::nullopt;
}

VerdictWords verdict_words(const Tail& tail) {
  const Summary& s = tail.summary;
  if (tail.end_tick == 0 || !s.tail_peak_to_peak_m) return {"waiting", {}, {}, Tone::kMuted};
  VerdictWords words{file::verdict_text(s), stiffness_words(s), force_words(tail), tail_tone(tail)};
  switch (s.verdict) {
    case Verdict::kOscillating:
      words.numbers = way_words(tail);
      break;
    case Verdict::kBuzzing:
      words.more += at_frequency(tail);
      break;
    case Verdict::kSettled:
      words.more = with_remark(words.more, "still");
      break;
    case Verdict::kActive:
      words.more =
          "gives the hand " + two_digits(s.given_w.value_or(0.0) * kMilliwattsPerWatt) + " mW";
      break;
    case Verdict::kMoving:
      words.more = with_remark(words.more, "the hand moves");
      break;
    case Verdict::kNoContact:
    case Verdict::kDiverged:
      words.numbers = words.more = {};
      break;
  }
  return words;
}

}  // namespace hapticwall::draw
