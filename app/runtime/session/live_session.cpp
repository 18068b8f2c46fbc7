#include "app/runtime/session.h"

#include <exception>
#include <utility>

#include "app/runtime/live_session.h"
#include "app/runtime/realtime_setup.h"
#include "app/runtime/scene_change.h"
#include "device/simulated_device.h"

namespace hapticwall::runtime {
namespace {

// The simulator of the second axis; null where the scene has one axis.
std::unique_ptr<device::Device> second_device(const Scene& scene) {
  if (!scene.y) return nullptr;
  return std::make_unique<device::SimulatedDevice>(second_axis(scene));
}

}  // namespace

Result<std::unique_ptr<Session>> Session::start(const Scene& scene, const SessionOptions& options) {
  // Before the plant is built: it relies on a valid scene.
  if (const std::optional<SceneProblem> problem = validate(scene)) {
    return Error{ErrorKind::kUsage, problem->key + ": " + problem->message};
  }
  return start_on(std::make_unique<device::SimulatedDevice>(scene), scene, options);
}

Result<std::unique_ptr<Session>> Session::start_on(std::unique_ptr<device::Device> device,
                                                   const Scene& scene,
                                                   const SessionOptions& options) {
  if (const std::optional<SceneProblem> problem = validate(scene)) {
    return Error{ErrorKind::kUsage, problem->key + ": " + problem->message};
  }
  if (scene.y && !device->info().is_simulated) {
    return Error{ErrorKind::kUsage,
                 "the scene has a second axis, which sessions on a device do not drive yet; "
                 "the simulator does"};
  }
  if (Failure failure = device->open()) return *std::move(failure);
  const Scene scene_here = scene_on(scene, device->info());
  if (const std::optional<SceneProblem> problem = validate(scene_here)) {
    return Error{ErrorKind::kDevice,
                 device->info().name + ": " + problem->key + ": " + problem->message};
  }
  try {
    auto session = std::make_unique<LiveSession>(std::move(device), second_device(scene_here),
                                                 scene_here, options);
    if (Failure refused = refuse_without_realtime(
            session->device_info(), session->realtime_status(), options.allow_no_realtime)) {
      return *std::move(refused);
    }
    return std::unique_ptr<Session>(std::move(session));
  } catch (const std::exception& problem) {  // no memory for the queues, no thread to be had
    return Error{ErrorKind::kDevice, std::string("the loop did not start: ") + problem.what()};
  }
}

}  // namespace hapticwall::runtime
