#include "app/study/named_hands/named_hands.h"

#include <fmt/format.h>

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "app/file/scene/hand_description.h"
#include "app/file/text/text.h"
#include "app/study/algorithm_names.h"
#include "app/study/field.h"
#include "app/study/studies.h"
#include "core/units.h"

namespace hapticwall::study::named_hands {
namespace {

using Row = HandsRow;

constexpr std::string_view kAllHands = "all";
constexpr NumberForm kNewtons{1.0, 3};
constexpr NumberForm kMillijoules{kMillijoulesPerJoule, 2};
constexpr NumberForm kPerKilo{1.0 / kNewtonsPerKilonewton, 2};

std::optional<double> chatter(const Summary& run) { return run.chatter_n; }
std::optional<double> swing(const Summary& run) { return run.swing_m; }
std::optional<double> given(const Summary& run) { return run.given_j; }
std::optional<double> stiffness(const Summary& run) { return run.displayed_stiffness_n_per_m; }

std::string good_text(const Row& row) {
  return fmt::format("{} of {}", row.good(), row.runs.size());
}

// The name of the worst hand is no part of a row.
struct NamedRow {
  Row row;
  std::string worst_hand;
};

constexpr std::array<Field<NamedRow>, 15> kFields{
    {{"algorithm", [](const NamedRow& r) { return json_of(r.row.algorithm); }, "algorithm", "",
      kAsIs, nullptr, Align::kLeft},
     {"own_verdict", [](const NamedRow& r) { return json_of(r.row.own.verdict); }, "own hand", "",
      kAsIs, nullptr, Align::kLeft},
     {"hands", [](const NamedRow& r) { return json_of(r.row.runs.size()); }},
     {"good", [](const NamedRow& r) { return json_of(r.row.good()); }, "good", "", kAsIs,
      [](const NamedRow& r) { return good_text(r.row); }},
     {"median_verdict", [](const NamedRow& r) { return json_of(r.row.median_verdict()); }, "median",
      "", kAsIs, nullptr, Align::kLeft},
     {"worst_verdict", [](const NamedRow& r) { return json_of(r.row.runs[r.row.worst()].verdict); },
      "worst", "", kAsIs, nullptr, Align::kLeft},
     {"worst_hand", [](const NamedRow& r) { return json_of(r.worst_hand); }, "worst hand", "",
      kAsIs, nullptr, Align::kLeft},
     {"max_chatter_n", [](const NamedRow& r) { return json_of(max_of(r.row.runs, chatter)); },
      "max chatter", "N", kNewtons},
     {"median_chatter_n", [](const NamedRow& r) { return json_of(median_of(r.row.runs, chatter)); },
      "median chatter", "N", kNewtons},
     {"max_swing_m", [](const NamedRow& r) { return json_of(max_of(r.row.runs, swing)); }},
     {"median_swing_m", [](const NamedRow& r) { return json_of(median_of(r.row.runs, swing)); }},
     {"max_given_j", [](const NamedRow& r) { return json_of(max_of(r.row.runs, given)); },
      "max given", "mJ", kMillijoules},
     {"median_given_j", [](const NamedRow& r) { return json_of(median_of(r.row.runs, given)); },
      "median given", "mJ", kMillijoules},
     {"min_displayed_stiffness_n_per_m",
      [](const NamedRow& r) { return json_of(min_of(r.row.runs, stiffness)); }, "least stiff",
      "kN/m", kPerKilo},
     {"median_displayed_stiffness_n_per_m",
      [](const NamedRow& r) { return json_of(median_of(r.row.runs, stiffness)); }, "median stiff",
      "kN/m", kPerKilo}}};

// "0.218 kg, 78.75 N/m, 4.645 N s/m, grip 379.5 N/m, 1.839 N s/m".
std::string numbers_text(const HandSettings& hand) {
  std::string text = hand.mass_kg ? file::shortest_number(*hand.mass_kg) + " kg" : "no mass";
  text += fmt::format(", {} N/m, {} N s/m", file::shortest_number(hand.stiffness_n_per_m),
                      file::shortest_number(hand.damping_n_s_per_m));
  if (!hand.has_grip()) return text + ", no grip";
  return text + fmt::format(", grip {} N/m, {} N s/m",
                            file::shortest_number(*hand.grip_stiffness_n_per_m),
                            file::shortest_number(hand.grip_damping_n_s_per_m.value_or(0.0)));
}

std::string heading(const HandsPlan& plan) {
  const DeviceSettings& device = plan.scene.x().device;
  return fmt::format(
      "{}{}: {} {} on the scene's path, friction {} N, delay {} ticks, {:g} s\nown hand: {}\n",
      plan.scene.name, plan.scene.two_axes() ? ", axis x" : "", plan.hands.size(),
      plan.hands.size() == 1 ? "hand" : "hands",
      file::shortest_number(device.friction_n.value_or(0.0)), device.delay_ticks.value_or(0),
      plan.scene.duration_s, numbers_text(*plan.scene.x().hand));
}

std::string marks(const HandsPlan& plan) {
  std::string text =
      "good: settled or moving. A median belongs to a run: of an even number it is the worse of "
      "the "
      "two in\nthe middle. On the same path a softer hand presses with less force "
      "(docs/hands.md).\n";
  for (const StudiedHand& hand : plan.hands)
    text += fmt::format("{}: {}\n", hand.name, numbers_text(hand.numbers));
  return text;
}

Json json_of_hand(const HandSettings& hand) {
  return {{"mass_kg", json_of(hand.mass_kg)},
          {"stiffness_n_per_m", json_of(hand.stiffness_n_per_m)},
          {"damping_n_s_per_m", json_of(hand.damping_n_s_per_m)},
          {"grip_stiffness_n_per_m", json_of(hand.grip_stiffness_n_per_m)},
          {"grip_damping_n_s_per_m", json_of(hand.grip_damping_n_s_per_m)}};
}

Json json_of_run(const std::string& hand, const Summary& run) {
  return {{"hand", hand},
          {"verdict", json_of(run.verdict)},
          {"tail_peak_to_peak_m", json_of(run.tail_peak_to_peak_m)},
          {"tail_force_mean_n", json_of(run.tail_force_mean_n)},
          {"displayed_stiffness_n_per_m", json_of(run.displayed_stiffness_n_per_m)},
          {"chatter_n", json_of(run.chatter_n)},
          {"swing_m", json_of(run.swing_m)},
          {"shake_m_per_s2", json_of(run.shake_m_per_s2)},
          {"given_j", json_of(run.given_j)},
          {"passivity_margin_j", json_of(run.passivity_margin_j)}};
}

Json conditions(const HandsPlan& plan) {
  const DeviceSettings& device = plan.scene.x().device;
  return {{"scene", plan.scene.name},
          {"duration_s", json_of(plan.scene.duration_s)},
          {"rate_hz", json_of(plan.scene.sampling.rate_hz)},
          {"friction_n", json_of(device.friction_n.value_or(0.0))},
          {"delay_ticks", device.delay_ticks.value_or(0)}};
}

// The rows with all runs, which CSV leaves out.
std::string json_text_of(const HandsPlan& plan, const std::vector<NamedRow>& rows) {
  Json head = conditions(plan);
  head["own_hand"] = json_of_hand(*plan.scene.x().hand);
  for (const StudiedHand& hand : plan.hands) head["hands"][hand.name] = json_of_hand(hand.numbers);
  std::vector<Json> objects;
  for (const NamedRow& named : rows) {
    Json& object = objects.emplace_back(Json::object());
    for (const Field<NamedRow>& field : kFields)
      object[std::string(field.key)] = field.value(named);
    for (std::size_t i = 0; i < plan.hands.size(); ++i)
      object["runs"].push_back(json_of_run(plan.hands[i].name, named.row.runs[i]));
  }
  return table::study_json_text(head, objects);
}

std::vector<std::string> names_in(std::string_view text) {
  std::vector<std::string> names;
  for (const file::BuiltinHand& hand : file::builtin_hands()) {
    if (text == kAllHands) names.push_back(hand.name);
  }
  if (text == kAllHands) return names;
  for (const std::string_view name : file::split(text, ',')) names.emplace_back(name);
  return names;
}

std::string wrong_hands(std::string_view text) {
  for (const std::string& name : names_in(text)) {
    const auto hand = file::load_hand_description(name);
    if (!hand) return hand.error().message;
  }
  return "";
}

Result<Run> plan(const Scene& scene, const Choices& choices) {
  HandsPlan plan;
  plan.scene = scene;
  plan.algorithms = algorithms_of(named_hands_study().chosen(choices, "algorithms"));
  for (const std::string& name : names_in(named_hands_study().chosen(choices, "hands"))) {
    const auto hand = file::load_hand_description(name);
    if (!hand) return hand.error();
    plan.hands.push_back({name, hand->hand});
  }
  if (const auto problem = validate(plan)) {
    return usage_error(problem->key + ": " + problem->message);
  }
  return Run([plan = std::move(plan)](const Means& means) -> std::optional<Outcome> {
    const std::vector<Row> rows = study_hands(
        plan,
        {.threads = means.threads, .should_stop = means.should_stop, .progress = means.progress});
    if (rows.empty()) return std::nullopt;
    return outcome_of(plan, rows);
  });
}

}  // namespace

Outcome outcome_of(const HandsPlan& plan, const std::vector<HandsRow>& rows) {
  std::vector<NamedRow> named;
  named.reserve(rows.size());
  for (const HandsRow& row : rows) named.push_back({row, plan.hands[row.worst()].name});
  Outcome outcome = study::outcome_of<NamedRow>(kFields, conditions(plan), named);
  outcome.json = json_text_of(plan, named);
  outcome.sheet.heading = heading(plan);
  outcome.sheet.marks = marks(plan);
  return outcome;
}

}  // namespace hapticwall::study::named_hands

namespace hapticwall::study {

const Study& named_hands_study() {
  static const Study kStudy{
      .name = "hands",
      .title = "Hands",
      .has_command = false,
      .help =
          "Instead, run every algorithm with these named hands (all: the built-in ones) and print "
          "the worst and the median over them",
      .about =
          "All algorithms on this scene with the hands of docs/hands.md: verdict, chatter, energy "
          "given, worst and median; as 'hapticwall compare --hands all'",
      .line = "row",
      .figure = "",
      .instead_of_expect =
          "not with --hands, which has no summary; use 'hapticwall compare SCENE --set hand=NAME "
          "--expect EXPR'",
      .options = {{"hands", "NAME,...", "Named hands; default all", "all",
                   named_hands::wrong_hands},
                  {"algorithms", "A,B,...", "These algorithms only", "", wrong_algorithms}},
      .of_all_algorithms = true,
      .stages = {{}},
      .plan = named_hands::plan};
  return kStudy;
}

}  // namespace hapticwall::study
