// Loop, pump and card on three clocks of the test.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "app/sound/live/sound_pump.h"

namespace hapticwall::sound::test {

inline CardFacts fake_card() { return {"fake", 48000.0, 128, 2.0 * 128.0 / 48000.0}; }

struct CardRig {
  explicit CardRig(double loop_hz = 1000.0, const CardFacts& card_facts = fake_card())
      : rate_hz(loop_hz),
        card(card_facts),
        taker({feed, loop_hz, true}),
        pump({feed, loop_hz, true}, card, ring) {}

  // `velocity(tick)`: of the handle. `loop_error`: how much faster the loop's clock is.
  void run(double until_s, const std::function<double(std::uint64_t)>& velocity) {
    while (now_s() < until_s) {
      if (tick_s <= pump_s && tick_s <= call_s) {
        push_tick(velocity);
      } else if (pump_s <= call_s) {
        step();
        pump_s += kPumpPeriodS;
      } else {
        call();
      }
    }
  }
  [[nodiscard]] double now_s() const { return std::min({tick_s, pump_s, call_s}); }

  void step() { pump.step(taker.take(), mix); }

  void push_tick(const std::function<double(std::uint64_t)>& velocity) {
    Tick tick;
    tick.axes[0].tick = ticks;
    tick.axes[0].truth.velocity_m_per_s = velocity(ticks);
    if (!feed->ticks.try_push(tick)) ++lost;
    ++ticks;
    tick_s += 1.0 / (rate_hz * (1.0 + loop_error));
  }

  void call() {
    std::vector<float> samples(card.period_frames);
    if (!card_sleeps) {
      const bool played = ring.playing();
      ring.fill(samples);
      if (played && !ring.playing()) ++gaps;
      for (std::size_t i = 0; i < samples.size(); ++i) {
        heard.push_back(samples[i]);
        heard_at_s.push_back(call_s + card.latency_s + static_cast<double>(i) / card.rate_hz);
      }
    }
    call_s += static_cast<double>(card.period_frames) / card.rate_hz;
  }

  double rate_hz;
  CardFacts card;
  std::shared_ptr<session::SoundFeed> feed = std::make_shared<session::SoundFeed>(2048);
  SoundRing ring;
  TickTaker taker;
  SoundPump pump;
  SoundMix mix{1.0, false};
  double loop_error = 0.0;
  bool card_sleeps = false;

  std::uint64_t ticks = 0;
  double tick_s = 0.0;  // time of the next tick
  double pump_s = 0.0003;
  double call_s = 0.0007;
  int lost = 0;
  int gaps = 0;
  std::vector<float> heard;
  std::vector<double> heard_at_s;
};

}  // namespace hapticwall::sound::test
