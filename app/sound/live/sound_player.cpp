#include "app/sound/live/sound_player.h"

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "app/session/loop/realtime_setup.h"

namespace hapticwall::sound {
namespace {

constexpr std::chrono::duration<double> kPeriod{kPumpPeriodS};
constexpr std::chrono::milliseconds kEndWait{200};
// A card that requests nothing for this many periods is stuck.
constexpr int kStuckPeriods = 1000;

// The card, and the way of the ticks to it. Its functions may wait for the card.
class Output {
 public:
  explicit Output(std::shared_ptr<SoundRing> ring) : ring_(std::move(ring)) {}

  // Call follow() again after open() and after close().
  [[nodiscard]] Failure open(const OpenCard& open) {
    Result<std::unique_ptr<Card>> card =
        open([ring = ring_](std::span<float> samples) { ring->fill(samples); });
    if (!card) return card.error();
    card_ = std::move(*card);
    return std::nullopt;
  }
  void close() {
    pump_.reset();
    card_.reset();
  }
  // Drops the ticks that wait in the feed.
  void follow(const SoundSource& source) {
    taker_.reset();
    pump_.reset();
    if (!source.feed || !card_) return;
    taker_.emplace(source);
    pump_.emplace(source, card_->facts(), *ring_);
  }
  // Moves all ticks.
  void step(const SoundMix& mix) {
    if (pump_) pump_->step(taker_->take(), mix);
  }

  [[nodiscard]] const Card* card() const { return card_.get(); }
  // 0 without a card or a source.
  [[nodiscard]] double latency_s() const { return pump_ ? pump_->latency_s() : 0.0; }

 private:
  std::shared_ptr<SoundRing> ring_;
  std::unique_ptr<Card> card_;
  std::optional<TickTaker> taker_;
  std::optional<SoundPump> pump_;
};

}  // namespace

struct SoundPlayer::Shared {
  explicit Shared(OpenCard card) : open_card(std::move(card)) {}

  // All of these need the lock.
  [[nodiscard]] bool heeded() const { return !end && !source_is_new && on == card_tried; }
  void listen(bool wanted) const {
    if (source.feed) source.feed->wanted.store(wanted, std::memory_order_relaxed);
  }
  void watch(const Output& output);
  // Give the lock up while they wait for the card.
  void heed_card(std::unique_lock<std::mutex>& lock, Output& output);
  void take_source(std::unique_lock<std::mutex>& lock, Output& output);
  void step(std::unique_lock<std::mutex>& lock, Output& output);
  // Returns when the owner changed something, or after a period while there is a card.
  void wait(std::unique_lock<std::mutex>& lock, const Output& output);

  const OpenCard open_card;
  const std::shared_ptr<SoundRing> ring = std::make_shared<SoundRing>();
  std::mutex mutex;  // guards the members below; not held while the card is called
  std::condition_variable changed;
  SoundSource source;
  bool source_is_new = false;
  SoundMix mix;
  bool on = false;
  bool card_tried = false;  // follows `on`, also where the card did not open
  bool end = false;
  bool ended = false;
  SoundStatus status;
  std::uint64_t calls = 0;  // calls of the card at the last check
  int silent_periods = 0;
};

void SoundPlayer::Shared::watch(const Output& output) {
  if (output.card() == nullptr) return;
  silent_periods = ring->calls() == calls ? silent_periods + 1 : 0;
  calls = ring->calls();
  status.state = silent_periods < kStuckPeriods ? SoundState::kPlaying : SoundState::kStuck;
  status.latency_s = output.latency_s();
}

void SoundPlayer::Shared::heed_card(std::unique_lock<std::mutex>& lock, Output& output) {
  if (on == card_tried) return;
  card_tried = on;
  status = {on ? SoundState::kOpening : SoundState::kOff, "", "", 0.0};
  lock.unlock();
  output.close();
  const Failure problem = card_tried ? output.open(open_card) : std::nullopt;
  lock.lock();
  if (output.card() != nullptr)
    status = {SoundState::kPlaying, output.card()->facts().name, "", 0.0};
  if (problem) status = {SoundState::kNoCard, "", problem->message, 0.0};
  silent_periods = 0;
  source_is_new = true;
}

void SoundPlayer::Shared::take_source(std::unique_lock<std::mutex>& lock, Output& output) {
  if (!source_is_new) return;
  source_is_new = false;
  listen(output.card() != nullptr && !end);
  const SoundSource taken = source;
  lock.unlock();
  output.follow(taken);
  lock.lock();
}

void SoundPlayer::Shared::step(std::unique_lock<std::mutex>& lock, Output& output) {
  const SoundMix now = mix;
  lock.unlock();
  output.step(now);
  lock.lock();
  watch(output);
}

void SoundPlayer::Shared::wait(std::unique_lock<std::mutex>& lock, const Output& output) {
  const auto has_work = [this] { return !heeded(); };
  if (output.card() != nullptr) {
    changed.wait_for(lock, kPeriod, has_work);
  } else {
    changed.wait(lock, has_work);
  }
}

void SoundPlayer::work(const std::shared_ptr<Shared>& shared) {
  session::set_up_recorder_thread();
  auto output = std::make_unique<Output>(shared->ring);
  std::unique_lock lock(shared->mutex);
  while (!shared->end) {
    shared->heed_card(lock, *output);
    shared->take_source(lock, *output);
    shared->step(lock, *output);
    shared->wait(lock, *output);
  }
  lock.unlock();
  output.reset();
  lock.lock();
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
