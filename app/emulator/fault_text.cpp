#include "app/emulator/fault_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <vector>

#include "app/file/text.h"
#include "core/units.h"

namespace hapticwall::emulator {
namespace {

using device::hid::Fault;
using device::hid::FaultKind;

constexpr double kLongestTimeS = 86400.0;
constexpr std::uint32_t kMostTicksApart = 1'000'000;

struct NamedKind {
  std::string_view name;
  FaultKind kind;
};

constexpr auto kKinds = std::to_array<NamedKind>({
    {"empty", FaultKind::kEmpty},
    {"short", FaultKind::kShort},
    {"over-long", FaultKind::kOverLong},
    {"wrong-id", FaultKind::kWrongId},
    {"wrong-major", FaultKind::kWrongMajor},
    {"bad-crc", FaultKind::kBadCrc},
    {"all-zero", FaultKind::kAllZero},
    {"skipped", FaultKind::kSkipped},
    {"repeated", FaultKind::kRepeated},
    {"silent", FaultKind::kSilent},
    {"not-polled", FaultKind::kNotPolled},
    {"no-output", FaultKind::kNoOutput},
    {"unplugged", FaultKind::kUnplugged},
    {"frozen", FaultKind::kFrozen},
    {"restart", FaultKind::kRestart},
    {"emergency-stop", FaultKind::kEmergencyStop},
    {"over-temperature", FaultKind::kOverTemperature},
    {"over-current", FaultKind::kOverCurrent},
    {"encoder-fault", FaultKind::kEncoderFault},
});
static_assert(kKinds.size() == static_cast<std::size_t>(FaultKind::kEncoderFault) + 1);

std::vector<std::string_view> names() {
  std::vector<std::string_view> names;
  names.reserve(kKinds.size());
  for (const NamedKind& known : kKinds) names.push_back(known.name);
  return names;
}

template <typename Number>
std::optional<Number> number_of(std::string_view text) {
  Number value{};
  const char* end = text.data() + text.size();
  const auto [rest, code] = std::from_chars(text.data(), end, value);
  if (code != std::errc{} || rest != end) return std::nullopt;
  return value;
}

std::optional<std::uint64_t> microseconds_of(std::string_view text) {
  const std::optional<double> seconds = number_of<double>(text);
  if (!seconds || !(*seconds >= 0.0 && *seconds <= kLongestTimeS)) return std::nullopt;
  return static_cast<std::uint64_t>(std::llround(*seconds * kMicrosecondsPerSecond));
}

Error refusal(std::string_view text, std::string_view why) {
  return {ErrorKind::kUsage, fmt::format("--fault {}: {}", file::in_quotes(text), why)};
}

}  // namespace

std::string fault_names() { return file::joined(names()); }

Result<Fault> parse_fault(std::string_view text) {
  const std::size_t at = text.find('@');
  const std::size_t plus = text.find('+', at == std::string_view::npos ? text.size() : at);
  if (plus == std::string_view::npos) {
    return refusal(text, "it takes KIND@BEGIN+DURATION, seconds, like unplugged@3+1");
  }
  const std::string_view name = text.substr(0, at);
  const auto* known = std::find_if(kKinds.begin(), kKinds.end(),
                                   [&](const NamedKind& one) { return one.name == name; });
  if (known == kKinds.end()) {
    const std::string hint = file::suggestion(name, names());
    return refusal(text, fmt::format("no fault is called so{}; known: {}", hint, fault_names()));
  }
  const std::size_t slash = text.find('/', plus);
  const auto begin = microseconds_of(text.substr(at + 1, plus - at - 1));
  const auto duration = microseconds_of(text.substr(plus + 1, slash - plus - 1));
  if (!begin || !duration) {
    return refusal(text, fmt::format("begin and duration are seconds, 0 to {}", kLongestTimeS));
  }
  std::optional<std::uint32_t> every = 1;
  if (slash != std::string_view::npos) every = number_of<std::uint32_t>(text.substr(slash + 1));
  if (!every || *every == 0 || *every > kMostTicksApart) {
    return refusal(
        text, fmt::format("after the / stands every how many ticks, 1 to {}", kMostTicksApart));
  }
  return Fault{known->kind, *begin, *duration, *every};
}

}  // namespace hapticwall::emulator
