// What the codec of a report promises (device/link/report.h), against docs/hid-protocol.md read a
// second time: layout, CRC and values are worked out here without the codec.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "device/link/report.h"
#include "tests/fuzz/target.h"

namespace hapticwall::fuzz {

// The first byte of an input says what is put right before the rest is decoded, so that a search
// gets past the CRC.
enum Repair : std::uint8_t {
  kRepairLength = 1,  // cut off or filled up with zeros
  kRepairId = 2,
  kRepairCrc = 4,
};

// Bits of a byte that protocol 1.0 gives no meaning to.
struct ReservedBits {
  std::size_t at;
  std::uint8_t mask;
};

struct Layout {
  std::uint8_t id;
  bool has_protocol;
  ReservedBits flags;
  std::size_t reserved_from;  // up to the CRC
};

[[nodiscard]] std::vector<std::uint8_t> repaired(Bytes input, const Layout& layout);

// Why the report is void, whatever its values are; nothing where only they can make it so.
[[nodiscard]] std::optional<device::hid::Refusal> void_because(Bytes report, const Layout& layout);

// The report with all that is reserved at zero, and the CRC that belongs to it.
[[nodiscard]] std::vector<std::uint8_t> without_reserved(Bytes report, const Layout& layout);

// Little endian. Precondition: they are there.
[[nodiscard]] std::uint16_t u16_at(Bytes bytes, std::size_t at);
[[nodiscard]] std::int16_t i16_at(Bytes bytes, std::size_t at);
[[nodiscard]] std::int32_t i32_at(Bytes bytes, std::size_t at);

// A force that one of the other sign answers: not -32768 mN.
[[nodiscard]] bool is_force_mn(std::int16_t force_mn);
[[nodiscard]] bool is_force_n(double force_n);

// One kind of report: its layout, its codec, and whether its bytes and its values are as they
// should be.
template <typename Report>
struct ReportPromises {
  Layout layout;
  device::hid::Decoded<Report> (*decode)(Bytes);
  device::hid::ReportBytes (*encode)(const Report&);
  bool (*bytes_make_sense)(Bytes);  // precondition: void_because() says nothing
  bool (*values_make_sense)(const Report&);
  bool (*has_ignored_values)(Bytes) = nullptr;  // values that are not encoded again
};

// Throws BrokenPromise.
template <typename Report>
Outcome check_report(Bytes input, const ReportPromises<Report>& promises) {
  using device::hid::Refusal;
  const std::vector<std::uint8_t> bytes = repaired(input, promises.layout);
  const std::optional<Refusal> reason = void_because(bytes, promises.layout);
  const bool sensible = !reason && promises.bytes_make_sense(bytes);
  const device::hid::Decoded<Report> decoded = promises.decode(bytes);
  require((decoded.report() == nullptr) != (decoded.refusal() == nullptr),
          "a report is taken or refused");
  if (const Refusal* refusal = decoded.refusal()) {
    require(!sensible, "a report with nothing wrong is taken");
    require(*refusal == reason.value_or(Refusal::kValue), "a refusal says what is wrong first");
    return Outcome::kRefused;
  }
  require(!reason, "a void report is refused");
  require(promises.values_make_sense(*decoded.report()), "values are in their ranges");
  const auto encoded = promises.encode(*decoded.report());
  const std::vector<std::uint8_t> known = without_reserved(bytes, promises.layout);
  const bool whole = promises.has_ignored_values == nullptr || !promises.has_ignored_values(bytes);
  require(!whole || std::vector<std::uint8_t>(encoded.begin(), encoded.end()) == known,
          "what was taken is encoded to the same bytes");
  require(sensible, "a report whose values make no sense is refused");
  return Outcome::kTaken;
}

}  // namespace hapticwall::fuzz
