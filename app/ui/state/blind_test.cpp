#include "app/ui/state/blind_test.h"

#include <fmt/format.h>

#include <filesystem>
#include <utility>

#include "app/file/disk/atomic_file.h"
#include "app/file/text/text.h"
#include "app/ui/state/changes.h"
#include "app/ui/state/compare_state.h"
#include "app/ui/state/comparing.h"
#include "app/ui/state/dock_state.h"
#include "app/ui/state/export.h"
#include "app/ui/state/recording_wishes.h"
#include "core/algorithm/algorithm.h"
#include "core/text.h"

namespace hapticwall::ui {
namespace {

using compare::BlindTrials;
using compare::Presentation;
using compare::Slot;

// The outcome of the switch must not reveal the slot.
bool put_blindly(const PanelContext& context, const Scene& scene) {
  if (!ask_for(context, scene)) return true;
  end_blind_test(context);
  context.toasts.tell(MessageKind::kProblem,
                      "the blind test ended: the session has refused one of the two walls");
  return false;
}

const Scene& scene_of(const BlindTest& test, Slot slot) {
  return test.experiment->scenes[test.trials.place()][static_cast<std::size_t>(slot)];
}

// "algorithm=NAME; algorithm.KEY=VALUE", as a trial list has it.
std::string slot_text(const AlgorithmSettings& settings) {
  std::string text = fmt::format("algorithm={}", algorithms()[settings.index].name);
  const auto parameters = algorithm_parameters();
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (!settings.values.at(i) || !reads(settings, parameters[i].key)) continue;
    text += fmt::format("; algorithm.{}={}", parameters[i].key,
                        value_text(parameters[i], *settings.values.at(i)));
  }
  return text;
}

std::string recording_of(const PanelContext& context) {
  if (context.shows.live == nullptr) return "";
  const session::RecordingStatus status = context.shows.live->recording_status();
  if (status.state != session::RecordingState::kRecording) return "";
  return std::filesystem::path(status.path).filename().string();
}

// An event of the stream. It tells the slot: the stream goes to another program.
void add_event(const PanelContext& context, const char* what, const BlindTest& test,
               Presentation presentation, Slot slot) {
  if (context.shows.live == nullptr) return;
  context.shows.live->add_event(
      "trial", fmt::format(",\"trial\":{},\"what\":\"{}\",\"presentation\":{},\"wall\":\"{}\"",
                           test.trials.spec().number, what,
                           presentation == Presentation::kFirst ? 1 : 2, compare::slot_name(slot)));
}

// Keeps the answer on the disk before it counts.
Failure keep_answer(const PanelContext& context, BlindTest& test, file::Answer answer) {
  session::Experiment& experiment = *test.experiment;
  answer.time_utc = file::utc_now();
  answer.values = session::values_at(experiment, test.trials.place());
  answer.exposure = test.exposure.row();
  answer.exposure.recording = recording_of(context);
  if (Failure failure = experiment.answers.append(answer)) return failure;
  if (experiment.feed) experiment.feed->answered(experiment, answer);
  test.answers.push_back(std::move(answer));
  return std::nullopt;
}

// Asks for the next trial, once: the trial before has just ended, or its break.
void ask_for_trial(const BlindTest& test) {
  if (test.trials.awaits()) test.experiment->feed->ask(*test.experiment);
}

Result<BlindTrials> trials_of(const session::Experiment& experiment, double confidence) {
  const std::uint64_t seed = experiment.answers.identity().seed;
  if (!experiment.feed) return BlindTrials::create({seed, experiment.trials, confidence});
  BlindTrials trials = BlindTrials::begin_open(seed, confidence);
  for (const file::TrialSpec& trial : experiment.trials) trials.add(trial);
  return trials;
}

}  // namespace

void finish(BlindTest& test) {
  test.running = false;
  test.results = compare::results_of(test.answers, test.trials.plan().confidence);
  if (test.experiment->feed)
    test.experiment->feed->end(test.trials.finished() ? "finished" : "stopped");
}

void write_trial_list(const PanelContext& context) {
  CompareState& compare = context.compare;
  const Scene& scene = context.session.scene();
  keep_slots(compare, scene);
  const CompareSlots slots = slots_of(compare);
  const CompareState::Persisted& wanted = compare.persisted;
  const std::string trial =
      fmt::format("{},{},{}\n", csv_field(slot_text(slots.of(Slot::kA))),
                  csv_field(slot_text(slots.of(Slot::kB))), csv_field(wanted.question));
  std::string list = "a,b,question\n";
  for (std::size_t i = 0; i < wanted.trials; ++i) list += trial;
  const std::string path =
      unused_path(context.recording.folder, plain_file_name(scene.name + "-blind-test"), ".csv");
  if (const Failure failure = file::write_file(path, list)) return tell(context.toasts, *failure);
  context.toasts.tell(
      MessageKind::kNote,
      fmt::format("wrote {0}; 'hapticwall {1} --trials {0} --participant P01' runs it", path,
                  scene.name));
}

Failure start_experiment(CompareState& compare, DockState& dock, Toasts& toasts,
                         const Scene& running, std::shared_ptr<session::Experiment> experiment) {
  const file::AnswersFile& answers = experiment->answers;
  Result<BlindTrials> trials = trials_of(*experiment, compare.persisted.confidence);
  if (!trials) return trials.error();
  if (answers.dropped()) {
    toasts.tell(MessageKind::kNote,
                answers.path() + ": its last line was torn and is dropped; the trial is repeated");
  }
  BlindTest test{std::move(*trials), running, std::move(experiment)};
  test.answers.assign(answers.found().begin(), answers.found().end());
  for (std::size_t i = 0; i < test.answers.size(); ++i) test.trials.take();
  if (test.trials.finished()) finish(test);
  compare.transient.test = std::move(test);
  show_page(dock, kBlindTestPage);
  return std::nullopt;
}

bool awaits_trial(const CompareState& compare) {
  return blind_test_runs(compare) && compare.transient.test->trials.awaits();
}

void heed_feed(const PanelContext& context) {
  if (!awaits_trial(context.compare)) return;
  BlindTest& test = *context.compare.transient.test;
  switch (test.experiment->feed->take(*test.experiment)) {
    case session::FeedEvent::kTrial:
      test.trials.add(test.experiment->trials.back());
      return;
    case session::FeedEvent::kEnd:
      test.trials.close();
      if (test.trials.finished()) end_blind_test(context);
      return;
    case session::FeedEvent::kLeft:
      test.feed_left = true;
      return;
    case session::FeedEvent::kChoice:
    case session::FeedEvent::kNothing:
      return;
  }
}

bool waits(const BlindTest& test) { return !test.begun || test.trials.at_break(); }

void go_on(const PanelContext& context) {
  if (!blind_test_runs(context.compare)) return;
  BlindTest& test = *context.compare.transient.test;
  if (!std::exchange(test.begun, true) || !test.trials.at_break()) return;
  test.trials.go_on();
  ask_for_trial(test);
}

void feel(const PanelContext& context, Presentation presentation) {
  if (!blind_test_runs(context.compare)) return;
  BlindTest& test = *context.compare.transient.test;
  if (waits(test) || test.trials.awaits()) return;
  if (!test.felt) test.exposure.begin();
  const Slot slot = test.trials.present(presentation, ImGui::GetTime());
  add_event(context, "felt", test, presentation, slot);
  if (put_blindly(context, scene_of(test, slot))) test.felt = presentation;
}

void choose(const PanelContext& context, Presentation presentation) {
  if (!blind_test_runs(context.compare)) return;
  BlindTest& test = *context.compare.transient.test;
  const Result<file::Answer> answer = test.trials.answer(presentation, ImGui::GetTime());
  if (!answer) return context.toasts.tell(MessageKind::kNote, answer.error().message);
  if (const Failure failure = keep_answer(context, test, *answer))
    return tell(context.toasts, *failure);
  add_event(context, "answered", test, presentation, answer->chosen);
  test.trials.take();
  test.felt.reset();
  ask_for_trial(test);
  if (test.trials.finished()) end_blind_test(context);
}

void end_blind_test(const PanelContext& context) {
  if (!blind_test_runs(context.compare)) return;
  BlindTest& test = *context.compare.transient.test;
  finish(test);
  // The wall stays: somebody may press into it, and the scene's may be stiffer.
  // The contacts of the test are no ghosts.
  begin_comparison(context.compare, context.plots, context.toasts, context.session.scene(),
                   slots_of(context.compare));
  show_page(context.dock, kBlindTestPage);
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
