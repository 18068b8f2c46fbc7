// A scene that Python drives, a tick at a time.
#pragma once

#include <nanobind/nanobind.h>

#include <cstddef>
#include <cstdint>
#include <optional>

#include "app/python/interruptible.h"
#include "app/python/scene.h"
#include "core/run/measured_axes.h"
#include "core/summary.h"

namespace hapticwall::python {

// The same ticks as a run. Laws keep their functions while it exists.
class SessionBox {
 public:
  // Raises ValueError for a scene that no run takes.
  explicit SessionBox(const SceneBox& scene);

  // One tick under forces of the hand on the handle, newtons, held through the tick. Returns the
  // sample of axis x, which the next step overwrites. Raises ValueError for a force that is not
  // finite or of an axis that is not there, RuntimeError after the end of a run that diverged.
  const Sample& step(double hand_force_n, double hand_force_y_n);
  // Changes numbers or settings of the scene from the next tick on. Raises ValueError, KeyError.
  void set(const Settings& settings);

  // Laws may change again; there is no further step.
  void close() { mark_.reset(); }

  // The next tick, and the position that its controller will read. `axis` is checked.
  [[nodiscard]] std::uint64_t tick() const { return axes().tick(); }
  [[nodiscard]] double time_s() const;
  [[nodiscard]] double position_m(std::size_t axis) const;
  [[nodiscard]] const Sample& sample(std::size_t axis) const;
  [[nodiscard]] bool diverged() const { return axes().diverged(); }
  [[nodiscard]] const SceneBox& scene() const { return scene_; }
  // Of the ticks so far, as a run that ends here.
  [[nodiscard]] RunSummary summary() const;

 private:
  [[nodiscard]] const MeasuredAxes& axes() const { return *axes_; }
  [[nodiscard]] std::size_t checked(std::size_t axis) const;
  [[noreturn]] void refuse_tick() const;

  std::optional<RunningMark> mark_;  // until close()
  SceneBox scene_;
  std::optional<MeasuredAxes> axes_;  // never empty once built
};

void bind_session(nanobind::module_& m);

}  // namespace hapticwall::python
