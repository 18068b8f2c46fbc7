// What of a scene may change while a session runs: device, hand, walls, algorithm and simulator.
// The rate, the hand's path and whether there is a hand, and the start need a new session.
#pragma once

#include <optional>

#include "core/scene.h"
#include "device/device.h"

namespace hapticwall::runtime {

// True where nothing differs of what may change in a session.
[[nodiscard]] bool same_parameters(const Scene& a, const Scene& b);

// Why `wanted` cannot follow on `running` without a new session, or nothing.
[[nodiscard]] std::optional<SceneProblem> needs_new_session(const Scene& running,
                                                            const Scene& wanted);

// The scene as it runs on an open device. A real one: its resolution in place of the scene's, its
// force limit where that is the smaller one, and no hand, for a person's own is there.
[[nodiscard]] Scene scene_on(Scene scene, const device::DeviceInfo& device);

}  // namespace hapticwall::runtime
