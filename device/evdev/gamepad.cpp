#include "device/evdev/gamepad.h"

#include <limits>
#include <utility>

#include "device/evdev/event_node.h"

namespace hapticwall::device::evdev {
namespace {

constexpr std::int32_t kFullGain = std::numeric_limits<std::uint16_t>::max();

class EventGamepad final : public Gamepad {
 public:
  EventGamepad(EventNode node, std::string name) : node_(std::move(node)), name_(std::move(name)) {
    effect_.type = FF_RUMBLE;
    effect_.id = -1;
    effect_.replay.length = kRumbleMs;
  }

  // Makes the effect that all calls use.
  [[nodiscard]] Failure begin() {
    if (Failure failed = node_.upload(effect_)) return named(std::move(failed));
    return named(node_.write(EV_FF, FF_GAIN, kFullGain));
  }

  [[nodiscard]] std::string name() const override { return name_; }

  [[nodiscard]] Failure rumble(RumbleLevels levels) override {
    if (levels == RumbleLevels{}) return play(0);
    effect_.u.rumble = {levels.strong, levels.weak};
    if (Failure failed = node_.upload(effect_)) return named(std::move(failed));
    return play(1);
  }

 private:
  [[nodiscard]] Failure play(std::int32_t times) const {
    return named(node_.write(EV_FF, static_cast<std::uint16_t>(effect_.id), times));
  }
  [[nodiscard]] Failure named(Failure failure) const {
    if (failure) failure->message = name_ + ": " + failure->message;
    return failure;
  }

  EventNode node_;
  std::string name_;
  ff_effect effect_{};
};

Result<std::unique_ptr<Gamepad>> open_gamepad(const NodeListing& listing) {
  const std::string name = listing.name() + " (" + listing.path() + ")";
  Result<EventNode> node = EventNode::open(listing.path());
  if (!node) return device_error(name + " cannot be opened: " + node.error().message);
  auto gamepad = std::make_unique<EventGamepad>(std::move(*node), name);
  if (Failure failed = gamepad->begin()) return *std::move(failed);
  return std::unique_ptr<Gamepad>(std::move(gamepad));
}

}  // namespace

Result<std::unique_ptr<Gamepad>> open_first_gamepad() {
  Failure refusal;
  for (const NodeListing& listing : list_nodes()) {
    if (!listing.has("key", BTN_GAMEPAD) || !listing.has("ff", FF_RUMBLE)) continue;
    Result<std::unique_ptr<Gamepad>> gamepad = open_gamepad(listing);
    if (gamepad) return gamepad;
    if (!refusal) refusal = gamepad.error();
  }
  return refusal.value_or(device_error("no gamepad with rumble motors"));
}

}  // namespace hapticwall::device::evdev
