#include "app/session/stream_events.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/file/text/text.h"

namespace hapticwall::session {
namespace {

std::string quoted(std::string_view text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string_view state_name(ArmingState state) {
  switch (state) {
    case ArmingState::kNotNeeded:
      return "not needed";
    case ArmingState::kOff:
      return "off";
    case ArmingState::kRamping:
      return "ramping";
    case ArmingState::kOn:
      return "on";
  }
  return "";
}

}  // namespace

void StreamEvents::other(EventTick at, std::string_view name, std::string_view more) {
  if (!stream_) return;
  stream_->add_event(fmt::format("{{\"event\":{},\"tick\":{},\"time_s\":{}{}}}", quoted(name),
                                 at.tick, file::shortest_number(at.time_s), more));
}

void StreamEvents::mark(EventTick at, std::string_view text) {
  other(at, "mark", ",\"text\":" + quoted(text));
}

void StreamEvents::algorithm(EventTick at, std::string_view name) {
  if (name == algorithm_) return;
  algorithm_ = name;
  other(at, "algorithm", ",\"name\":" + quoted(name));
}

void StreamEvents::arming(EventTick at, const ArmingStatus& status) {
  if (status.state == armed_ && status.note == note_) return;
  armed_ = status.state;
  note_ = status.note;
  other(at, "arming",
        fmt::format(",\"state\":{},\"note\":{}", quoted(state_name(status.state)),
                    quoted(arming_note_text(status.note))));
}

}  // namespace hapticwall::session
