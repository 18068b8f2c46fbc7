#include "core/study/identify/identify.h"

#include <algorithm>
#include <cmath>

#include "core/study/identify/first_guess.h"
#include "core/study/identify/intervals.h"

namespace hapticwall::identify {
namespace {

constexpr double kMaxDelayTicks = 24.0;
constexpr double kSegmentS = 0.8;
constexpr std::size_t kMinSegmentTicks = 60;
constexpr std::size_t kMinSegments = kParameters + 2;
constexpr std::size_t kGuesses = 3;
constexpr int kFirstIterations = 6;
constexpr int kIterations = 12;
constexpr int kProfileIterations = 8;
constexpr std::size_t kMaxReportTicks = 24;  // max ticks from a command to its report
constexpr double kSameForce = 0.01;          // share of the largest force
// Share of the ticks; above it, the reported forces are useless.
constexpr double kMaxOtherForces = 0.05;
// Max extra cost of a possible delay, in variances of a count.
constexpr double kPossible = 15.0;

double ratio_of(const Fit& fit, double variance_m2) {
  return std::sqrt(fit.cost_m2 / (static_cast<double>(fit.samples()) * variance_m2));
}

class Search {
 public:
  Search(const Record& record, std::size_t first_tick, double variance_m2)
      : record_(record), first_tick_(first_tick), variance_m2_(variance_m2) {}

  // Segments that double from about a stroke to kSegmentS.
  [[nodiscard]] Fit grown(Fit fit, std::size_t stroke_ticks) const {
    const auto longest = static_cast<std::size_t>(kSegmentS / record_.period_s);
    for (std::size_t count = stroke_ticks;; count = std::min(2 * count, longest)) {
      fit.segments = cut(record_, first_tick_, count, fit.segments);
      if (fit.segments.empty()) return fit;
      refit_starts(record_, fit);
      search(record_, fit, count == longest ? kIterations : kFirstIterations);
      if (count == longest) break;
    }
    return settled(std::move(fit));
  }

  // The fit with another whole delay, its lag found again.
  [[nodiscard]] Fit with_delay(Fit fit, std::size_t delay) const {
    const double shift = static_cast<double>(fit.delay) - static_cast<double>(delay);
    fit.parameters[kLag] = std::max(0.0, fit.parameters[kLag] + shift * record_.period_s);
    fit.delay = delay;
    search(record_, fit, kProfileIterations);
    return settled(std::move(fit));
  }

  // Refits the starts of bad segments, at most three times and while the cost falls.
  [[nodiscard]] Fit settled(Fit fit) const {
    for (int i = 0; i < 3 && ratio_of(fit, variance_m2_) > 1.02; ++i) {
      const double before = fit.cost_m2;
      refit_starts(record_, fit);
      search(record_, fit, kProfileIterations);
      if (!(fit.cost_m2 < 0.999 * before)) break;
    }
    return fit;
  }

 private:
  const Record& record_;
  std::size_t first_tick_;
  double variance_m2_;
};

Fit start_of(const Guess& guess, double period_s) {
  Fit fit;
  fit.delay = static_cast<std::size_t>(guess.delay_s / period_s);
  fit.parameters = guess.parameters;
  fit.parameters[kLag] =
      std::max(guess.delay_s - static_cast<double>(fit.delay) * period_s, 0.1 * period_s);
  return fit;
}

std::vector<Fit> profile(const Search& search, const Fit& best, double period_s) {
  const double total = static_cast<double>(best.delay) + best.parameters[kLag] / period_s;
  const auto last = static_cast<std::size_t>(total + 1.0);
  std::vector<Fit> fits{best};
  Fit next = best;
  for (std::size_t delay = best.delay; delay-- > 0;) {
    fits.push_back(next = search.with_delay(next, delay));
    if (best.delay - delay >= 4) break;
  }
  next = best;
  for (std::size_t delay = best.delay + 1; delay <= last; ++delay) {
    fits.push_back(next = search.with_delay(next, delay));
  }
  std::sort(fits.begin(), fits.end(),
            [](const Fit& a, const Fit& b) { return a.cost_m2 < b.cost_m2; });
  return fits;
}

double delay_and_lag(const Fit& fit, double period_s) {
  return static_cast<double>(fit.delay) * period_s + fit.parameters[kLag];
}

Estimate estimate(double value, double half_width) {
  return {value, std::max(0.0, value - half_width), value + half_width};
}

void fill_numbers(const Record& record, const Fit& fit, Identification& found) {
  const Intervals intervals(record, fit);
  const auto width = [&](std::initializer_list<std::pair<Parameter, double>> weights) {
    ParameterVector sum = ParameterVector::Zero();
    for (const auto& [parameter, weight] : weights) sum[parameter] = weight;
    return intervals.half_width(sum);
  };
  const Parameters& p = fit.parameters;
  const double mass_kg = std::exp(p[kLogMass]);
  const double mass_factor = std::exp(width({{kLogMass, 1.0}}));
  found.mass_kg = {mass_kg, mass_kg / mass_factor, mass_kg * mass_factor};
  found.damping_n_s_per_m = estimate(p[kDamping], width({{kDamping, 1.0}}));
  found.friction_up_n = estimate(p[kFrictionUp], width({{kFrictionUp, 1.0}}));
  found.friction_down_n = estimate(p[kFrictionDown], width({{kFrictionDown, 1.0}}));
  found.friction_n = estimate((p[kFrictionUp] + p[kFrictionDown]) / 2.0,
                              width({{kFrictionUp, 0.5}, {kFrictionDown, 0.5}}));
  found.lag_s = estimate(p[kLag], width({{kLag, 1.0}}));
  found.delay_s = estimate(delay_and_lag(fit, record.period_s), width({{kLag, 1.0}}));
}

// The delays that the record does not exclude; the interval of their sum with the lag spans all.
void fill_delays(const Record& record, const std::vector<Fit>& fits, double variance_m2,
                 Identification& found) {
  const double half_width = found.delay_s.high - found.delay_s.value;
  for (const Fit& fit : fits) {
    if (fit.cost_m2 - fits.front().cost_m2 > kPossible * variance_m2) continue;
    found.possible_delays.push_back(fit.delay);
    const double sum_s = delay_and_lag(fit, record.period_s);
    found.delay_s.low = std::min(found.delay_s.low, std::max(0.0, sum_s - half_width));
    found.delay_s.high = std::max(found.delay_s.high, sum_s + half_width);
  }
  std::sort(found.possible_delays.begin(), found.possible_delays.end());
}

// Three counts at rest are noise; two may be a handle between them.
double noise_variance(const ExperimentFacts& facts, double encoder_m) {
  if (facts.rest_range_m < 1.5 * encoder_m) return 0.0;
  return std::max(0.0, facts.rest_variance_m2 - encoder_m * encoder_m / 12.0);
}

// Ticks whose report, `lag` ticks later, has another force.
std::size_t other_forces(const std::vector<double>& force_n, const std::vector<double>& applied_n,
                         std::size_t lag, double same_n) {
  std::size_t others = 0;
  for (std::size_t k = 0; k + lag < applied_n.size(); ++k) {
    others += std::abs(applied_n[k + lag] - force_n[k]) > same_n ? 1 : 0;
  }
  return others;
}

}  // namespace

double smallest_step(const std::vector<double>& position_m) {
  double smallest_m = 0.0;
  for (std::size_t i = 1; i < position_m.size(); ++i) {
    const double step_m = std::abs(position_m[i] - position_m[i - 1]);
    if (step_m > 0.0 && (smallest_m == 0.0 || step_m < smallest_m)) smallest_m = step_m;
  }
  return smallest_m;
}

std::vector<double> taken_forces(const std::vector<double>& force_n,
                                 const std::vector<double>& applied_n) {
  double largest_n = 0.0;
  for (const double force : force_n) largest_n = std::max(largest_n, std::abs(force));
  std::size_t best_lag = 0;
  std::size_t fewest = force_n.size();
  for (std::size_t lag = 0; lag < std::min(kMaxReportTicks, force_n.size()); ++lag) {
    const std::size_t others = other_forces(force_n, applied_n, lag, kSameForce * largest_n);
    if (others >= fewest) continue;
    best_lag = lag;
    fewest = others;
  }
  std::vector<double> taken_n = force_n;
  if (static_cast<double>(fewest) > kMaxOtherForces * static_cast<double>(force_n.size()))
    return taken_n;
  std::copy(applied_n.begin() + static_cast<std::ptrdiff_t>(best_lag), applied_n.end(),
            taken_n.begin());
  return taken_n;
}

std::optional<Identification> identify(const Record& record, const ExperimentFacts& facts) {
  Identification found;
  found.encoder_m = record.encoder_m;
  const double noise_m2 = noise_variance(facts, record.encoder_m);
  found.noise_m = std::sqrt(noise_m2);
  const double variance_m2 = record.encoder_m * record.encoder_m / 12.0 + noise_m2;
  const std::vector<Guess> guesses = first_guesses(record, facts.first_stroke_tick, kMaxDelayTicks);
  const std::size_t ticks = record.position_m.size() - facts.first_stroke_tick;
  if (guesses.empty() || facts.turns == 0) return std::nullopt;
  const auto longest = static_cast<std::size_t>(kSegmentS / record.period_s);
  const std::size_t stroke_ticks =
      std::clamp<std::size_t>(ticks / facts.turns, kMinSegmentTicks, longest);
  if (ticks / longest < kMinSegments) return std::nullopt;

  const Search search(record, facts.first_stroke_tick, variance_m2);
  std::optional<Fit> best;
  for (std::size_t i = 0; i < std::min(kGuesses, guesses.size()); ++i) {
    Fit fit = search.grown(start_of(guesses[i], record.period_s), stroke_ticks);
    if (!best || fit.cost_m2 < best->cost_m2) best = std::move(fit);
    if (ratio_of(*best, variance_m2) <= kMaxResidualRatio) break;
  }
  std::vector<Fit> fits = profile(search, *best, record.period_s);
  found.fit = fits.front();
  found.delay_ticks = found.fit.delay;
  found.residual_ratio = ratio_of(found.fit, variance_m2);
  found.fits = found.residual_ratio <= kMaxResidualRatio;
  fill_numbers(record, found.fit, found);
  fill_delays(record, fits, variance_m2, found);
  return found;
}

}  // namespace hapticwall::identify
