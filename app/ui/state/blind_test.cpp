#include "app/ui/state/blind_test.h"

#include <fmt/format.h>

#include <random>
#include <utility>

#include "app/file/disk/atomic_file.h"
#include "app/ui/state/comparing.h"
#include "app/ui/state/export.h"

namespace hapticwall::ui {
namespace {

using compare::BlindTrials;
using compare::Presentation;
using compare::Slot;

constexpr const char* kTrialsEnding = "-trials.csv";
constexpr const char* kResultEnding = "-result.csv";

std::uint64_t seed_by_chance() {
  std::random_device chance;
  return chance();
}

std::optional<SceneProblem> problem_with(const Scene& scene, const AlgorithmSettings& settings) {
  Scene candidate = scene;
  candidate.algorithm = settings;
  return validate(candidate);
}

// The outcome of the switch must not reveal the slot.
bool put_blindly(const PanelContext& context, Slot slot) {
  if (!put_in_force(context, slot)) return true;
  end_blind_test(context);
  tell(context.state, MessageKind::kProblem,
       "the blind test ended: the session has refused one of the two algorithms");
  return false;
}

// Both files are on the disk before either gets its name.
Failure write_both(const BlindTest& test, const std::string& base) {
  auto trials = file::AtomicFile::create(base + kTrialsEnding);
  if (!trials) return trials.error();
  auto result = file::AtomicFile::create(base + kResultEnding);
  if (!result) return result.error();
  if (Failure failure = trials->write(test.trials.trials_csv(test.a, test.b))) return failure;
  if (Failure failure = result->write(test.trials.result_csv(test.a, test.b))) return failure;
  if (Failure failure = trials->sync()) return failure;
  if (Failure failure = result->sync()) return failure;
  if (Failure failure = trials->commit()) return failure;
  return result->commit();
}

}  // namespace

void start_blind_test(const PanelContext& context) {
  UiState& state = context.state;
  CompareState& compare = state.compare;
  keep_slots(state, context.session.scene());
  const CompareSlots slots = slots_of(state);
  for (const Slot slot : {Slot::kA, Slot::kB}) {
    if (const auto problem = problem_with(context.session.scene(), slots.of(slot)))
      return tell(state, *problem);
  }
  compare::TrialPlan plan;
  plan.seed = compare.transient.seed ? *compare.transient.seed : seed_by_chance();
  plan.trials = compare.persisted.trials;
  plan.question = compare.persisted.question;
  plan.confidence = compare.persisted.confidence;
  Result<BlindTrials> trials = BlindTrials::create(plan);
  if (!trials) return tell(state, trials.error());
  compare.transient.test = BlindTest{std::move(*trials), compare::describe(slots.of(Slot::kA)),
                                     compare::describe(slots.of(Slot::kB)), slots.active};
  compare.transient.setting_up = false;
  show_page(state, kBlindTestPage);
}

void feel(const PanelContext& context, Presentation presentation) {
  if (!blind_test_runs(context.state)) return;
  BlindTest& test = *context.state.compare.transient.test;
  if (put_blindly(context, test.trials.present(presentation, ImGui::GetTime())))
    test.felt = presentation;
}

void choose(const PanelContext& context, Presentation presentation) {
  if (!blind_test_runs(context.state)) return;
  BlindTest& test = *context.state.compare.transient.test;
  if (const Failure failure = test.trials.choose(presentation, ImGui::GetTime())) {
    tell(context.state, MessageKind::kNote, failure->message);
    return;
  }
  test.felt.reset();
  if (test.trials.finished()) end_blind_test(context);
}

void end_blind_test(const PanelContext& context) {
  if (!blind_test_runs(context.state)) return;
  BlindTest& test = *context.state.compare.transient.test;
  test.running = false;
  if (const auto problem = put_in_force(context, test.slot_before)) tell(context.state, *problem);
}

void save_blind_test(const PanelContext& context) {
  UiState& state = context.state;
  auto& test = state.compare.transient.test;
  if (!test || test->running) return;
  const std::string partial = ".partial";
  const std::string base =
      unused_base(state.transient.recording_folder,
                  plain_file_name(context.session.scene().name + "-blind-test"),
                  {kTrialsEnding, kResultEnding, kTrialsEnding + partial, kResultEnding + partial});
  if (const Failure failure = write_both(*test, base)) return tell(state, *failure);
  test->saved_as = base;
  tell(state, MessageKind::kNote,
       fmt::format("saved {0}{1} and {0}{2}", base, kTrialsEnding, kResultEnding));
}

std::vector<KeyBinding> blind_test_keys() {
  const auto act = [](void (*what)(const PanelContext&, Presentation), Presentation which) {
    return [what, which](const PanelContext& context) { what(context, which); };
  };
  const auto ctrl = [](ImGuiKey key) -> ImGuiKeyChord { return ImGuiMod_Ctrl | key; };
  return {{KeyGroup::kBlindTest,
           "feel the first wall",
           {ImGuiKey_1, ImGuiKey_LeftArrow},
           act(feel, Presentation::kFirst),
           {ImGuiKey_Keypad1}},
          {KeyGroup::kBlindTest,
           "feel the second wall",
           {ImGuiKey_2, ImGuiKey_RightArrow},
           act(feel, Presentation::kSecond),
           {ImGuiKey_Keypad2}},
          {KeyGroup::kBlindTest,
           "choose the first",
           {ctrl(ImGuiKey_1), ctrl(ImGuiKey_LeftArrow)},
           act(choose, Presentation::kFirst),
           {ctrl(ImGuiKey_Keypad1)}},
          {KeyGroup::kBlindTest,
           "choose the second",
           {ctrl(ImGuiKey_2), ctrl(ImGuiKey_RightArrow)},
           act(choose, Presentation::kSecond),
           {ctrl(ImGuiKey_Keypad2)}}};
}

}  // namespace hapticwall::ui
