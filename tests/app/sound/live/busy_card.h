// A sound card that asks for a millisecond about every millisecond.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

#include "app/sound/live/card.h"

namespace hapticwall::sound::test {

struct Heard {
  std::atomic<int> samples{0};  // that were not silent
  std::atomic<float> loudest{0.0F};
};

class BusyCard final : public Card {
 public:
  BusyCard(FillSound fill, std::shared_ptr<Heard> heard)
      : thread_([this, fill = std::move(fill), heard = std::move(heard)] {
          std::vector<float> samples(48);
          while (!end_) {
            fill(samples);
            for (const float sample : samples) note(*heard, std::abs(sample));
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
          }
        }) {}
  ~BusyCard() override {
    end_ = true;
    thread_.join();
  }
  BusyCard(const BusyCard&) = delete;
  BusyCard& operator=(const BusyCard&) = delete;
  [[nodiscard]] CardFacts facts() const override { return {"busy", 48000.0, 48, 0.001}; }

 private:
  static void note(Heard& heard, float size) {
    heard.samples += size > 0.0F ? 1 : 0;
    heard.loudest = std::max(heard.loudest.load(), size);
  }

  std::atomic<bool> end_{false};
  std::thread thread_;
};

inline OpenCard busy_card(const std::shared_ptr<Heard>& heard) {
  return [heard](const FillSound& fill) -> Result<std::unique_ptr<Card>> {
    return std::unique_ptr<Card>(std::make_unique<BusyCard>(fill, heard));
  };
}
inline Result<std::unique_ptr<Card>> no_card(const FillSound& /*fill*/) {
  return Error{ErrorKind::kDevice, "no sound card"};
}

}  // namespace hapticwall::sound::test
