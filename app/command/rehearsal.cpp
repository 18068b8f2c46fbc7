#include "app/command/rehearsal.h"

#include <chrono>
#include <stdexcept>
#include <utility>

#include "app/command/signals.h"
#include "app/compare/blind_trials.h"
#include "app/compare/exposure.h"
#include "app/file/text/text.h"
#include "core/run/simulate.h"

namespace hapticwall::command {
namespace {

using compare::BlindTrials;
using compare::Presentation;
using compare::Slot;
using session::FeedEvent;

class Rehearsal {
 public:
  explicit Rehearsal(session::Experiment& experiment)
      : experiment_(experiment),
        trials_(BlindTrials::begin_open(experiment.answers.identity().seed,
                                        compare::TrialPlan{}.confidence)) {
    for (const file::TrialSpec& trial : experiment.trials) trials_.add(trial);
    for (std::size_t i = 0; i < experiment.answers.found().size(); ++i) trials_.take();
  }

  Result<int> run() {
    while (!trials_.finished() && stop_signal() == 0) {
      if (trials_.at_break()) {
        trials_.go_on();
        ask();
      } else if (!trials_.awaits() && !asked_) {
        present();
      } else if (const Failure failure = take()) {
        return *failure;
      }
    }
    experiment_.feed->end(trials_.finished() ? "finished" : "stopped");
    return stop_signal() == 0 ? 0 : status_of_signal(stop_signal());
  }

 private:
  void ask() {
    if (trials_.awaits()) experiment_.feed->ask(experiment_);
  }

  // The hand of the scene presses into both walls; the observer is asked.
  void present() {
    const session::SlotScenes& scenes = experiment_.scenes[trials_.place()];
    exposure_.begin();
    file::FeltTrial felt;
    felt.number = trials_.spec().number;
    now_s_ = 0.0;
    for (const Presentation presentation : {Presentation::kFirst, Presentation::kSecond}) {
      const Slot slot = trials_.present(presentation, now_s_);
      if (presentation == Presentation::kFirst) felt.first = slot;
      const Scene& scene = scenes.at(static_cast<std::size_t>(slot));
      felt.exposures.at(static_cast<std::size_t>(presentation)) = press(scene);
      now_s_ += scene.duration_s;
    }
    felt.keys = experiment_.answers.columns()->keys;
    felt.values = session::values_at(experiment_, trials_.place());
    asked_ = true;
    experiment_.feed->ask_to_choose(file::felt_line(felt));
  }

  file::ExposureRow press(const Scene& scene) {
    compare::Exposure alone;
    AxesOptions options;
    options.on_tick = [&](const Tick& tick) {
      alone.add(tick, scene.sampling.period_s());
      exposure_.add(tick, scene.sampling.period_s());
    };
    options.should_stop = [] { return stop_signal() != 0; };
    static_cast<void>(simulate_axes(scene, options));
    return alone.row();
  }

  Failure take() {
    switch (experiment_.feed->take(experiment_)) {
      case FeedEvent::kTrial:
        trials_.add(experiment_.trials.back());
        return std::nullopt;
      case FeedEvent::kEnd:
        trials_.close();
        return std::nullopt;
      case FeedEvent::kChoice:
        return choose();
      case FeedEvent::kNothing:
        experiment_.feed->wait(std::chrono::milliseconds{50});
        return std::nullopt;
      case FeedEvent::kLeft:
        break;
    }
    return file_error(
        "--trials -: the other program has ended before {\"end\": true}; the same command resumes");
  }

  Failure choose() {
    const bool first = experiment_.feed->choice().first;
    Result<file::Answer> answer =
        trials_.answer(first ? Presentation::kFirst : Presentation::kSecond, now_s_);
    if (!answer) return answer.error();
    answer->time_utc = file::utc_now();
    answer->values = session::values_at(experiment_, trials_.place());
    answer->exposure = exposure_.row();
    // Each of the two runs counts its own ticks, and neither is recorded.
    answer->exposure.first_tick.reset();
    answer->exposure.last_tick.reset();
    if (Failure failure = experiment_.answers.append(*answer)) return failure;
    experiment_.feed->answered(experiment_, *answer);
    trials_.take();
    asked_ = false;
    ask();
    return std::nullopt;
  }

  session::Experiment& experiment_;
  BlindTrials trials_;
  compare::Exposure exposure_;
  double now_s_ = 0.0;
  bool asked_ = false;  // the observer has felt this trial
};

}  // namespace

Result<int> rehearse(session::Experiment& experiment) {
  catch_stop_signals();
  try {
    return Rehearsal(experiment).run();
  } catch (const std::invalid_argument& wrong) {  // a hand that follows the pointer
    return usage_error(std::string("--rehearse: ") + wrong.what());
  } catch (const SimulationRefused& refused) {
    return usage_error(std::string("--rehearse: ") + refused.what());
  }
}

}  // namespace hapticwall::command
