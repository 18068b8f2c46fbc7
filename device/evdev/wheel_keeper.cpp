#include "device/evdev/wheel_keeper.h"

#include <algorithm>
#include <chrono>
#include <system_error>
#include <thread>

#include "device/hid/description.h"
#include "device/os_threads.h"

namespace hapticwall::device {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

// The age of a resting position counts from the last look.
constexpr int kListenMs = 1;
constexpr milliseconds kWriterRest{5};
constexpr milliseconds kBetweenLooks{200};
constexpr milliseconds kMaxOpening{5000};
constexpr milliseconds kMaxClosing{1000};
// Looks that may fail before the first link-up fails.
constexpr int kLooksToOpen = 3;

bool fits(const evdev::WheelListing& wheel, const WheelOptions& options) {
  if (!options.path.empty() && wheel.node.path() != options.path) return false;
  if (!options.serial.empty() && wheel.node.serial() != options.serial) return false;
  return options.vendor_id == 0 ||
         (wheel.vendor_id == options.vendor_id && wheel.product_id == options.product_id);
}

DeviceInfo info_of(const WheelOptions& options, const evdev::WheelListing& listing,
                   const WheelScale& scale) {
  DeviceInfo info;
  info.name = options.name.empty() ? listing.name : options.name;
  info.encoder_m = scale.encoder_m();
  info.force_limit_n = scale.limit_n();
  const double end_m = scale.travel_m() / 2.0 + scale.encoder_m();
  info.motion = {-end_m, end_m, options.wheel.max_speed_m_per_s};
  info.max_force_rate_n_per_s = options.wheel.max_force_rate_n_per_s > 0.0
                                    ? options.wheel.max_force_rate_n_per_s
                                    : scale.limit_n() / hid::kForceRiseS;
  info.delay_date = options.wheel.delay_date;
  return info;
}

}  // namespace

struct WheelKeeper::Open {
  std::shared_ptr<evdev::WheelNode> node;
  WheelScale scale;
  WheelWriter writer;
};

Result<evdev::WheelListing> choose_wheel(const std::vector<evdev::WheelListing>& wheels,
                                         const WheelOptions& options) {
  const auto found =
      std::ranges::find_if(wheels, [&](const auto& wheel) { return fits(wheel, options); });
  if (found == wheels.end()) {
    return device_error("no wheel or stick with a constant force" +
                        (options.path.empty() ? "" : " at " + options.path) +
                        " is connected; 'hapticwall devices' lists the connected devices");
  }
  if (!found->refusal.empty()) return device_error(found->name + ": " + found->refusal);
  return *found;
}

void WheelKeeper::run() {
  if (options_.prepare_thread) options_.prepare_thread();
  while (!stop_) {
    try {
      if (const Failure failure = serve()) say(failure->message, Trouble::kRefused);
    } catch (const std::system_error&) {
      say("the wheel gets no thread: the system runs too many", Trouble::kRefused);
    }
    if (!stop_) rest();
  }
  const std::lock_guard lock(mutex_);
  over_ = true;
  changed_.notify_all();
}

void WheelKeeper::rest() {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, kBetweenLooks, [this] { return stop_.load(); });
}

// From the look for a wheel to its loss.
Failure WheelKeeper::serve() {
  const auto listing = choose_wheel(port_.list(), options_);
  if (!listing) return listing.error();
  auto node = port_.open(*listing);
  if (!node) return node.error();
  const WheelScale scale(options_.wheel, (*node)->axis());
  const double rate_hz = options_.wheel.rate_hz > 0.0
                             ? std::min(options_.wheel.rate_hz, listing->max_rate_hz)
                             : listing->max_rate_hz;
  ++session_;
  Open wheel{*node, scale, WheelWriter(**node, scale, exchange_, session_, rate_hz, now_ns_())};
  come_up(*listing, scale);
  std::thread writer = start_thread([this, &wheel] { write(wheel.writer); });
  const bool gone = listen(wheel);
  wheel.writer.stop();
  exchange_.command_signal.post();
  writer.join();
  if (!stop_) exchange_.losses.fetch_add(1, std::memory_order_relaxed);
  if (gone) {
    say(listing->node.path() + " is no longer connected: plug the device in again",
        Trouble::kUnplugged);
  } else {
    say("", exchange_.lost.load().reason);
  }
  return std::nullopt;
}

// After a loss no other wheel takes its place.
void WheelKeeper::come_up(const evdev::WheelListing& listing, const WheelScale& scale) {
  options_.vendor_id = listing.vendor_id;
  options_.product_id = listing.product_id;
  options_.serial = listing.node.serial();
  const std::lock_guard lock(mutex_);
  info_ = info_of(options_, listing, scale);
  words_ = "turn the wheel a little: it tells its position when it moves, and has told none yet";
}

bool WheelKeeper::listen(Open& wheel) {
  looked_ns_ = now_ns_();
  exchange_.listening.begin(looked_ns_);
  bool is_up = false;
  while (!stop_ && !wheel.writer.over() && exchange_.lost.load().session != session_) {
    const evdev::WheelNews news = wheel.node->listen(kListenMs);
    exchange_.listening.heard(now_ns_(), news.gone);
    if (news.gone) return true;
    if (!news.value) continue;
    publish(wheel, news);
    if (is_up) continue;
    is_up = true;
    exchange_.status = {session_, Trouble::kNone};
    const std::lock_guard lock(mutex_);
    words_.clear();
    changed_.notify_all();
  }
  return wheel.writer.over() && !stop_;
}

// Silence is rest: without an event the position of now is known, too. The kernel may date an event
// back to the last play of the force: it cannot be older than the last look.
void WheelKeeper::publish(const Open& wheel, const evdev::WheelNews& news) {
  const std::int64_t now_ns = now_ns_();
  view_.session = session_;
  view_.received_ns = news.events > 0 ? std::clamp(news.latch_ns, looked_ns_, now_ns) : now_ns;
  looked_ns_ = now_ns;
  view_.position_m[0] = wheel.scale.position_m(*news.value);
  view_.stats.acknowledges = false;
  view_.stats.calibrated = true;
  view_.stats.delay_s = options_.wheel.delay_s;
  if (news.events > 0) ++view_.stats.states;
  exchange_.views.publish(view_);
}

void WheelKeeper::write(WheelWriter& writer) {
  if (options_.prepare_thread) options_.prepare_thread();
  while (!writer.over()) {
    const WheelWriter::Next next = writer.step(now_ns_);
    if (next.command_counts) exchange_.command_signal.wait(kWriterRest);
    std::this_thread::sleep_for(nanoseconds(writer.free_ns() - now_ns_()));
  }
}

void WheelKeeper::say(const std::string& words, Trouble reason) {
  exchange_.status = {0, reason};
  const std::lock_guard lock(mutex_);
  words_ = words;
  ++failures_;
  changed_.notify_all();
}

Failure WheelKeeper::wait_until_up() {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, kMaxOpening, [this] {
    return exchange_.status.load().session != 0 || failures_ >= kLooksToOpen;
  });
  if (exchange_.status.load().session != 0) return std::nullopt;
  return device_error(words_.empty() ? "the wheel does not answer: plug it in again" : words_);
}

void WheelKeeper::stop() {
  stop_ = true;
  std::unique_lock lock(mutex_);
  changed_.notify_all();
  changed_.wait_for(lock, kMaxClosing, [this] { return over_; });
}

std::string WheelKeeper::words() const {
  const std::lock_guard lock(mutex_);
  return words_;
}

std::optional<DeviceInfo> WheelKeeper::info() const {
  const std::lock_guard lock(mutex_);
  return info_;
}

}  // namespace hapticwall::device
