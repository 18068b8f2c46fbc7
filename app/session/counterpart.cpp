#include "app/session/counterpart.h"

namespace hapticwall::session {

Counterpart::Counterpart(const Scene& scene, const Sample& first)
    : axis_(scene), hand_(scene, first.tick, {first.truth.hand_path_m}), last_(first) {}

const Sample* Counterpart::follow(const Sample& of_session) {
  const double from_m = last_.truth.hand_path_m;
  const auto ticks = static_cast<double>(of_session.tick - last_.tick);
  for (std::uint64_t tick = last_.tick + 1; tick <= of_session.tick; ++tick) {
    const double share = static_cast<double>(tick - last_.tick) / ticks;
    hand_.append(tick == of_session.tick
                     ? of_session.truth.hand_path_m
                     : from_m + share * (of_session.truth.hand_path_m - from_m));
  }
  last_ = of_session;
  const Sample* sample = nullptr;
  while (!computed_ || axis_.tick() < of_session.tick) {
    if (computed_) {
      hand_.lead(axis_.plant());
      axis_.advance();
    }
    sample = axis_.compute();
    computed_ = true;
    if (sample == nullptr) return nullptr;
  }
  return sample;
}

}  // namespace hapticwall::session
