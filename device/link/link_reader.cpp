#include "device/link/link_reader.h"

#include <array>
#include <span>
#include <utility>

namespace hapticwall::device {
namespace {

// Larger than a report, so that an overlong one is noticed.
constexpr std::size_t kInputRoom = hid::kReportBytes + 64;
// The transport queues 63 reports (hidraw) or about 30 (libusb). The bound ends the loop if a
// device sends faster than the reader reads.
constexpr int kMaxAtOnce = 256;

}  // namespace

void LinkReader::give(std::shared_ptr<ReadSession> session) {
  const std::lock_guard lock(mutex_);
  next_ = std::move(session);
  awake_ = true;
  news_.notify_all();
}

void LinkReader::wake() {
  const std::lock_guard lock(mutex_);
  awake_ = true;
  news_.notify_all();
}

void LinkReader::rest(std::chrono::milliseconds longest) {
  std::unique_lock lock(mutex_);
  news_.wait_for(lock, longest, [this] { return awake_; });
  awake_ = false;
}

void LinkReader::take_session() {
  const std::lock_guard lock(mutex_);
  if (!next_) return;
  session_ = std::move(next_);
  tracker_.begin(session_->link);
  exchange_.listening.begin(now_ns_());
}

LinkReader::Step LinkReader::step(int wait_ms) {
  if (!session_) take_session();
  if (!session_) return Step::kNothingToDo;
  if (session_->stop.load(std::memory_order_acquire)) {
    const std::shared_ptr<ReadSession> session = std::move(session_);
    session_.reset();
    session->released.store(true, std::memory_order_release);
    return Step::kNothingToDo;
  }
  const hid::ReadKind last = drain(wait_ms);
  session_->ended.store(tracker_.ended(), std::memory_order_release);
  if (last == hid::ReadKind::kGone) session_->gone.store(true, std::memory_order_release);
  return last == hid::ReadKind::kGone || last == hid::ReadKind::kFailed ? Step::kFailed
                                                                        : Step::kWorked;
}

// Waits for the first report only, then drains the queue: only the newest counts.
hid::ReadKind LinkReader::drain(int wait_ms) {
  std::array<std::uint8_t, kInputRoom> room{};
  bool news = false;
  hid::ReadKind last = hid::ReadKind::kNothing;
  for (int i = 0; i < kMaxAtOnce; ++i) {
    const hid::ReadOutcome outcome = session_->handle->read(room, i == 0 ? wait_ms : 0);
    last = outcome.kind;
    const bool works = last == hid::ReadKind::kReport || last == hid::ReadKind::kNothing;
    const std::int64_t now_ns = now_ns_();
    const Trouble gap = exchange_.listening.cause(now_ns);  // the cause before this read
    exchange_.listening.heard(now_ns, !works);
    if (last != hid::ReadKind::kReport) break;
    take(std::span<const std::uint8_t>(room).first(std::min(outcome.size, room.size())), now_ns,
         gap);
    news = true;
  }
  if (news) {
    const LinkView& view = tracker_.view();
    exchange_.views.publish(view);
    if (view.session == session_->link.number) {
      session_->newest_ns.store(view.received_ns, std::memory_order_release);
    }
  }
  return last;
}

void LinkReader::take(std::span<const std::uint8_t> bytes, std::int64_t now_ns, Trouble gap) {
  session_->packets.fetch_add(1, std::memory_order_relaxed);
  const std::uint64_t void_reports = tracker_.view().stats.void_reports;
  tracker_.take(bytes, now_ns, gap);
  if (tracker_.view().stats.void_reports != void_reports) exchange_.listening.heard_void(now_ns);
}

}  // namespace hapticwall::device
