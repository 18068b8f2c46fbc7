#include "core/tick/pulse.h"

namespace hapticwall {
namespace {

constexpr std::size_t kLineBytes = 64;  // apart, so that no thread slows another down

struct alignas(kLineBytes) Place {
  std::atomic<std::uint64_t> value{0};
};
constinit std::array<Place, kMaxPulses> g_places{};
static_assert(std::atomic<std::uint64_t>::is_always_lock_free);

}  // namespace

void Pulse::begin() noexcept {
  for (Place& place : g_places) {
    if (place_ != nullptr) return;
    std::uint64_t value = place.value.load(std::memory_order_relaxed);
    if (value % kStates != kFree) continue;
    if (place.value.compare_exchange_strong(value, value + kRests)) place_ = &place.value;
  }
}

Pulse::~Pulse() { go_on(kFree); }

bool PulseWatch::finds_silence(std::int64_t now_ns, std::int64_t max_silence_ns) noexcept {
  bool silence = false;
  for (std::size_t i = 0; i < kMaxPulses; ++i) {
    const std::uint64_t value = g_places[i].value.load(std::memory_order_acquire);
    if (value != seen_[i].value) seen_[i] = {value, now_ns};
    const bool due = value % Pulse::kStates == Pulse::kBeats;
    silence = silence || (due && now_ns - seen_[i].since_ns > max_silence_ns);
  }
  return silence;
}

}  // namespace hapticwall
