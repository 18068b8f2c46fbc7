#include "app/study/ranking/ranking.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "app/file/text/text.h"
#include "app/study/algorithm_names.h"
#include "app/study/field.h"
#include "app/study/studies.h"
#include "app/study/worst_hand/worst_hand.h"
#include "app/table/hand_column.h"
#include "core/algorithm/algorithm.h"
#include "core/units.h"

namespace hapticwall::study::ranking {
namespace {

using Row = ContactMetrics;
using table::fixed;
using table::kilonewtons_per_metre;

constexpr NumberForm kPerKilo{1.0 / kNewtonsPerKilonewton, 2};
constexpr NumberForm kMillimetres{kMillimetresPerMetre, 3};
constexpr NumberForm kMilliseconds{kMillisecondsPerSecond, 1};
constexpr NumberForm kMillijoules{kMillijoulesPerJoule, 2};
constexpr NumberForm kNewtons{1.0, 2};

// Marks in the order of RiseKind; of equal width, to align the numbers.
constexpr std::array<std::string_view, 3> kRiseMarks{"  ", " *", " +"};
constexpr std::array<std::string_view, 3> kRiseNames{"mean", "one-tick", "to-the-limit"};

// A number of the run below the first failure.
Json of_stiffest(const Row& row, std::optional<double> Summary::*key) {
  const std::optional<Summary> run = row.stiffest();
  return run ? json_of((*run).*key) : Json();
}

bool rises(const Row& row, RiseKind kind) {
  return row.rate_hardness_n_per_m && row.rise_kind == kind;
}

std::string rate_hardness_text(const Row& row) {
  const RiseKind kind = row.rate_hardness_n_per_m ? row.rise_kind : RiseKind::kMean;
  return kilonewtons_per_metre(row.rate_hardness_n_per_m) +
         std::string(kRiseMarks.at(static_cast<std::size_t>(kind)));
}

Json rise_name(const Row& row) {
  if (!row.rate_hardness_n_per_m) return {};
  return kRiseNames.at(static_cast<std::size_t>(row.rise_kind));
}

constexpr std::array<Field<Row>, 17> kFields{
    {{"algorithm", [](const Row& r) { return json_of(r.summary.algorithm); }, "algorithm", "",
      kAsIs, nullptr, Align::kLeft},
     {"stiffest_n_per_m",
      [](const Row& r) { return of_stiffest(r, &Summary::displayed_stiffness_n_per_m); },
      "stiffest", "kN/m", kPerKilo},
     {"stiffest_tail_force_std_n",
      [](const Row& r) { return of_stiffest(r, &Summary::tail_force_std_n); }, "force", "+/- N",
      kNewtons},
     {"first_settled", [](const Row& r) { return json_of(r.limits.settled.first); }},
     {"last_settled", [](const Row& r) { return json_of(r.limits.settled.last); }, "last settled",
      "kN/m", kPerKilo},
     {"first_failure", [](const Row& r) { return json_of(r.limits.failed.first); }, "first failure",
      "kN/m", kPerKilo},
     {"last_failure", [](const Row& r) { return json_of(r.limits.failed.last); }},
     {"changes", [](const Row& r) { return json_of(r.limits.changes); }, "changes  ", "", kAsIs,
      [](const Row& r) { return table::changes_text(r.limits.changes); }},
     {"stable_below_n_per_m", [](const Row& r) { return json_of(r.limits.stable_below_n_per_m); }},
     {"approach_speed_m_per_s", [](const Row& r) { return json_of(r.approach_speed_m_per_s); }},
     {"rate_hardness_n_per_m", [](const Row& r) { return json_of(r.rate_hardness_n_per_m); },
      "rate-hardness  ", "kN/m  ", kAsIs, rate_hardness_text},
     {"rate_hardness_of", rise_name},
     {"rise_time_s", [](const Row& r) { return json_of(r.rise_time_s); }, "rise time", "ms",
      kMilliseconds},
     {"peak_penetration_m", [](const Row& r) { return json_of(r.peak_penetration_m); }, "deepest",
      "mm", kMillimetres},
     {"energy_to_hand_j", [](const Row& r) { return json_of(r.energy_to_hand_j); }, "to the hand",
      "mJ", kMillijoules},
     {"verdict", [](const Row& r) { return json_of(r.summary.verdict); }, "verdict", "", kAsIs,
      nullptr, Align::kLeft},
     {"tail_peak_to_peak_m", [](const Row& r) { return json_of(r.summary.tail_peak_to_peak_m); },
      "tail p-p", "mm", kMillimetres}}};
// The columns of a search for a hand that takes energy; `title` lives as long as they do.
constexpr std::array<Field<Row>, 3> search_fields(std::string_view title) {
  return {{{"searched_hands", [](const Row& r) { return json_of(r.summary.searched_hands); }},
           {"most_taken_j", [](const Row& r) { return json_of(r.summary.most_taken_j); }},
           {"typical_taken_j", [](const Row& r) { return json_of(r.summary.typical_taken_j); },
            title, table::kHandColumnUnit, kAsIs,
            [](const Row& r) { return table::hand_column_text(r.summary); }}}};
}

// The sheet has the failure before the settled value; JSON and CSV pair first and last.
constexpr std::array<std::string_view, 12> kColumns{
    "algorithm",       "stiffest",  "force",   "first failure", "last settled", "changes  ",
    "rate-hardness  ", "rise time", "deepest", "to the hand",   "tail p-p",     "verdict"};

// Conditions of the scene and the scan, in lines.
std::string heading(const ContactStudyPlan& plan, const std::vector<Row>& rows) {
  std::optional<double> speed;
  for (const Row& row : rows) {
    if (!speed) speed = row.approach_speed_m_per_s;
  }
  const MapAxis axis = plan.stiffnesses();
  std::string text = fmt::format(
      "{}{}: wall of {} kN/m, met at {} m/s, {:g} s\n"
      "limits: {} stiffnesses of the wall from {} to {} N/m in steps of {:.2g} %, refined to "
      "{:g}\n",
      plan.scene.name, plan.scene.two_axes() ? ", axis x" : "",
      kilonewtons_per_metre(plan.scene.x().walls.front().stiffness_n_per_m), fixed(speed, 1.0, 3),
      plan.scene.duration_s, axis.count, file::shortest_number(axis.low),
      file::shortest_number(axis.high), kPercent * (axis.value(1) / axis.value(0) - 1.0),
      plan.tolerance);
  const DeviceSettings& device = plan.scene.x().device;
  if (!device.chai3d_stiffness_n_per_m || !device.chai3d_damping_n_s_per_m) return text;
  return text + fmt::format("CHAI3D allows on this device: a wall of at most {} kN/m, {:g} N s/m\n",
                            kilonewtons_per_metre(device.chai3d_stiffness_n_per_m),
                            *device.chai3d_damping_n_s_per_m);
}

std::string marks(const std::vector<Row>& rows) {
  const auto any = [&](auto holds) { return std::ranges::any_of(rows, holds); };
  std::string text;
  if (any([](const Row& r) { return r.limits.changes > 1; })) text += table::kManyChangesNote;
  if (any([](const Row& r) { return rises(r, RiseKind::kOneTick); })) {
    text +=
        "* one jump in one tick: depends on the position of the wall between two encoder counts\n";
  }
  if (any([](const Row& r) { return rises(r, RiseKind::kToTheLimit); })) {
    text += "+ limited by the force limit\n";
  }
  return text;
}

Json conditions(const ContactStudyPlan& plan) {
  const MapAxis axis = plan.stiffnesses();
  return {{"scene", plan.scene.name},
          {"duration_s", json_of(plan.scene.duration_s)},
          {"rate_hz", json_of(plan.scene.sampling.rate_hz)},
          {"wall_stiffness_n_per_m", json_of(plan.scene.x().walls.front().stiffness_n_per_m)},
          {"scan_low_n_per_m", json_of(axis.low)},
          {"scan_high_n_per_m", json_of(axis.high)},
          {"scan_count", axis.count},
          {"scan_tolerance", json_of(plan.tolerance)}};
}

struct Task {
  ContactStudyPlan contact;
  std::optional<std::uint64_t> hands;  // of a search under each row
};

std::string wrong_search(std::string_view text) {
  return text.empty() ? "" : hands::wrong_hands(text);
}

// False if `should_stop` returned true.
bool search_hands(const Task& task, const Means& means, std::vector<Row>& rows) {
  const auto compared = compared_algorithms(task.contact.scene.algorithm, task.contact.algorithms);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    worst_hand::Plan plan{axis_scene(task.contact.scene, 0), *task.hands};
    plan.scene.algorithm = compared[i].settings;
    const auto found = worst_hand::search(
        plan, {.threads = means.threads,
               .should_stop = means.should_stop,
               .time_is_up = {},
               .progress = [&](double fraction) {
                 const double done = static_cast<double>(i) + fraction;
                 if (means.progress)
                   means.progress(0.5 + 0.5 * done / static_cast<double>(rows.size()));
               }});
    if (!found) return false;
    found->put(rows[i].summary);
  }
  return true;
}

std::optional<Outcome> compute(const Task& task, const Means& means) {
  const double share = task.hands ? 0.5 : 1.0;  // of the progress
  std::vector<Row> rows = study_contact(task.contact, {.threads = means.threads,
                                                       .should_stop = means.should_stop,
                                                       .progress = [&](double fraction) {
                                                         if (means.progress)
                                                           means.progress(share * fraction);
                                                       }});
  if (rows.empty() || (task.hands && !search_hands(task, means, rows))) return std::nullopt;
  return outcome_of(task.contact, rows);
}

Result<Run> plan(const Scene& scene, const Choices& choices) {
  const Study& study = ranking_study();
  Task task;
  task.contact.scene = scene;
  task.contact.algorithms = algorithms_of(study.chosen(choices, "algorithms"));
  task.hands = file::parsed<std::uint64_t>(study.chosen(choices, "worst-hand"));
  if (const auto problem = validate(task.contact))
    return usage_error(problem->key + ": " + problem->message);
  if (task.hands) {
    const Scene of_x = axis_scene(scene, 0);
    if (const auto problem = worst_hand::problem_of(of_x, worst_hand::Bounds::kWide))
      return usage_error(problem->key + ": " + problem->message);
  }
  return Run([task = std::move(task)](const Means& means) { return compute(task, means); });
}

}  // namespace

Outcome outcome_of(const ContactStudyPlan& plan, const std::vector<ContactMetrics>& rows) {
  // 0: no search.
  const std::uint64_t hands = rows.empty() ? 0 : rows.front().summary.searched_hands.value_or(0);
  const std::string title = table::hand_column_title(hands);
  std::vector<Field<Row>> fields(kFields.begin(), kFields.end());
  std::vector<std::string_view> order(kColumns.begin(), kColumns.end());
  if (hands > 0) {
    std::ranges::copy(search_fields(title), std::back_inserter(fields));
    order.push_back(title);
  }
  Outcome outcome = study::outcome_of<Row>(fields, conditions(plan), rows, {.order = order});
  outcome.sheet.heading = heading(plan, rows);
  outcome.sheet.marks = marks(rows) + (hands > 0 ? table::hand_column_note(hands) : "");
  return outcome;
}

}  // namespace hapticwall::study::ranking

namespace hapticwall::study {

const Study& ranking_study() {
  static const Study kStudy{
      .name = "ranking",
      .title = "Ranking",
      .has_command = false,
      .help =
          "Instead, measure largest stable stiffness, rate-hardness, rise time, peak "
          "penetration and energy to the hand",
      .about =
          "All algorithms on this scene: largest stable stiffness, hardness at the touch, "
          "energy to the hand; as 'hapticwall compare --study'",
      .line = "row",
      .figure = "",
      .instead_of_expect =
          "not with --study, which has no summary; use 'hapticwall compare SCENE "
          "--expect EXPR'",
      .options = {{"algorithms", "A,B,...", "These algorithms only", "", wrong_algorithms},
                  {"worst-hand", "HANDS", "Also search as many hands for one that takes energy", "",
                   ranking::wrong_search}},
      .of_all_algorithms = true,
      .stages = {{}},
      .plan = ranking::plan};
  return kStudy;
}

}  // namespace hapticwall::study
