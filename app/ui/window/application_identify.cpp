// The session of an identification replaces the user's, because only one session can hold the
// device.
#include <string>
#include <utility>

#include "app/file/text/text.h"
#include "app/ui/panel/identify_state.h"
#include "app/ui/window/application.h"

namespace hapticwall::ui {
namespace {

constexpr std::size_t kCurveColumns = 600;  // every frame draws them

// Takes some tenths of a second to some seconds.
Result<Identified> fitted(const identify::Record& record, const identify::ExperimentFacts& facts,
                          table::IdentifiedBy by, const file::DeviceDescription& device) {
  auto found = identify::identify(record, facts);
  if (!found) return device_error(std::string(session::kTooFewStrokes));
  Identified result{std::move(by), std::move(*found), {}, {}};
  result.device = table::identified_device(device, result.by, result.found);
  result.panels = draw::identification_panels(record, result.found);
  for (draw::FigurePanel& panel : result.panels) {
    for (draw::FigureCurve& curve : panel.curves)
      curve = draw::thinned(std::move(curve), kCurveColumns);
  }
  return result;
}

}  // namespace

void Application::heed_identify(const session::Snapshot& snapshot) {
  take_identified();
  IdentifyState& identify = state_.identify;
  if (std::exchange(identify.wanted, false) && !identify.experiment) return begin_identify();
  if (!identify.experiment) return;
  if (std::string why = interruption(snapshot); !why.empty())
    identify.experiment->stop(std::move(why));
  if (identify.experiment->look(snapshot)) end_identify(snapshot);
}

// Event that invalidates the experiment's record; empty if there is none.
std::string Application::interruption(const session::Snapshot& snapshot) const {
  if (state_.scene.wanted || live_->generation() != before_identify_.generation)
    return "the scene was changed";
  if (state_.replay.opening.running() || !state_.scene.wanted_recording.empty())
    return "a recording is opened";
  if (snapshot.link.trouble == device::Trouble::kNone) return "";
  const std::string details = live_->device_trouble();
  return details.empty() ? std::string(device::trouble_text(snapshot.link.trouble)) : details;
}

void Application::begin_identify() {
  IdentifyState& identify = state_.identify;
  const Scene scene = live_->scene();
  const device::DeviceInfo info = live_->device_info();
  const auto settings = session::experiment_settings(identify.choice, session::info_on(info, scene),
                                                     scene.sampling.rate_hz);
  if (!settings) return tell(state_.toasts, settings.error());
  before_identify_ = {scene, state_.scene.repeats, live_->snapshot().paused, 0};
  auto experiment = std::make_shared<session::IdentifyExperiment>(*settings);
  const std::shared_ptr<BorrowedAlgorithm> borrowed(experiment, &experiment->algorithm());
  if (!start_anew(session::identify_scene(scene, *settings), borrowed)) return;
  forget_session();
  before_identify_.generation = live_->generation();
  if (live_->device_info().is_simulated != info.is_simulated)
    experiment->stop("the device did not start again");
  identify.problem.clear();
  identify.result.reset();
  identify.experiment = std::move(experiment);
}

// Zero force first, then the session of before.
void Application::end_identify(const session::Snapshot& snapshot) {
  live_->arm(false);
  take_ticks();
  IdentifyState& identify = state_.identify;
  const auto experiment = std::exchange(identify.experiment, nullptr);
  const device::DeviceInfo info = session::info_on(live_->device_info(), before_identify_.scene);
  if (const Failure trouble = experiment->trouble()) {
    identify.problem = trouble->message;
  } else {
    identify.fit.start(
        [record = experiment->record(), facts = experiment->facts(),
         by = table::IdentifiedBy{info.name, file::utc_now(), experiment->settings().force_limit_n,
                                  experiment->settings().duration_s, experiment->facts().turns,
                                  snapshot.timing.missed_ticks},
         device = session::identified_description(identify.description, identify.device, info,
                                                  live_->scene())](const auto& /*progress*/) {
          return fitted(record, facts, by, device);
        });
  }
  if (!start_anew(before_identify_.scene)) return;
  forget_session();
  state_.scene.repeats = before_identify_.repeats;
  live_->pause(before_identify_.paused);
}

void Application::take_identified() {
  IdentifyState& identify = state_.identify;
  auto result = identify.fit.take();
  if (!result) return;
  if (*result) {
    identify.result = std::move(**result);
  } else {
    identify.problem = result->error().message;
  }
}

}  // namespace hapticwall::ui
