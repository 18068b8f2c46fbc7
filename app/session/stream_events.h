// Events of a session as lines of the stream (docs/streams.md).
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "app/file/recording/sample_stream.h"
#include "app/session/loop/snapshot.h"

namespace hapticwall::session {

// A tick of the session, to which an event belongs.
struct EventTick {
  std::uint64_t tick = 0;
  double time_s = 0.0;
};

// Writes events; without a stream, nothing. Call it from the owner's thread. Realtime-safe: no.
class StreamEvents {
 public:
  // `algorithm`: the one in force at the start, which is no event.
  StreamEvents(std::shared_ptr<file::SampleStream> stream, std::string_view algorithm)
      : stream_(std::move(stream)), algorithm_(algorithm) {}

  void mark(EventTick at, std::string_view text);
  // The algorithm in force from this tick on; an unchanged one is no event.
  void algorithm(EventTick at, std::string_view name);
  // A change of the state or of the reason is an event.
  void arming(EventTick at, const ArmingStatus& status);
  // `more`: further members of the object, as JSON with a leading comma.
  void other(EventTick at, std::string_view name, std::string_view more);

 private:
  std::shared_ptr<file::SampleStream> stream_;
  std::string algorithm_;
  ArmingState armed_ = ArmingState::kNotNeeded;
  ArmingNote note_ = ArmingNote::kNone;
};

}  // namespace hapticwall::session
