#include "device/link/link_owner.h"

#include <algorithm>
#include <system_error>
#include <utility>

namespace hapticwall::device {
namespace {

// Intervals of the owner: while the link is up, and while a change is pending.
constexpr std::int64_t kWatchNs = 5 * kMillisecondNs;
constexpr std::int64_t kSoonNs = kMillisecondNs;
// The owner reopens only while fewer writers than this hang in a write.
constexpr std::size_t kMaxLeftAlone = 4;

std::string four_digits(std::uint16_t number) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (int shift = 12; shift >= 0; shift -= 4) text += kDigits[(number >> shift) & 0xFU];
  return text;
}

std::string nobody_there(const ImpulseEngineOptions& options) {
  std::string text = "no " + options.kind;
  if (options.vendor_id != 0) {
    text += " " + four_digits(options.vendor_id) + ":" + four_digits(options.product_id);
  }
  if (!options.serial.empty()) text += " with the serial number " + options.serial;
  if (!options.path.empty()) text += " at " + options.path;
  return text + " is connected; 'hapticwall devices' lists the connected devices";
}

}  // namespace

LinkOwner::LinkOwner(LinkExchange& exchange, LinkReader& reader, ImpulseEngineOptions options,
                     hid::PortOpener open_port, const HostClock& now_ns, StartWriter start_writer)
    : exchange_(exchange),
      reader_(reader),
      options_(std::move(options)),
      open_port_(std::move(open_port)),
      now_ns_(now_ns),
      start_writer_(std::move(start_writer)),
      next_attempt_ns_(now_ns()) {
  exchange_.listening.let_reads_hang(options_.reads_may_hang);
}

std::string LinkOwner::words() const {
  const std::lock_guard lock(mutex_);
  return words_;
}

std::optional<hid::DeviceDescription> LinkOwner::description() const {
  const std::lock_guard lock(mutex_);
  return description_;
}

void LinkOwner::say(const std::string& words) {
  const std::lock_guard lock(mutex_);
  words_ = words;
}

std::int64_t LinkOwner::step() {
  const std::int64_t now_ns = now_ns_();
  bury();
  if (stop_.load(std::memory_order_acquire)) {
    if (phase_ == Phase::kStarting || phase_ == Phase::kUp) {
      take_down(Trouble::kNotFound, "", now_ns);
    }
    if (phase_ == Phase::kClosing) go_on_closing(now_ns);
    if (phase_ == Phase::kLooking) end_when_closed();
    return next_step_ns(now_ns);
  }
  switch (phase_) {
    case Phase::kLooking:
      if (now_ns >= next_attempt_ns_ && left_alone_.size() < kMaxLeftAlone) look(now_ns);
      break;
    case Phase::kStarting:
      watch_start(now_ns);
      break;
    case Phase::kUp:
      watch(now_ns);
      break;
    case Phase::kClosing:
      go_on_closing(now_ns);
      break;
  }
  return next_step_ns(now_ns);
}

std::int64_t LinkOwner::next_step_ns(std::int64_t now_ns) const {
  if (ending() == Ending::kEnded) return now_ns;
  const std::int64_t soon_ns = now_ns + kSoonNs;
  switch (phase_) {
    case Phase::kLooking:
      if (stop_.load(std::memory_order_acquire)) return soon_ns;
      return std::max(next_attempt_ns_, soon_ns);
    case Phase::kUp:
      return now_ns + kWatchNs;
    case Phase::kStarting:
    case Phase::kClosing:
      break;
  }
  return soon_ns;
}

void LinkOwner::look(std::int64_t now_ns) {
  next_attempt_ns_ = now_ns + back_off_ns_;
  back_off_ns_ = std::min(2 * back_off_ns_, kMaxBackOffNs);
  ++attempts_;
  const Failure failure = bring_up(now_ns);
  if (!failure) return;
  say(failure->message);
  exchange_.status = {0, reason_};
  if (opening() == Opening::kPending && attempts_ >= kAttemptsToOpen) {
    opening_.store(Opening::kFailed, std::memory_order_release);
  }
}

Failure LinkOwner::bring_up(std::int64_t now_ns) {
  const Trouble before = reason_;
  reason_ = Trouble::kRefused;
  if (!port_) {
    auto port = open_port_();
    if (!port) return port.error();
    port_ = std::move(*port);
  }
  const auto listed = port_->list();
  if (!listed) return listed.error();
  tried_ = hid::choose(hid::each_path_once(*listed), options_, known_);
  if (!tried_) {
    reason_ = known_ ? Trouble::kUnplugged : Trouble::kNotFound;
    return device_error(known_ ? known_->path + " is no longer connected: plug the device in again"
                               : nobody_there(options_));
  }
  auto to_read = port_->open(tried_->path);
  if (!to_read) return to_read.error();
  auto to_write = port_->open(tried_->path);
  if (!to_write) return to_write.error();
  const auto description = hid::describe(*tried_, **to_read, options_);
  if (!description) return description.error();
  // A device file alone could allow more force than the device did.
  if (known_describes_itself_ && !description->describes_itself) {
    return device_error(tried_->path +
                        " no longer sends its INFO report: plug the device in again");
  }
  reason_ = before;
  try {
    start(*tried_, *description, std::move(*to_read), std::move(*to_write), now_ns);
  } catch (const std::system_error&) {
    return device_error(tried_->path +
                        " gets no thread to write: the system runs too many; end other programs");
  }
  return std::nullopt;
}

void LinkOwner::start(const hid::Listing& listing, const hid::DeviceDescription& description,
                      std::unique_ptr<hid::Handle> to_read, std::unique_ptr<hid::Handle> to_write,
                      std::int64_t now_ns) {
  ++session_number_;
  const auto sent = std::make_shared<SentCommands>();
  Writer writer;
  writer.session = std::make_shared<WriteSession>(session_number_, std::move(to_write), sent,
                                                  exchange_, options_.keep_alive_ns);
  writer.join = start_writer_(writer.session);
  write_ = std::move(writer);
  read_ = std::make_shared<ReadSession>();
  read_->link = {
      session_number_,         description,        options_.start_m,      sent,
      options_.delay_is_known, options_.has_clock, options_.acknowledges, options_.delay_s};
  read_->handle = std::move(to_read);
  exchange_.status = {session_number_, reason_};
  reader_.give(read_);
  tried_ = listing;
  phase_ = Phase::kStarting;
  since_ns_ = now_ns;
  if (!options_.first_state_advice.empty()) say(options_.first_state_advice);
}

void LinkOwner::watch_start(std::int64_t now_ns) {
  if (read_->newest_ns.load(std::memory_order_acquire) != 0) {
    known_ = tried_;
    known_describes_itself_ = read_->link.device.describes_itself;
    back_off_ns_ = kFirstBackOffNs;
    phase_ = Phase::kUp;
    {
      const std::lock_guard lock(mutex_);
      words_.clear();
      description_ = read_->link.device;
    }
    if (opening() == Opening::kPending) opening_.store(Opening::kUp, std::memory_order_release);
    watch(now_ns);
    return;
  }
  if (read_->gone.load(std::memory_order_acquire)) {
    take_down(Trouble::kUnplugged, hid::obstacle_text(tried_->path, hid::Obstacle::kGone), now_ns);
    return;
  }
  if (now_ns - since_ns_ <= kFirstStateNs || !options_.first_state_advice.empty()) return;
  const bool speaks = read_->packets.load(std::memory_order_relaxed) != 0;
  const char* const others = options_.dialect
                                 ? " sends reports, but none has the length and id of its file"
                                 : " sends reports, but none is a STATE of the protocol";
  take_down(Trouble::kRefused, tried_->path + (speaks ? others : " was opened, but sends nothing"),
            now_ns);
  if (opening() == Opening::kPending && attempts_ >= kAttemptsToOpen) {
    opening_.store(Opening::kFailed, std::memory_order_release);
  }
}

void LinkOwner::watch(std::int64_t now_ns) {
  const bool gone = read_->gone.load(std::memory_order_acquire);
  Trouble trouble = gone ? Trouble::kUnplugged : read_->ended.load(std::memory_order_acquire);
  const std::int64_t silent_ns = now_ns - read_->newest_ns.load(std::memory_order_acquire);
  const LinkStatus lost = exchange_.lost;
  if (trouble == Trouble::kNone && lost.session == session_number_) trouble = lost.reason;
  if (trouble == Trouble::kNone && silent_ns > kLinkLostNs) {
    trouble = exchange_.listening.cause(now_ns);
  }
  if (trouble == Trouble::kNone) return;
  exchange_.losses.fetch_add(1, std::memory_order_relaxed);
  take_down(trouble,
            gone ? hid::obstacle_text(known_->path, hid::Obstacle::kGone)
                 : known_->path + ": " + std::string(trouble_text(trouble)),
            now_ns);
}

// The loop stops commanding first; then the writer removes the force.
void LinkOwner::take_down(Trouble reason, const std::string& words, std::int64_t now_ns) {
  reason_ = reason;
  exchange_.status = {0, reason};
  say(words);
  write_->session->stop();
  exchange_.command_signal.post();
  read_->stop.store(true, std::memory_order_release);
  reader_.wake();
  phase_ = Phase::kClosing;
  since_ns_ = now_ns;
  next_attempt_ns_ = std::max(next_attempt_ns_, now_ns + back_off_ns_);
}

void LinkOwner::go_on_closing(std::int64_t now_ns) {
  if (read_ && read_->released.load(std::memory_order_acquire)) {
    read_->handle.reset();  // closed on this thread, even if the reader still holds the session
    read_.reset();
  }
  if (write_ && write_->session->done()) {
    left_alone_.push_back(std::move(*write_));
    write_.reset();
    bury();
  } else if (write_ && now_ns - since_ns_ > kLastCommandNs && write_->session->abandon()) {
    left_alone_.push_back(std::move(*write_));
    write_.reset();
  }
  if (!read_ && !write_) phase_ = Phase::kLooking;
}

// Closes the abandoned writers whose write has returned.
void LinkOwner::bury() {
  for (Writer& writer : left_alone_) {
    if (!writer.session->done()) continue;
    writer.join();
    writer.session->close();
    writer.session.reset();
  }
  std::erase_if(left_alone_, [](const Writer& writer) { return !writer.session; });
}

void LinkOwner::end_when_closed() {
  if (left_alone_.empty()) port_.reset();
  ending_.store(left_alone_.empty() ? Ending::kEnded : Ending::kLeftAlone,
                std::memory_order_release);
}

}  // namespace hapticwall::device
