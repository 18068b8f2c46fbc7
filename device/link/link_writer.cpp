#include "device/link/link_writer.h"

#include <algorithm>
#include <utility>

namespace hapticwall::device {

WriteSession::WriteSession(std::uint32_t number, std::unique_ptr<hid::Handle> handle,
                           std::shared_ptr<SentCommands> sent, LinkExchange& exchange,
                           std::int64_t keep_alive_ns)
    : number_(number),
      handle_(std::move(handle)),
      sent_(std::move(sent)),
      exchange_(exchange),
      keep_alive_ns_(keep_alive_ns) {}

// The first and the last command remove the force; those between come from the exchange. A command
// of the previous session is ignored.
bool WriteSession::next_command(LinkCommand& command, std::int64_t now_ns) {
  const bool news = exchange_.commands.update();
  const LinkCommand& found = exchange_.commands.current();
  const bool ours = found.session == number_;
  if (ours) newest_ = found;
  command = newest_;
  const bool repeats = keep_alive_ns_ > 0 && now_ns - began_ns_ >= keep_alive_ns_;
  if (begun_ && !last_) return (news && ours) || repeats;
  command.enable = false;
  command.clear_faults = false;
  return true;
}

std::optional<hid::ReportBytes> WriteSession::begin(std::int64_t now_ns) {
  if (last_ || !move(State::kIdle, State::kTaking)) return std::nullopt;
  last_ = stop_.load(std::memory_order_acquire);
  LinkCommand command;
  if (!next_command(command, now_ns)) {
    state_.store(State::kIdle, std::memory_order_release);
    return std::nullopt;
  }
  const bool goes_back_to_a_state = newest_.session == number_;
  begun_ = true;
  ++sequence_;
  const hid::ForceReport report = force_report(command, sequence_, now_ns);
  if (goes_back_to_a_state) sent_->note(sequence_, command.state_latch_us, sent_force(report));
  began_ns_ = now_ns;
  state_.store(State::kWriting, std::memory_order_release);
  return hid::encode_force(report);
}

void WriteSession::finish(std::int64_t now_ns) {
  if (!move(State::kWriting, State::kTaking)) {
    state_.store(State::kDone, std::memory_order_release);
    return;
  }
  const std::int64_t took_ns = now_ns - began_ns_;
  exchange_.write_ns.store(took_ns, std::memory_order_relaxed);
  exchange_.longest_write_ns.store(
      std::max(took_ns, exchange_.longest_write_ns.load(std::memory_order_relaxed)),
      std::memory_order_relaxed);
  state_.store(last_ ? State::kDone : State::kIdle, std::memory_order_release);
}

bool WriteSession::abandon() { return move(State::kWriting, State::kAbandoned); }

}  // namespace hapticwall::device
