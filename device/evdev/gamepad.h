// The rumble motors of a gamepad. They shake it and push nowhere: no force comes from here.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "core/result.h"

namespace hapticwall::device::evdev {

// Of the two motors, 0 to 65535. The strong one turns slowly, the weak one fast.
struct RumbleLevels {
  std::uint16_t strong = 0;
  std::uint16_t weak = 0;

  friend bool operator==(const RumbleLevels&, const RumbleLevels&) = default;
};

// Time after which the gamepad stops by itself: a program that hangs does not rumble on.
inline constexpr std::uint16_t kRumbleMs = 100;

// Closed, and still, after its destructor.
class Gamepad {
 public:
  Gamepad() = default;
  Gamepad(const Gamepad&) = delete;
  Gamepad& operator=(const Gamepad&) = delete;
  virtual ~Gamepad() = default;

  [[nodiscard]] virtual std::string name() const = 0;
  // Rumbles for kRumbleMs or until the next call; {0, 0} stops at once. An error names the gamepad:
  // it was unplugged, for example. Realtime-safe: no, its driver may sleep.
  [[nodiscard]] virtual Failure rumble(RumbleLevels levels) = 0;
};

using OpenGamepad = std::function<Result<std::unique_ptr<Gamepad>>()>;

// The first one with BTN_GAMEPAD and FF_RUMBLE that can be opened, at full gain. Fails with
// ErrorKind::kDevice: there is none, or it needs a permission.
[[nodiscard]] Result<std::unique_ptr<Gamepad>> open_first_gamepad();

}  // namespace hapticwall::device::evdev
