// The proof of `hapticwall identify`: random devices on an independent simulator, as a table of
// errors, coverage and failures. Usage: hapticwall_identify_proof [DEVICES [FIRST_SEED [KIND]]]
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "tests/core/study/identify/trial_device.h"

namespace hapticwall::testing {
namespace {

using identify::Estimate;

struct Kind {
  std::string_view name;
  std::function<void(TrialDevice&)> change;
};

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> kAll{
      {"the model", [](TrialDevice&) {}},
      {"unequal friction", [](TrialDevice& d) { d.friction_difference_n = 0.4 * d.friction_n; }},
      {"backlash 0.2 mm", [](TrialDevice& d) { d.backlash_m = 0.2e-3; }},
      {"cogging 0.1 N", [](TrialDevice& d) { d.cogging_n = 0.1; }},
      {"Stribeck 50 %", [](TrialDevice& d) { d.stribeck = 0.5; }},
      {"a hand",
       [](TrialDevice& d) {
         d.hand_stiffness_n_per_m = 300.0;
         d.hand_damping_n_s_per_m = 3.0;
       }},
      {"noise of a count", [](TrialDevice& d) { d.noise_m = d.encoder_m; }},
      {"noise of 10 um", [](TrialDevice& d) { d.noise_m = 10e-6; }},
      {"jitter 50 us", [](TrialDevice& d) { d.jitter_s = 50e-6; }},
      {"jitter 200 us", [](TrialDevice& d) { d.jitter_s = 200e-6; }},
      {"ripple 0.5 %", [](TrialDevice& d) { d.ripple = 0.005; }},
      {"ripple 2 %", [](TrialDevice& d) { d.ripple = 0.02; }}};
  return kAll;
}

class Errors {
 public:
  void add(const Estimate& estimate, double truth, double scale) {
    errors_.push_back(std::abs(estimate.value - truth) * scale);
    covered_ += estimate.low <= truth && truth <= estimate.high ? 1 : 0;
  }
  void print(std::string_view name, std::string_view unit) {
    if (errors_.empty()) return;
    std::sort(errors_.begin(), errors_.end());
    const auto at = [&](double share) {
      return errors_[static_cast<std::size_t>(share * static_cast<double>(errors_.size() - 1))];
    };
    fmt::print("  {:<12}{:>12.4g}{:>12.4g}{:>12.4g} {:<5}{:>8.1f} %\n", name, at(0.5), at(0.95),
               errors_.back(), unit, 100.0 * covered_ / static_cast<double>(errors_.size()));
  }

 private:
  std::vector<double> errors_;
  int covered_ = 0;
};

struct Table {
  Errors mass, damping, friction, delay;
  int devices = 0, ended = 0, misfits = 0, failures = 0, exact = 0, possible = 0;

  void add(const TrialDevice& device, std::uint32_t seed, bool verbose) {
    ++devices;
    const TrialRun run = run_trial(device);
    const auto report = [&](const std::string& what) {
      if (!verbose) return;
      fmt::print("  seed {}: {}; m {:.4g} b {:.4g} f {:.4g} q {:.3g} d {} tau {:.3g}\n", seed, what,
                 device.mass_kg, device.damping_n_s_per_m, device.friction_n, device.encoder_m,
                 device.delay_ticks, device.lag_s);
    };
    if (run.facts.state != identify::ExperimentState::kDone) {
      ++ended;
      return report(std::string(experiment_trouble(run.facts.state)));
    }
    const auto found = identify::identify(run.record, run.facts);
    if (!found) {
      ++failures;
      return report("no result");
    }
    if (!found->fits) {
      ++misfits;
      report(fmt::format("misfit {:.4f}, delay {} lag {:.3g} m {:.4g} b {:.4g} f {:.4g} {:.4g}",
                         found->residual_ratio, found->delay_ticks, found->lag_s.value,
                         found->mass_kg.value, found->damping_n_s_per_m.value,
                         found->friction_up_n.value, found->friction_down_n.value));
      return;
    }
    mass.add(found->mass_kg, device.mass_kg, 100.0 / device.mass_kg);
    damping.add(found->damping_n_s_per_m, device.damping_n_s_per_m,
                100.0 / device.damping_n_s_per_m);
    friction.add(found->friction_n, device.friction_n, 1e3);
    const double sum_s =
        static_cast<double>(device.delay_ticks) * TrialSimulator::kPeriodS + device.lag_s;
    delay.add(found->delay_s, sum_s, 1e6);
    exact += found->delay_ticks == device.delay_ticks ? 1 : 0;
    const auto& set = found->possible_delays;
    possible += std::find(set.begin(), set.end(), device.delay_ticks) != set.end() ? 1 : 0;
    if (found->delay_ticks != device.delay_ticks || std::getenv("ALL") != nullptr) {
      report(
          fmt::format("delay {} lag {:.4g} ratio {:.4f} errors {:.3g} % {:.3g} %",
                      found->delay_ticks, found->lag_s.value, found->residual_ratio,
                      100.0 * (found->mass_kg.value / device.mass_kg - 1.0),
                      100.0 * (found->damping_n_s_per_m.value / device.damping_n_s_per_m - 1.0)));
    }
  }

  void print(std::string_view name) {
    fmt::print("{}: {} devices, {} experiments ended early, {} misfits, {} without result\n", name,
               devices, ended, misfits, failures);
    const int fitted = devices - ended - misfits - failures;
    if (fitted == 0) return;
    fmt::print("  {:<12}{:>12}{:>12}{:>12} {:<5}{:>10}\n", "error", "median", "95 %", "max", "",
               "coverage");
    mass.print("m", "%");
    damping.print("b", "%");
    friction.print("f_c", "mN");
    delay.print("delay + lag", "us");
    fmt::print("  whole delay exact {} of {}, in the set {}\n", exact, fitted, possible);
  }
};

int prove(int devices, std::uint32_t first_seed, std::string_view only, bool verbose) {
  for (const Kind& kind : kinds()) {
    if (!only.empty() && only != kind.name) continue;
    Table table;
    for (int i = 0; i < devices; ++i) {
      const std::uint32_t seed = first_seed + static_cast<std::uint32_t>(i);
      TrialDevice device = random_device(seed);
      kind.change(device);
      table.add(device, seed, verbose);
    }
    table.print(kind.name);
  }
  return 0;
}

}  // namespace
}  // namespace hapticwall::testing

int main(int argc, char** argv) {
  const auto number = [&](int i, int otherwise) {
    return argc > i ? std::atoi(argv[i]) : otherwise;
  };
  return hapticwall::testing::prove(number(1, 300), static_cast<std::uint32_t>(number(2, 1)),
                                    argc > 3 ? argv[3] : "", std::getenv("VERBOSE") != nullptr);
}
