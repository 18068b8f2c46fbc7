// The scope: a time window that stands still at the newest contact.
#pragma once

#include <cstdint>
#include <optional>

#include "app/ui/sample_history.h"

namespace hapticwall::ui {

struct TimeWindow {
  double from_s = 0.0;
  double to_s = 0.0;

  [[nodiscard]] double length_s() const { return to_s - from_s; }
};

enum class TriggerMode : std::uint8_t {
  kOff,     // the window follows the newest samples
  kAuto,    // at the newest contact; where none comes, the newest samples
  kNormal,  // at the newest contact, for as long as no other comes
  kSingle,  // at the next contact, and then it stays
};

struct TriggerSettings {
  TriggerMode mode = TriggerMode::kOff;
  double pre_share = 0.25;  // of the window, in front of the contact; 0 to 1
};

enum class TriggerStage : std::uint8_t {
  kWaiting,  // for a contact
  kFilling,  // the contact is there, the end of its window is not
  kShown,    // the window is full; the next contact replaces it
  kDone,     // the same, and nothing replaces it: single
};

// What the trigger remembers from frame to frame.
struct Trigger {
  TriggerStage stage = TriggerStage::kWaiting;
  std::optional<double> contact_s;  // the one that the window shows
  std::optional<double> after_s;    // a contact must be later than this
};

// A window that fills in less than this is shown when it is full: no picture is ever half empty.
inline constexpr double kLongestUnseenFillS = 0.25;
// How long `auto` shows an old contact before it follows the newest samples.
inline constexpr double kAutoPatienceS = 1.0;

// Waits for a contact. `newest_s`: only later ones count (single); nothing: any that is kept.
[[nodiscard]] Trigger armed_trigger(const TriggerSettings& settings, double newest_s);

// One frame. Returns where the window of this length must stand, or nothing where it must stay.
[[nodiscard]] std::optional<TimeWindow> run_trigger(const SampleHistory& history,
                                                    const TriggerSettings& settings,
                                                    double length_s, Trigger& trigger);

// The newest length of time; a session younger than that begins at the left.
[[nodiscard]] TimeWindow newest_window(double newest_s, double length_s);

// The newest contact that begins in the range: from its first sample in the wall to one past its
// last, or to the end of the range. A contact that was there from the first sample does not count.
[[nodiscard]] std::optional<IndexRange> newest_contact(const SampleHistory& history,
                                                       IndexRange range);

}  // namespace hapticwall::ui
