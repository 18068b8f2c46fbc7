#include "app/ui/computed/other_wall.h"

namespace hapticwall::ui {

bool OtherWall::exists_for(const session::SampleSource& session) {
  return session.device_info().is_simulated && !session.scene().two_axes();
}

void OtherWall::forget() {
  run_.reset();
  history_.clear();
  tail_ = {};
}

void OtherWall::begin(const Scene& wanted, const Sample& first) {
  forget();
  run_.emplace(wanted, first);
  const double encoder_m = wanted.x().device.encoder_m.value_or(0.0);
  lamp_.emplace(wanted.sampling.rate_hz, encoder_m);
  history_.set_count(wanted.x().device.encoder_m);
  diverged_ = false;
}

void OtherWall::take(const Sample& of_session, const Scene& wanted) {
  const bool begins = !run_ || of_session.tick < next_tick_;
  next_tick_ = of_session.tick + 1;
  if (begins) begin(wanted, of_session);
  if (diverged_) return;
  const Sample* computed = run_->follow(of_session);
  diverged_ = computed == nullptr;
  if (diverged_) return;
  Sample sample = *computed;
  sample.generation = changes_;  // the lamp's story begins anew with it
  history_.push(sample);
  lamp_->add(sample);
}

void OtherWall::follow(const session::SampleSource& session, std::uint32_t generation,
                       const AlgorithmSettings& other, std::span<const Tick> ticks) {
  if (!exists_for(session)) return forget();
  Scene wanted = session.scene();
  wanted.algorithm = other;
  for (const Tick& tick : ticks) {
    // The scene of an older generation is gone; its changes come into force with the newest one.
    const bool newest = tick.x().generation == generation;
    if (run_ && newest && (generation != generation_ || other != other_)) {
      run_->change(wanted);
      ++changes_;
      generation_ = generation;
      other_ = other;
    }
    if (!run_) {
      generation_ = generation;
      other_ = other;
    }
    take(tick.x(), wanted);
  }
}

void OtherWall::judge() {
  if (!seen()) return;
  const auto end = history_.value(&Sample::tick, history_.size() - 1);
  if (static_cast<std::uint64_t>(end) + 1 == tail_.end_tick) return;
  tail_ = draw::tail_of(history_, scene(), history_.size(), true);
}

draw::Tail OtherWall::tail() const {
  draw::Tail tail = tail_;
  if (diverged_) tail.summary.verdict = Verdict::kDiverged;  // and there is no newer sample
  return tail;
}

}  // namespace hapticwall::ui
