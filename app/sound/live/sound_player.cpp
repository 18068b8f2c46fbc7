#include "app/sound/live/sound_player.h"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <utility>

#include "app/runtime/loop/realtime_setup.h"

namespace hapticwall::sound {
namespace {

constexpr std::chrono::duration<double> kPeriod{kPumpPeriodS};
constexpr std::chrono::milliseconds kEndWait{200};
// A card that asks for nothing in so many periods is stuck.
constexpr int kStuckPeriods = 1000;

}  // namespace

struct SoundPlayer::Shared {
  explicit Shared(OpenCard open_card) : open(std::move(open_card)) {}

  // With the lock, all of these.
  [[nodiscard]] bool plays() const { return on && !end; }
  void listen(bool wanted) const {
    if (source.feed) source.feed->wanted.store(wanted, std::memory_order_relaxed);
  }
  void take_source(std::optional<SoundPump>& pump, const CardFacts& facts);
  void watch(const std::optional<SoundPump>& pump);
  // Return when the sound is switched off or ends.
  void use_card(std::unique_lock<std::mutex>& lock);
  void pump_ticks(std::unique_lock<std::mutex>& lock, const CardFacts& facts);

  const OpenCard open;
  const std::shared_ptr<SoundRing> ring = std::make_shared<SoundRing>();
  std::mutex mutex;  // of the following; not held while the card is asked for anything
  std::condition_variable changed;
  SoundSource source;
  bool source_is_new = false;
  SoundMix mix;
  bool on = false;
  bool end = false;
  bool ended = false;
  SoundStatus status;
  std::uint64_t calls = 0;  // of the card, at the last look
  int silent_periods = 0;
};

void SoundPlayer::Shared::take_source(std::optional<SoundPump>& pump, const CardFacts& facts) {
  pump.reset();
  source_is_new = false;
  if (!source.feed) return;
  pump.emplace(source, facts, *ring);
  listen(true);
}

void SoundPlayer::Shared::watch(const std::optional<SoundPump>& pump) {
  silent_periods = ring->calls() == calls ? silent_periods + 1 : 0;
  calls = ring->calls();
  status.state = silent_periods < kStuckPeriods ? SoundState::kPlaying : SoundState::kStuck;
  if (pump) status.latency_s = pump->latency_s();
}

void SoundPlayer::Shared::pump_ticks(std::unique_lock<std::mutex>& lock, const CardFacts& facts) {
  std::optional<SoundPump> pump;
  source_is_new = true;
  silent_periods = 0;
  status = {SoundState::kPlaying, facts.name, "", 0.0};
  while (plays()) {
    if (source_is_new) take_source(pump, facts);
    const SoundMix now = mix;
    lock.unlock();
    if (pump) pump->step(now);
    lock.lock();
    watch(pump);
    changed.wait_for(lock, kPeriod, [this] { return !plays() || source_is_new; });
  }
  listen(false);
}

void SoundPlayer::Shared::use_card(std::unique_lock<std::mutex>& lock) {
  status = {SoundState::kOpening, "", "", 0.0};
  lock.unlock();
  Result<std::unique_ptr<Card>> card =
      open([ring = ring](std::span<float> samples) { ring->fill(samples); });
  lock.lock();
  if (!card) {
    status = {SoundState::kNoCard, "", card.error().message, 0.0};
    changed.wait(lock, [this] { return !plays(); });
  } else {
    pump_ticks(lock, (*card)->facts());
    lock.unlock();
    card->reset();
    lock.lock();
  }
  status = {};
}

void SoundPlayer::work(const std::shared_ptr<Shared>& shared) {
  runtime::set_up_recorder_thread();
  std::unique_lock lock(shared->mutex);
  while (!shared->end) {
    shared->changed.wait(lock, [&] { return shared->end || shared->on; });
    if (!shared->end) shared->use_card(lock);
  }
  shared->ended = true;
  shared->changed.notify_all();
}

SoundPlayer::SoundPlayer(OpenCard open_card)
    : shared_(std::make_shared<Shared>(std::move(open_card))) {}

SoundPlayer::~SoundPlayer() {
  if (!thread_.joinable()) return;
  std::unique_lock lock(shared_->mutex);
  shared_->end = true;
  shared_->listen(false);
  shared_->changed.notify_all();
  const bool ended = shared_->changed.wait_for(lock, kEndWait, [this] { return shared_->ended; });
  lock.unlock();
  if (ended) {
    thread_.join();
  } else {
    thread_.detach();
  }
}

void SoundPlayer::play(bool on) {
  const std::scoped_lock lock(shared_->mutex);
  if (on == shared_->on) return;
  shared_->on = on;
  shared_->changed.notify_all();
  if (!thread_.joinable()) thread_ = std::thread(work, shared_);
}

void SoundPlayer::mix(const SoundMix& mix) {
  const std::scoped_lock lock(shared_->mutex);
  shared_->mix = mix;
}

void SoundPlayer::follow(const SoundSource& source) {
  const std::scoped_lock lock(shared_->mutex);
  if (source.feed == shared_->source.feed) return;
  shared_->listen(false);
  shared_->source = source;
  shared_->source_is_new = true;
  shared_->changed.notify_all();
}

SoundStatus SoundPlayer::status() const {
  const std::scoped_lock lock(shared_->mutex);
  return shared_->status;
}

}  // namespace hapticwall::sound
