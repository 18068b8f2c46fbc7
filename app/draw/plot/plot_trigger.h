// The trigger holds the time window at the newest contact, as on an oscilloscope.
#pragma once

#include <cstdint>
#include <optional>

#include "app/draw/plot/sample_history.h"

namespace hapticwall::draw {

struct TimeWindow {
  double from_s = 0.0;
  double to_s = 0.0;

  [[nodiscard]] double length_s() const { return to_s - from_s; }
};

enum class TriggerMode : std::uint8_t {
  kOff,     // the window follows the newest samples
  kAuto,    // shows the newest contact; without one, the newest samples
  kNormal,  // shows the newest contact until the next one
  kSingle,  // shows the next contact, then stops
};

struct TriggerSettings {
  TriggerMode mode = TriggerMode::kOff;
  double pre_share = 0.25;  // share of the window before the contact; 0 to 1
};

enum class TriggerStage : std::uint8_t {
  kWaiting,  // waits for a contact
  kFilling,  // the window of a contact is not full yet
  kShown,    // the window is full; the next contact replaces it
  kDone,     // the window is full and stays (kSingle)
};

// The state of the trigger between frames.
struct Trigger {
  TriggerStage stage = TriggerStage::kWaiting;
  std::optional<double> contact_s;  // the contact that the window shows
  std::optional<double> after_s;    // a contact must be later than this
};

// A window that fills in less than this appears only when it is full.
inline constexpr double kMaxUnseenFillS = 0.25;
// How long `auto` shows an old contact before it follows the newest samples.
inline constexpr double kAutoPatienceS = 1.0;

// A trigger that waits for a contact; kSingle ignores contacts up to `newest_s`.
[[nodiscard]] Trigger armed_trigger(const TriggerSettings& settings, double newest_s);

// One frame. Returns the place of the window of this length, or nullopt if it must not move.
[[nodiscard]] std::optional<TimeWindow> run_trigger(const SampleHistory& history,
                                                    const TriggerSettings& settings,
                                                    double length_s, Trigger& trigger);

// The window at the newest sample; a younger session begins at the left edge.
[[nodiscard]] TimeWindow newest_window(double newest_s, double length_s);

// The newest contact that begins in the range: from its first sample in the wall to one past its
// last, or to the end of the range. A contact at the first sample of the range does not count.
[[nodiscard]] std::optional<IndexRange> newest_contact(const SampleHistory& history,
                                                       IndexRange range);

}  // namespace hapticwall::draw
