#include "app/runtime/loop/arming.h"

namespace hapticwall::runtime {

std::string_view arming_note_text(ArmingNote note) {
  switch (note) {
    case ArmingNote::kNone:
      return "";
    case ArmingNote::kAsked:
      return "switched off";
    case ArmingNote::kInsideWall:
      return "the handle is inside the wall: move it out first";
    case ArmingNote::kNotReady:
      return "the device gives no valid position";
    case ArmingNote::kPaused:
      return "the session is paused";
    case ArmingNote::kStale:
      return "the newest position was too old";
    case ArmingNote::kDevice:
      return "the device was lost or reported a fault";
    case ArmingNote::kForce:
      return "the force was not a finite number";
    case ArmingNote::kWallMoved:
      return "the change would have put the wall over the handle";
    case ArmingNote::kLate:
      return "the program was held up for too long";
  }
  return "";
}

}  // namespace hapticwall::runtime
