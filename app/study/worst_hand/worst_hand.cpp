#include "app/study/worst_hand/worst_hand.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <string_view>
#include <utility>

#include "app/file/scene/scene_file.h"
#include "app/file/text/text.h"
#include "app/study/algorithm_names.h"
#include "app/study/field.h"
#include "app/study/studies.h"
#include "core/algorithm/algorithm.h"

namespace hapticwall::study::hands {
namespace {

using worst_hand::Bounds;
using worst_hand::FoundHand;
using worst_hand::kBoundsNames;
using worst_hand::kHandNumberList;
using worst_hand::kMotionNames;
using worst_hand::Motion;

constexpr NumberForm kThree{1.0, 3};
constexpr NumberForm kOne{1.0, 1};

constexpr double kMaxSeconds = 1e6;

// A number of the hand of the table.
Json of_hand(const Row& row, double FoundHand::*member) {
  return row.found.hand ? json_of((*row.found.hand).*member) : Json();
}
template <std::size_t kNumber>
Json number_of_hand(const Row& row) {
  const bool has_number = row.found.hand && kNumber < worst_hand::number_count(row.motion);
  return has_number ? json_of(row.found.hand->values.at(kNumber)) : Json();
}
Json most_of(const Row& row) { return row.found.hand ? json_of(row.found.most_j()) : Json(); }
Json power_of(const Row& row) {
  return row.found.hand ? json_of(row.found.hand->last_second_w) : Json();
}

// The numbers of the hand that sit at a bound, separated by spaces; "" without a hand.
std::string numbers_at_bounds(const Row& row) {
  std::string names;
  for (std::size_t i = 0; row.found.hand && i < worst_hand::number_count(row.motion); ++i) {
    if (!worst_hand::is_at_bound(row.found.hand->values, i, row.bounds)) continue;
    names += (names.empty() ? "" : " ") + std::string(kHandNumberList.at(i).key);
  }
  return names;
}

// "*" behind a number that sits at a bound.
template <std::size_t kNumber>
std::string number_text_of(const Row& row) {
  if (!row.found.hand) return "- ";
  const bool at_bound = worst_hand::is_at_bound(row.found.hand->values, kNumber, row.bounds);
  return fmt::format("{:.3g}{}", row.found.hand->values.at(kNumber), at_bound ? "*" : " ");
}

std::string first_text(const Row& row) {
  return row.found.first() ? fmt::format("{}", *row.found.first()) : "-";
}

Json needed_damping(const Row& row) {
  return row.criterion ? json_of(row.criterion->needed_n_s_per_m) : Json();
}
const std::optional<worst_hand::SpringRange>& springs_of(const Row& row) {
  static const std::optional<worst_hand::SpringRange> kNone;
  return row.criterion ? row.criterion->unstable_springs : kNone;
}

template <std::size_t kNumber>
constexpr Field<Row> hand_field(std::string_view title) {
  return {kHandNumberList.at(kNumber).key,
          number_of_hand<kNumber>,
          title,
          kHandNumberList.at(kNumber).unit,
          kAsIs,
          number_text_of<kNumber>};
}

constexpr Field<Row> kSpeed = hand_field<6>("v");

constexpr std::array<Field<Row>, 22> kFields{
    {{"algorithm", [](const Row& r) { return json_of(r.algorithm); }, "algorithm", "", kAsIs,
      nullptr, Align::kLeft},
     {"hands", [](const Row& r) { return json_of(r.found.hands); }, "hands", ""},
     {"refused_hands", [](const Row& r) { return json_of(r.found.refused); }},
     {"first_hand", [](const Row& r) { return json_of(r.found.first()); }, "first", "", kAsIs,
      first_text},
     {"most_j", most_of, "most", "J", kThree},
     {"typical_j", [](const Row& r) { return of_hand(r, &FoundHand::typical_j); }, "typical", "J",
      kThree},
     {"least_j", [](const Row& r) { return of_hand(r, &FoundHand::least_j); }, "least", "J",
      kThree},
     {"taken_j", [](const Row& r) { return of_hand(r, &FoundHand::taken_j); }},
     {"taken_at_rest_j", [](const Row& r) { return of_hand(r, &FoundHand::taken_at_rest_j); }},
     {"last_second_w", power_of, "power", "W", kThree},
     hand_field<0>("m_h"),
     hand_field<1>("k_h"),
     hand_field<2>("b_h"),
     hand_field<3>("k_g"),
     hand_field<4>("b_g"),
     hand_field<5>("press"),
     {kSpeed.key, kSpeed.value},
     {"at_bound",
      [](const Row& r) { return r.found.hand ? json_of(numbers_at_bounds(r)) : Json(); }},
     {"needed_damping_n_s_per_m", needed_damping},
     {"unstable_spring_from_n_per_m",
      [](const Row& r) { return springs_of(r) ? json_of(springs_of(r)->from_n_per_m) : Json(); }},
     {"unstable_spring_to_n_per_m",
      [](const Row& r) { return springs_of(r) ? json_of(springs_of(r)->to_n_per_m) : Json(); }},
     {"critical_mass_kg",
      [](const Row& r) { return r.criterion ? json_of(r.criterion->critical_mass_kg) : Json(); }}}};

// The sheet has a column for the speed of ramps only.
std::vector<Field<Row>> fields_of(Motion motion) {
  std::vector<Field<Row>> fields(kFields.begin(), kFields.end());
  if (motion == Motion::kRamp) *std::ranges::find(fields, kSpeed.key, &Field<Row>::key) = kSpeed;
  return fields;
}

Json conditions(const worst_hand::Plan& plan) {
  return {{"scene", plan.scene.name},
          {"duration_s", json_of(plan.scene.duration_s)},
          {"wall_stiffness_n_per_m", json_of(plan.scene.x().walls.front().stiffness_n_per_m)},
          {"bounds", kBoundsNames.at(static_cast<std::size_t>(plan.bounds))},
          {"motion", kMotionNames.at(static_cast<std::size_t>(plan.motion))},
          {"seed", plan.seed},
          {"planned_hands", plan.hands}};
}

std::string heading(const worst_hand::Plan& plan) {
  const auto& bounds = kBoundsNames.at(static_cast<std::size_t>(plan.bounds));
  const char* motion = plan.motion == Motion::kRamp
                           ? "ramps from the handle into the wall; energy counts after their end"
                           : "let go at rest in front of the wall";
  return fmt::format(
      "{}: a search for a hand that takes energy, wall of {} kN/m, {:g} s each\n"
      "hands: {}; {} bounds, seed {}\n",
      plan.scene.name, table::kilonewtons_per_metre(plan.scene.x().walls.front().stiffness_n_per_m),
      plan.scene.duration_s, motion, bounds, plan.seed);
}

std::string spring_text(const worst_hand::SpringRange& springs) {
  const std::string from = fmt::format("{:.6g}", springs.from_n_per_m);
  if (!springs.to_n_per_m) return fmt::format("springs above {} N/m are unstable", from);
  return fmt::format("springs of {} to {:.6g} N/m are unstable", from, *springs.to_n_per_m);
}

std::string mass_text(double critical_kg) {
  if (critical_kg == 0.0) return "every mass is unstable";
  return fmt::format("handle and hand of more than {:.6g} kg in all are unstable", critical_kg);
}

// One line for each linear loop, whose answer is exact.
std::string criterion_lines(const worst_hand::Plan& plan, const std::vector<Row>& rows) {
  std::string text;
  const double damping = plan.scene.x().device.damping_n_s_per_m;
  for (const Row& row : rows) {
    if (!row.criterion) continue;
    const double needed = row.criterion->needed_n_s_per_m;
    text += fmt::format(
        "under {}, in contact, no hand takes energy if b > {:.6g} N s/m; this device has "
        "{:g}; ",
        row.algorithm, needed, damping);
    text += springs_of(row) ? spring_text(*springs_of(row)) : "no spring is unstable";
    if (row.criterion->critical_mass_kg) text += "; " + mass_text(*row.criterion->critical_mass_kg);
    text += "\n";
  }
  return text;
}

std::string marks(const worst_hand::Plan& plan, const std::vector<Row>& rows) {
  std::string text =
      "most: the largest energy that a hand took; numbers of the hand with the largest typical "
      "energy:\n"
      "typical, least: median and minimum of 32 hands within 1 %; power: to the hand in the last "
      "second\n";
  if (std::ranges::any_of(rows, [](const Row& row) { return !row.found.hand; }))
    text += "-: no hand took 1e-9 J; that proves nothing\n";
  if (std::ranges::any_of(rows, [](const Row& row) { return !numbers_at_bounds(row).empty(); }))
    text += "* at a bound: other bounds give another result\n";
  if (std::ranges::any_of(rows, [&](const Row& row) { return row.found.hands < plan.hands; }))
    text += fmt::format("the time was up before {} hands: another run may give another result\n",
                        plan.hands);
  return text + criterion_lines(plan, rows);
}

// The scene with the hand of the largest typical energy.
std::string scene_text(const std::vector<Row>& rows) {
  const auto typical = [](const Row& row) {
    return row.found.hand ? row.found.hand->typical_j : -1.0;
  };
  const Row& row = *std::ranges::max_element(rows, {}, typical);
  if (!row.found.hand) return "";
  Scene scene = row.found.hand->scene;
  scene.description =
      fmt::format("Found by worst-hand: this hand takes {} J under {}",
                  file::shortest_number(row.found.hand->taken_at_rest_j), row.algorithm);
  return file::scene_to_toml(scene);
}

std::string wrong_seed(std::string_view text) {
  return file::parsed<std::uint64_t>(text) ? "" : "it takes a whole number of at most 64 bits";
}
std::string wrong_bounds(std::string_view text) {
  return std::ranges::find(kBoundsNames, text) != kBoundsNames.end() ? ""
                                                                     : "it takes wide or narrow";
}
std::string wrong_motion(std::string_view text) {
  return std::ranges::find(kMotionNames, text) != kMotionNames.end() ? ""
                                                                     : "it takes let-go or ramp";
}
std::string wrong_seconds(std::string_view text) {
  if (text.empty()) return "";
  const auto seconds = file::parsed<double>(text);
  if (seconds && *seconds > 0.0 && *seconds <= kMaxSeconds) return "";
  return fmt::format("it takes seconds above 0, at most {:.0f}", kMaxSeconds);
}

// The rows of a comparison; the scene's own algorithm without a name.
std::vector<ComparedAlgorithm> rows_of(const Scene& scene, std::string_view names) {
  if (names.empty()) return {{scene.algorithm, algorithm_label(scene.algorithm)}};
  return compared_algorithms(scene.algorithm, algorithms_of(names));
}

struct Task {
  worst_hand::Plan plan;
  std::vector<ComparedAlgorithm> algorithms;
  std::optional<double> seconds;  // of each search
};

std::optional<Outcome> compute(const Task& task, const Means& means) {
  using Clock = std::chrono::steady_clock;
  std::vector<Row> rows;
  const auto count = static_cast<double>(task.algorithms.size());
  for (const ComparedAlgorithm& algorithm : task.algorithms) {
    worst_hand::Plan plan = task.plan;
    plan.scene.algorithm = algorithm.settings;
    worst_hand::SearchOptions options{.threads = means.threads,
                                      .should_stop = means.should_stop,
                                      .time_is_up = {},
                                      .progress = {}};
    if (means.progress) {
      options.progress = [&](double fraction) {
        means.progress((static_cast<double>(rows.size()) + fraction) / count);
      };
    }
    if (task.seconds) {
      options.time_is_up = [begin = Clock::now(), &task] {
        return std::chrono::duration<double>(Clock::now() - begin).count() >= *task.seconds;
      };
    }
    std::optional<worst_hand::Found> found = worst_hand::search(plan, options);
    if (!found) return std::nullopt;
    rows.push_back({algorithm.label, plan.bounds, plan.motion, std::move(*found),
                    worst_hand::damping_criterion(plan.scene)});
  }
  return outcome_of(task.plan, rows);
}

Result<Run> plan(const Scene& scene, const Choices& choices) {
  const Study& study = worst_hand_study();
  const auto chosen = [&](std::string_view key) { return study.chosen(choices, key); };
  Task task;
  task.plan.scene = axis_scene(scene, 0);
  task.plan.hands = *file::parsed<std::uint64_t>(chosen("hands"));
  task.plan.seed = *file::parsed<std::uint64_t>(chosen("seed"));
  task.plan.bounds = chosen("bounds") == "wide" ? Bounds::kWide : Bounds::kNarrow;
  task.plan.motion = chosen("motion") == "ramp" ? Motion::kRamp : Motion::kLetGo;
  task.seconds = file::parsed<double>(chosen("seconds"));
  task.algorithms = rows_of(scene, chosen("algorithms"));
  if (const auto problem = worst_hand::problem_of(task.plan.scene, task.plan.bounds))
    return usage_error(problem->key + ": " + problem->message);
  return Run([task = std::move(task)](const Means& means) { return compute(task, means); });
}

}  // namespace

std::string wrong_hands(std::string_view text) {
  const auto hands = file::parsed<std::uint64_t>(text);
  if (hands && *hands >= 1 && *hands <= worst_hand::kMaxHands) return "";
  return fmt::format("it takes a whole number from 1 to {}", worst_hand::kMaxHands);
}

Outcome outcome_of(const worst_hand::Plan& plan, const std::vector<Row>& rows) {
  Outcome outcome = study::outcome_of<Row>(fields_of(plan.motion), conditions(plan), rows);
  outcome.sheet.heading = heading(plan);
  outcome.sheet.marks = marks(plan, rows);
  outcome.figure = gains_figure(plan, rows);
  outcome.scene = scene_text(rows);
  return outcome;
}

}  // namespace hapticwall::study::hands

namespace hapticwall::study {

const Study& worst_hand_study() {
  static const Study kStudy{
      .name = "worst-hand",
      .title = "Worst hand",
      .help = "Search for a hand that takes energy out of the wall",
      .about =
          "A search for a hand that takes energy out of this scene's wall, and what it takes; as "
          "'hapticwall worst-hand'",
      .line = "algorithm",
      .figure = "Draw the largest energy over the number of hands",
      .scene_file =
          "Write the scene with the hand of the largest typical energy, if a hand took any",
      .instead_of_expect =
          "'worst-hand' has no single summary; use --scene-file FILE and 'hapticwall run FILE "
          "--expect EXPR'",
      .options = {{"algorithms", "A,B,...", "These algorithms; default: that of the scene", "",
                   wrong_algorithms},
                  {"hands", "N", "Hands to try for each algorithm; default 10000", "10000",
                   hands::wrong_hands},
                  {"seed", "N", "Seed of the search; default 1", "1", hands::wrong_seed},
                  {"bounds", "wide|narrow", "Bounds of the hands; default wide", "wide",
                   hands::wrong_bounds},
                  {"motion", "let-go|ramp",
                   "Path of the hands: one point, or a ramp into the wall; default let-go",
                   "let-go", hands::wrong_motion},
                  {"seconds", "S", "End each search after this time with the hands so far", "",
                   hands::wrong_seconds}},
      .stages = {{{"hands", "1500"}}, {}},
      .plan = hands::plan};
  return kStudy;
}

}  // namespace hapticwall::study
