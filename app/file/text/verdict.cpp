#include "app/file/text/verdict.h"

#include <fmt/format.h>

#include "app/file/text/text.h"
#include "core/units.h"

namespace hapticwall::file {

std::string verdict_text(Verdict verdict, std::optional<std::uint64_t> diverged_at_tick) {
  std::string text(verdict_name(verdict));
  if (diverged_at_tick) text += fmt::format(" at tick {}", *diverged_at_tick);
  return text;
}

std::string verdict_text(const Summary& summary) {
  return verdict_text(summary.verdict, summary.diverged_at_tick);
}

TailTexts tail_texts(const Summary& s) {
  return {fixed(s.tail_peak_to_peak_m, kMillimetresPerMetre, 3) + " mm p-p",
          fmt::format("{} ± {} N", fixed(s.tail_force_mean_n, 1.0, 3),
                      fixed(s.tail_force_std_n, 1.0, 3)),
          s.displayed_stiffness_n_per_m
              ? fixed(s.displayed_stiffness_n_per_m, 1.0 / kNewtonsPerKilonewton, 2) + " kN/m"
              : "no contact"};
}

}  // namespace hapticwall::file
