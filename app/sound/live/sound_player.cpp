#include "app/sound/live/sound_player.h"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <utility>

#include "app/runtime/loop/realtime_setup.h"
#include "app/sound/live/sound_outputs.h"

namespace hapticwall::sound {
namespace {

constexpr std::chrono::duration<double> kPeriod{kPumpPeriodS};
// Without a card nothing is heard late, and a processor sleeps longer.
constexpr std::chrono::duration<double> kPeriodWithoutCard{0.005};
constexpr std::chrono::milliseconds kEndWait{200};
// A card that asks for nothing in so many periods is stuck.
constexpr int kStuckPeriods = 1000;

}  // namespace

struct SoundPlayer::Shared {
  Shared(OpenCard card, device::evdev::OpenGamepad gamepad)
      : open_card(std::move(card)), open_gamepad(std::move(gamepad)) {}

  // With the lock, all of these.
  [[nodiscard]] bool heeded() const {
    return !end && !source_is_new && on == card_tried && rumbles == gamepad_tried;
  }
  void listen(bool wanted) const {
    if (source.feed) source.feed->wanted.store(wanted, std::memory_order_relaxed);
  }
  void watch(const SoundOutputs& outputs);
  void note_gamepad(const SoundOutputs& outputs, const Failure& problem);
  // Give the lock up while they wait for card or gamepad.
  void heed_card(std::unique_lock<std::mutex>& lock, SoundOutputs& outputs);
  void heed_gamepad(std::unique_lock<std::mutex>& lock, SoundOutputs& outputs);
  void take_source(std::unique_lock<std::mutex>& lock, SoundOutputs& outputs);
  void step(std::unique_lock<std::mutex>& lock, SoundOutputs& outputs);
  // Returns when the owner changed something, or after a period while there is an output.
  void wait(std::unique_lock<std::mutex>& lock, const SoundOutputs& outputs);

  const OpenCard open_card;
  const device::evdev::OpenGamepad open_gamepad;
  const std::shared_ptr<SoundRing> ring = std::make_shared<SoundRing>();
  std::mutex mutex;  // of the following; not held while card or gamepad are asked for anything
  std::condition_variable changed;
  SoundSource source;
  bool source_is_new = false;
  SoundMix mix;
  bool on = false;
  bool card_tried = false;  // follows `on`, also where the card did not open
  bool rumbles = false;
  bool gamepad_tried = false;
  bool end = false;
  bool ended = false;
  SoundStatus status;
  RumbleStatus rumble_status;
  std::uint64_t calls = 0;  // of the card, at the last look
  int silent_periods = 0;
};

void SoundPlayer::Shared::watch(const SoundOutputs& outputs) {
  if (outputs.card() == nullptr) return;
  silent_periods = ring->calls() == calls ? silent_periods + 1 : 0;
  calls = ring->calls();
  status.state = silent_periods < kStuckPeriods ? SoundState::kPlaying : SoundState::kStuck;
  status.latency_s = outputs.latency_s();
}

void SoundPlayer::Shared::note_gamepad(const SoundOutputs& outputs, const Failure& problem) {
  rumble_status = {};
  if (outputs.gamepad() != nullptr)
    rumble_status = {RumbleState::kOn, outputs.gamepad()->name(), ""};
  if (problem) rumble_status = {RumbleState::kNoGamepad, "", problem->message};
}

void SoundPlayer::Shared::heed_card(std::unique_lock<std::mutex>& lock, SoundOutputs& outputs) {
  if (on == card_tried) return;
  card_tried = on;
  status = {on ? SoundState::kOpening : SoundState::kOff, "", "", 0.0};
  lock.unlock();
  outputs.close_card();
  const Failure problem = card_tried ? outputs.open_card(open_card) : std::nullopt;
  lock.lock();
  if (outputs.card() != nullptr)
    status = {SoundState::kPlaying, outputs.card()->facts().name, "", 0.0};
  if (problem) status = {SoundState::kNoCard, "", problem->message, 0.0};
  silent_periods = 0;
  source_is_new = true;
}

void SoundPlayer::Shared::heed_gamepad(std::unique_lock<std::mutex>& lock, SoundOutputs& outputs) {
  if (rumbles == gamepad_tried) return;
  gamepad_tried = rumbles;
  lock.unlock();
  outputs.close_gamepad();
  const Failure problem = gamepad_tried ? outputs.open_gamepad(open_gamepad) : std::nullopt;
  lock.lock();
  note_gamepad(outputs, problem);
  source_is_new = true;
}

void SoundPlayer::Shared::take_source(std::unique_lock<std::mutex>& lock, SoundOutputs& outputs) {
  if (!source_is_new) return;
  source_is_new = false;
  listen(outputs.any() && !end);
  const SoundSource taken = source;
  lock.unlock();
  outputs.follow(taken);
  lock.lock();
}

void SoundPlayer::Shared::step(std::unique_lock<std::mutex>& lock, SoundOutputs& outputs) {
  const SoundMix now = mix;
  lock.unlock();
  const Failure lost = outputs.step(now);
  lock.lock();
  watch(outputs);
  if (!lost) return;
  note_gamepad(outputs, lost);
  source_is_new = true;
}

void SoundPlayer::Shared::wait(std::unique_lock<std::mutex>& lock, const SoundOutputs& outputs) {
  const auto has_work = [this] { return !heeded(); };
  if (outputs.any()) {
    changed.wait_for(lock, outputs.card() != nullptr ? kPeriod : kPeriodWithoutCard, has_work);
  } else {
    changed.wait(lock, has_work);
  }
}

void SoundPlayer::work(const std::shared_ptr<Shared>& shared) {
  runtime::set_up_recorder_thread();
  auto outputs = std::make_unique<SoundOutputs>(shared->ring);
  std::unique_lock lock(shared->mutex);
  while (!shared->end) {
    shared->heed_card(lock, *outputs);
    shared->heed_gamepad(lock, *outputs);
    shared->take_source(lock, *outputs);
    shared->step(lock, *outputs);
    shared->wait(lock, *outputs);
  }
  lock.unlock();
  outputs.reset();
  lock.lock();
  shared->ended = true;
  shared->changed.notify_all();
}

SoundPlayer::SoundPlayer(OpenCard open_card, device::evdev::OpenGamepad open_gamepad)
    : shared_(std::make_shared<Shared>(std::move(open_card), std::move(open_gamepad))) {}

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

void SoundPlayer::play(bool on) { change(&Shared::on, on); }

void SoundPlayer::rumble(bool on) { change(&Shared::rumbles, on); }

void SoundPlayer::change(bool Shared::*wish, bool on) {
  const std::scoped_lock lock(shared_->mutex);
  if (on == (*shared_).*wish) return;
  (*shared_).*wish = on;
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

RumbleStatus SoundPlayer::rumble_status() const {
  const std::scoped_lock lock(shared_->mutex);
  return shared_->rumble_status;
}

}  // namespace hapticwall::sound
