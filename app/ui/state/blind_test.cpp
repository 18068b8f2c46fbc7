#include "app/ui/state/blind_test.h"

#include <fmt/format.h>

#include <random>
#include <utility>

#include "app/file/disk/atomic_file.h"
#include "app/file/text/text.h"
#include "app/ui/state/changes.h"
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

// The outcome of the switch must not reveal the slot.
bool put_blindly(const PanelContext& context, const Scene& scene) {
  if (!ask_for(context, scene)) return true;
  end_blind_test(context);
  tell(context.state, MessageKind::kProblem,
       "the blind test ended: the session has refused one of the two walls");
  return false;
}

const Scene& scene_of(const BlindTest& test, Slot slot) {
  const runtime::SlotScenes& slots =
      test.experiment ? test.experiment->scenes[test.trials.place()] : test.slots;
  return slots[static_cast<std::size_t>(slot)];
}

// Both files are on the disk before either gets its name.
Failure write_both(const BlindTest& test, const std::string& base) {
  std::string answers = file::answers_header();
  for (const file::Answer& answer : test.answers) answers += file::answer_line(answer);
  auto trials = file::AtomicFile::create(base + kTrialsEnding);
  if (!trials) return trials.error();
  auto result = file::AtomicFile::create(base + kResultEnding);
  if (!result) return result.error();
  if (Failure failure = trials->write(answers)) return failure;
  if (Failure failure = result->write(compare::result_csv(test.trials, test.results)))
    return failure;
  if (Failure failure = trials->sync()) return failure;
  if (Failure failure = result->sync()) return failure;
  if (Failure failure = trials->commit()) return failure;
  return result->commit();
}

// On the disk before it counts.
Failure keep_answer(BlindTest& test, file::Answer answer) {
  answer.time_utc = file::utc_now();
  if (test.experiment) {
    if (Failure failure = test.experiment->answers.append(answer)) return failure;
  }
  test.answers.push_back(std::move(answer));
  return std::nullopt;
}

}  // namespace

void finish(BlindTest& test) {
  test.running = false;
  test.results = compare::results_of(test.answers, test.trials.plan().confidence);
}

void start_blind_test(const PanelContext& context) {
  UiState& state = context.state;
  CompareState& compare = state.compare;
  const Scene& running = context.session.scene();
  keep_slots(state, running);
  const CompareSlots slots = slots_of(state);
  runtime::SlotScenes scenes{running, running};
  for (const Slot slot : {Slot::kA, Slot::kB}) {
    Scene& scene = scenes[static_cast<std::size_t>(slot)];
    scene.algorithm = slots.of(slot);
    if (const auto problem = validate(scene)) return tell(state, *problem);
  }
  compare::TrialPlan plan;
  plan.seed = compare.transient.seed ? *compare.transient.seed : seed_by_chance();
  plan.trials = compare::equal_trials(compare.persisted.trials, compare.persisted.question,
                                      compare::describe(slots.of(Slot::kA)),
                                      compare::describe(slots.of(Slot::kB)));
  plan.confidence = compare.persisted.confidence;
  Result<BlindTrials> trials = BlindTrials::create(plan);
  if (!trials) return tell(state, trials.error());
  compare.transient.test = BlindTest{std::move(*trials), std::move(scenes), running};
  compare.transient.setting_up = false;
  show_page(state, kBlindTestPage);
}

Failure start_experiment(UiState& state, const Scene& running,
                         std::shared_ptr<runtime::Experiment> experiment) {
  const file::AnswersFile& answers = experiment->answers;
  Result<BlindTrials> trials = BlindTrials::create(
      {answers.identity().seed, experiment->trials, state.compare.persisted.confidence});
  if (!trials) return trials.error();
  if (answers.dropped()) {
    tell(state, MessageKind::kNote,
         answers.path() + ": its last line was torn and is dropped; the trial is repeated");
  }
  BlindTest test{std::move(*trials), {}, running, std::move(experiment), false};
  test.answers.assign(answers.found().begin(), answers.found().end());
  for (std::size_t i = 0; i < test.answers.size(); ++i) test.trials.take();
  if (test.trials.finished()) finish(test);
  state.compare.transient.test = std::move(test);
  show_page(state, kBlindTestPage);
  return std::nullopt;
}

bool waits(const BlindTest& test) { return !test.begun || test.trials.at_break(); }

void go_on(const PanelContext& context) {
  if (!blind_test_runs(context.state)) return;
  BlindTest& test = *context.state.compare.transient.test;
  if (!std::exchange(test.begun, true)) return;
  test.trials.go_on();
}

void feel(const PanelContext& context, Presentation presentation) {
  if (!blind_test_runs(context.state)) return;
  BlindTest& test = *context.state.compare.transient.test;
  if (waits(test)) return;
  const Slot slot = test.trials.present(presentation, ImGui::GetTime());
  if (put_blindly(context, scene_of(test, slot))) test.felt = presentation;
}

void choose(const PanelContext& context, Presentation presentation) {
  if (!blind_test_runs(context.state)) return;
  BlindTest& test = *context.state.compare.transient.test;
  const Result<file::Answer> answer = test.trials.answer(presentation, ImGui::GetTime());
  if (!answer) return tell(context.state, MessageKind::kNote, answer.error().message);
  if (const Failure failure = keep_answer(test, *answer)) return tell(context.state, *failure);
  test.trials.take();
  test.felt.reset();
  if (test.trials.finished()) end_blind_test(context);
}

void end_blind_test(const PanelContext& context) {
  if (!blind_test_runs(context.state)) return;
  BlindTest& test = *context.state.compare.transient.test;
  finish(test);
  // The wall of an experiment stays: somebody may press into it, and the scene's may be stiffer.
  if (!test.experiment) {
    if (const auto problem = ask_for(context, test.before)) tell(context.state, *problem);
  }
  // The contacts of the test are no ghosts.
  begin_comparison(context.state, context.session.scene(), slots_of(context.state));
  show_page(context.state, kBlindTestPage);
}

void save_blind_test(const PanelContext& context) {
  UiState& state = context.state;
  auto& test = state.compare.transient.test;
  if (!test || test->running || test->experiment) return;
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
