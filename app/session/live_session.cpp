#include "app/session/live_session.h"

#include <exception>
#include <utility>
#include <vector>

#include "app/session/loop/realtime_setup.h"
#include "app/session/loop_session.h"
#include "app/session/scene_change.h"
#include "device/simulated_device.h"

namespace hapticwall::session {
namespace {

// The device of axis x, and simulators for the other axes.
std::vector<std::unique_ptr<device::Device>> devices_of(const Scene& scene,
                                                        std::unique_ptr<device::Device> of_x) {
  std::vector<std::unique_ptr<device::Device>> devices;
  devices.push_back(std::move(of_x));
  for (std::size_t i = 1; i < scene.axes.size(); ++i) {
    devices.push_back(std::make_unique<device::SimulatedDevice>(axis_scene(scene, i)));
  }
  return devices;
}

Failure check(const Scene& scene, ErrorKind kind, const std::string& whose) {
  const std::optional<SceneProblem> problem = validate(scene);
  if (!problem) return std::nullopt;
  return Error{kind, whose + problem->key + ": " + problem->message};
}

}  // namespace

Result<std::unique_ptr<LiveSession>> start_under(BorrowedAlgorithm* borrowed,
                                                 std::unique_ptr<device::Device> device,
                                                 const Scene& scene,
                                                 const SessionOptions& options) {
  // The check comes before the plant is built, which relies on a valid scene.
  if (Failure failure = check(scene, ErrorKind::kUsage, "")) return *std::move(failure);
  if (!device) device = std::make_unique<device::SimulatedDevice>(scene);
  if (scene.two_axes() && !device->info().is_simulated) {
    return Error{ErrorKind::kUsage,
                 "the scene has a second axis, which sessions on a device do not drive yet; "
                 "the simulator does"};
  }
  if (options.driver == Driver::kTurnedByOwner && !device->info().is_simulated) {
    return Error{ErrorKind::kUsage,
                 "a session on a device has its own thread: a hand must not wait for its owner"};
  }
  if (Failure failure = device->open()) return *std::move(failure);
  const Scene scene_here = scene_on(scene, device->info());
  if (Failure failure = check(scene_here, ErrorKind::kDevice, device->info().name + ": "))
    return *std::move(failure);
  try {
    auto session = std::make_unique<LoopSession>(devices_of(scene_here, std::move(device)),
                                                 scene_here, options, borrowed);
    if (Failure refused = refuse_without_realtime(
            session->device_info(), session->realtime_status(), options.allow_no_realtime)) {
      return *std::move(refused);
    }
    return std::unique_ptr<LiveSession>(std::move(session));
  } catch (const std::exception& problem) {  // no memory for the queues, no thread to be had
    return Error{ErrorKind::kDevice, std::string("the loop did not start: ") + problem.what()};
  }
}

Result<std::unique_ptr<LiveSession>> LiveSession::start(const Scene& scene,
                                                        const SessionOptions& options) {
  return start_under(nullptr, nullptr, scene, options);
}

Result<std::unique_ptr<LiveSession>> LiveSession::start_on(std::unique_ptr<device::Device> device,
                                                           const Scene& scene,
                                                           const SessionOptions& options) {
  return start_under(nullptr, std::move(device), scene, options);
}

std::optional<SceneProblem> LiveSession::set_algorithm(const AlgorithmSettings& algorithm) {
  Scene changed = scene();
  changed.algorithm = algorithm;
  return change_scene(changed);
}

std::optional<SceneProblem> LiveSession::set_walls(std::span<const WallSettings> walls) {
  Scene changed = scene();
  changed.x().walls.assign(walls.begin(), walls.end());
  return change_scene(changed);
}

}  // namespace hapticwall::session
