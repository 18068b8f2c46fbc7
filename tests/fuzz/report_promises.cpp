#include "tests/fuzz/report_promises.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hapticwall::fuzz {
namespace {

using device::hid::Refusal;

constexpr std::size_t kBytes = 64;
constexpr std::size_t kCrcAt = 62;
constexpr std::size_t kProtocolAt = 1;
constexpr unsigned kMajor = 1;
constexpr unsigned kMinor = 0;

// Bit by bit, as the page has it.
unsigned crc_of(Bytes bytes) {
  constexpr unsigned kPolynomial = 0x1021;
  constexpr unsigned kTop = 0x8000;
  unsigned crc = 0xFFFF;
  for (const unsigned byte : bytes) {
    for (unsigned bit = 0x80; bit != 0; bit >>= 1U) {
      const bool one = ((crc & kTop) != 0) != ((byte & bit) != 0);
      crc = (crc << 1U & 0xFFFFU) ^ (one ? kPolynomial : 0U);
    }
  }
  return crc;
}

void seal(std::vector<std::uint8_t>& bytes) {
  const unsigned crc = crc_of(Bytes(bytes).first(kCrcAt));
  bytes[kCrcAt] = static_cast<std::uint8_t>(crc & 0xFFU);
  bytes[kCrcAt + 1] = static_cast<std::uint8_t>(crc >> 8U);
}

bool has_reserved_bits(Bytes report, const Layout& layout) {
  const Bytes reserved = report.subspan(layout.reserved_from, kCrcAt - layout.reserved_from);
  return (report[layout.flags.at] & layout.flags.mask) != 0 ||
         std::any_of(reserved.begin(), reserved.end(), [](unsigned byte) { return byte != 0; });
}

}  // namespace

std::vector<std::uint8_t> repaired(Bytes input, const Layout& layout) {
  if (input.empty()) return {};
  const unsigned repairs = input.front();
  std::vector<std::uint8_t> bytes(input.begin() + 1, input.end());
  if ((repairs & kRepairLength) != 0) bytes.resize(kBytes);
  if ((repairs & kRepairId) != 0 && !bytes.empty()) bytes.front() = layout.id;
  if ((repairs & kRepairCrc) != 0 && bytes.size() >= kBytes) seal(bytes);
  return bytes;
}

std::optional<Refusal> void_because(Bytes report, const Layout& layout) {
  if (report.size() != kBytes) return Refusal::kLength;
  if (report.front() != layout.id) return Refusal::kId;
  if (crc_of(report.first(kCrcAt)) != u16_at(report, kCrcAt)) return Refusal::kCrc;
  bool newer = false;
  if (layout.has_protocol) {
    const unsigned protocol = report[kProtocolAt];
    if (protocol >> 4U != kMajor) return Refusal::kProtocol;
    newer = (protocol & 0x0FU) > kMinor;
  }
  if (!newer && has_reserved_bits(report, layout)) return Refusal::kReserved;
  return std::nullopt;
}

std::vector<std::uint8_t> without_reserved(Bytes report, const Layout& layout) {
  std::vector<std::uint8_t> bytes(report.begin(), report.end());
  bytes[layout.flags.at] &= static_cast<std::uint8_t>(~layout.flags.mask);
  std::fill(bytes.begin() + static_cast<std::ptrdiff_t>(layout.reserved_from), bytes.end(),
            std::uint8_t{0});
  seal(bytes);
  return bytes;
}

std::uint16_t u16_at(Bytes bytes, std::size_t at) {
  return static_cast<std::uint16_t>(bytes[at] + bytes[at + 1] * 256U);
}

std::int16_t i16_at(Bytes bytes, std::size_t at) {
  return static_cast<std::int16_t>(u16_at(bytes, at));
}

std::int32_t i32_at(Bytes bytes, std::size_t at) {
  const std::uint32_t upper = u16_at(bytes, at + 2);
  return static_cast<std::int32_t>(u16_at(bytes, at) + upper * 65536U);
}

bool is_force_mn(std::int16_t force_mn) {
  return force_mn != std::numeric_limits<std::int16_t>::min();
}

bool is_force_n(double force_n) { return std::abs(force_n) <= device::hid::kMaxForceN; }

}  // namespace hapticwall::fuzz
