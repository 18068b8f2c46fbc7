#include "app/study/accuracy/accuracy.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/file/text/text.h"
#include "app/file/text/verdict.h"
#include "app/study/accuracy/over_hands.h"
#include "app/study/field.h"
#include "app/study/studies.h"
#include "core/units.h"

namespace hapticwall::study::accuracy {
namespace {

using Row = AccuracyRow;
using table::fixed;

constexpr std::string_view kReference = "exact integrator in extended precision";
constexpr std::string_view kReferenceNote =
    "the reference is the code of 'exact' in extended precision: the errors are those of steps "
    "and\n"
    "rounding, and an error of the common equations does not show (docs/accuracy.md)\n";

std::string verdict_cell(const Row& row) {
  return file::verdict_text(row.verdict, row.diverged_at_tick) + (row.verdict_agrees ? "" : " !");
}

constexpr NumberForm kTenths{1.0, 1};
constexpr NumberForm kHundredths{1.0, 2};
constexpr NumberForm kMicroseconds{1.0 / kNanosecondsPerMicrosecond, 0};
constexpr NumberForm kMillimetres{kMillimetresPerMetre, 4};
constexpr NumberForm kPercents{kPercent, 2};

constexpr std::array<Field<Row>, 13> kFields{
    {{"integrator", [](const Row& r) { return json_of(r.integrator); }, "integrator", "", kAsIs,
      nullptr, Align::kLeft},
     {"substeps", [](const Row& r) { return json_of(r.substeps); }, "substeps", ""},
     {"ns_per_tick", [](const Row& r) { return json_of(r.ns_per_tick); }, "a tick", "ns", kTenths},
     {"ratio_to_exact", [](const Row& r) { return json_of(r.ratio_to_exact); }, "to exact", "x",
      kHundredths},
     {"set_up_ns", [](const Row& r) { return json_of(r.set_up_ns); }, "set-up", "us",
      kMicroseconds},
     {"max_position_error_m", [](const Row& r) { return json_of(r.max_position_error_m); },
      "position error", "m", kScientific},
     {"energy_balance_error_j", [](const Row& r) { return json_of(r.energy_balance_error_j); },
      "balance error", "J", kScientific},
     {"energy_balance_relative", [](const Row& r) { return json_of(r.energy_balance_relative); },
      "to turnover", "", kScientific},
     {"tail_peak_to_peak_m", [](const Row& r) { return json_of(r.tail_peak_to_peak_m); },
      "tail p-p", "mm", kMillimetres},
     {"tail_peak_to_peak_relative_error",
      [](const Row& r) { return json_of(r.tail_peak_to_peak_relative_error); }, "its error", "%",
      kPercents},
     {"verdict", [](const Row& r) { return json_of(r.verdict); }, "verdict", "", kAsIs,
      verdict_cell, Align::kLeft},
     {"verdict_agrees", [](const Row& r) { return json_of(r.verdict_agrees); }},
     {"diverged_at_tick", [](const Row& r) { return json_of(r.diverged_at_tick); }}}};

Json conditions(const Summary& reference) {
  return {{"scene", reference.scene},
          {"algorithm", reference.algorithm},
          {"duration_s", json_of(reference.duration_s)},
          {"ticks", reference.ticks},
          {"reference_verdict", json_of(reference.verdict)},
          {"reference_tail_peak_to_peak_m", json_of(reference.tail_peak_to_peak_m)},
          {"reference_diverged_at_tick", json_of(reference.diverged_at_tick)}};
}

std::string heading(const Summary& reference) {
  std::string text =
      fmt::format("{} under {}, {} ticks\nreference: {}", reference.scene, reference.algorithm,
                  reference.ticks, file::verdict_text(reference));
  if (reference.diverged_at_tick) {
    return text + "; errors of position and tail do not apply\n";
  }
  return text + fmt::format(", {} mm peak to peak in the last second (tail)\n",
                            fixed(reference.tail_peak_to_peak_m, kMillimetresPerMetre, 4));
}

std::string usual_substeps() { return fmt::format("{}", fmt::join(kUsualSubsteps, ",")); }

// Ascending, without duplicates; empty if the text is wrong.
std::vector<int> parse_substeps(std::string_view text) {
  std::vector<int> counts;
  for (const std::string_view part : file::split(text, ',')) {
    const std::optional<int> count = file::parsed<int>(part);
    if (!count || *count < 1 || *count > kMaxSubsteps) return {};
    counts.push_back(*count);
  }
  std::ranges::sort(counts);
  counts.erase(std::unique(counts.begin(), counts.end()), counts.end());
  return counts;
}

std::string wrong_substeps(std::string_view text) {
  if (!parse_substeps(text).empty()) return "";
  return fmt::format("it takes whole numbers from 1 to {}, separated by commas", kMaxSubsteps);
}

std::string wrong_hand_count(std::string_view text) {
  const auto hands = file::parsed<std::size_t>(text);
  if (hands && *hands >= 1 && *hands <= kMaxAccuracyHands) return "";
  return fmt::format("it takes a whole number from 1 to {}", kMaxAccuracyHands);
}

// Several hands: no times, and no position errors.
Result<Run> plan_of_hands(AccuracyHandsPlan plan) {
  if (const auto problem = validate(plan))
    return usage_error(fmt::format("{}: {}", problem->key, problem->message));
  return Run([plan = std::move(plan)](const Means& means) -> std::optional<Outcome> {
    const auto measured = measure_hands(
        plan,
        {.threads = means.threads, .should_stop = means.should_stop, .progress = means.progress});
    if (!measured) return std::nullopt;
    return outcome_of(plan, *measured);
  });
}

Result<Run> plan(const Scene& scene, const Choices& choices) {
  if (scene.x().device.static_friction_n.value_or(0.0) > 0.0) {
    return usage_error("device.static_friction_n: the reference has Coulomb friction alone");
  }
  if (scene.tick_count() > kMaxAccuracyTicks) {
    return usage_error(
        fmt::format("it takes at most {} ticks, this scene has {}; --duration "
                    "shortens it",
                    kMaxAccuracyTicks, scene.tick_count()));
  }
  const std::vector<int> substeps = parse_substeps(accuracy_study().chosen(choices, "substeps"));
  const auto hands = file::parsed<std::size_t>(accuracy_study().chosen(choices, "hands"));
  if (*hands > 1) return plan_of_hands({scene, substeps, *hands});
  return Run([scene, substeps](const Means& means) -> std::optional<Outcome> {
    const AccuracyStudy measured = measure_accuracy(scene, {.substeps = substeps,
                                                            .now_ns = means.now_ns,
                                                            .should_stop = means.should_stop,
                                                            .on_progress = means.progress});
    if (measured.stopped_early) return std::nullopt;
    return outcome_of(measured);
  });
}

}  // namespace

Outcome outcome_of(const AccuracyStudy& study) {
  Outcome outcome = study::outcome_of<Row>(kFields, conditions(study.reference), study.rows,
                                           {.only_json = {{"reference", kReference}}});
  outcome.sheet.heading = heading(study.reference);
  outcome.sheet.marks = kReferenceNote;
  if (!std::ranges::all_of(study.rows, &Row::verdict_agrees)) {
    outcome.sheet.marks += "! the verdict differs from the reference's\n";
  }
  outcome.figure = work_precision(study);
  return outcome;
}

}  // namespace hapticwall::study::accuracy

namespace hapticwall::study {

const Study& accuracy_study() {
  static const Study kStudy{
      .name = "accuracy",
      .title = "Accuracy",
      .help = "Measure speed and accuracy of every integrator and substep count",
      .about =
          "Error and cost of every integrator and substep count on this scene, against the "
          "exact propagator in extended precision; as 'hapticwall accuracy'",
      .line = "measurement",
      .figure = "Draw error over cost (work-precision diagram)",
      .instead_of_expect =
          "'accuracy' has no single summary; use 'hapticwall run SCENE --expect "
          "EXPR' with --set simulator.integrator=NAME",
      .options = {{"substeps", "N,N,...",
                   fmt::format("Substeps per tick, 1 to {}; default {}", kMaxSubsteps,
                               accuracy::usual_substeps()),
                   accuracy::usual_substeps(), accuracy::wrong_substeps},
                  {"hands", "N",
                   fmt::format("Instead of times, count of N hands within 5 % of the scene's "
                               "stiffness those whose amplitude is right, 1 to {}; default 1",
                               kMaxAccuracyHands),
                   "1", accuracy::wrong_hand_count}},
      .stages = {{{"substeps", "1,10,100"}}, {}},
      .plan = accuracy::plan};
  return kStudy;
}

}  // namespace hapticwall::study
