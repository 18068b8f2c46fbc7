// The other wall of the first window: the same hand under the algorithm of the slot that is not in
// force, computed beside the session (app/session/counterpart.h), with what its card shows.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "app/draw/plot/sample_history.h"
#include "app/draw/verdict/tail.h"
#include "app/session/counterpart.h"
#include "app/session/sample_source.h"
#include "core/algorithm_settings.h"
#include "core/sample.h"
#include "core/scene.h"
#include "core/study/energy_story.h"

namespace hapticwall::ui {

class OtherWall {
 public:
  // A minute at 1 kHz; the plots of the first window show less.
  static constexpr std::size_t kHistoryTicks = 60'000;

  // True for a session with a counterpart: simulated, with one axis.
  [[nodiscard]] static bool exists_for(const session::SampleSource& session);

  // All ticks of the session, in order. `generation`: of the session's scene. `other`: the
  // algorithm to compute. Costs about as much as a headless tick for each one.
  void follow(const session::SampleSource& session, std::uint32_t generation,
              const AlgorithmSettings& other, std::span<const Tick> ticks);
  // Another session begins.
  void forget();
  // Brings the verdict up to date: of the newest second. Costs nothing without a new sample.
  void judge();

  // False before the first tick, and without a counterpart.
  [[nodiscard]] bool seen() const { return run_ && !history_.empty(); }
  // Of the counterpart, with its algorithm. Precondition of all from here: seen().
  [[nodiscard]] const Scene& scene() const { return run_->scene(); }
  [[nodiscard]] const draw::SampleHistory& history() const { return history_; }
  [[nodiscard]] Sample newest() const { return history_.sample(history_.size() - 1); }
  // `diverged` from the tick on at which the run ended.
  [[nodiscard]] draw::Tail tail() const;
  [[nodiscard]] const EnergyStory& story() const { return lamp_->story(); }

 private:
  void take(const Sample& of_session, const Scene& wanted);
  void begin(const Scene& wanted, const Sample& first);

  std::optional<session::Counterpart> run_;
  std::optional<EnergyLamp> lamp_;
  draw::SampleHistory history_{kHistoryTicks};
  draw::Tail tail_;
  std::uint64_t next_tick_ = 0;  // of the session
  std::uint32_t generation_ = 0;
  AlgorithmSettings other_;
  std::uint32_t changes_ = 0;  // of the scene, as generation of the counterpart's samples
  bool diverged_ = false;
};

}  // namespace hapticwall::ui
