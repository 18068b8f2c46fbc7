// Changes of a scene during a session: device, hand, walls, environment, algorithm, estimator,
// skipped ticks and simulator. Rate, jitter, seed, hand path, presence of a hand and start need a
// new session.
#pragma once

#include <optional>

#include "core/scene.h"
#include "device/device.h"

namespace hapticwall::session {

// True if all values that may change in a session are equal.
[[nodiscard]] bool same_parameters(const Scene& a, const Scene& b);

// Reason why `wanted` needs a new session, or nullopt.
[[nodiscard]] std::optional<SceneProblem> needs_new_session(const Scene& running,
                                                            const Scene& wanted);

// The scene on an open device. A real device replaces the resolution, limits the force, and has no
// simulated hand.
[[nodiscard]] Scene scene_on(Scene scene, const device::DeviceInfo& device);

}  // namespace hapticwall::session
