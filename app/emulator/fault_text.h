// Faults as people write them: KIND@BEGIN+DURATION, seconds since the start, and /EVERY for every
// so many ticks only ("unplugged@3+1", "bad-crc@1+2/10").
#pragma once

#include <string>
#include <string_view>

#include "core/result.h"
#include "device/emulator/fault_script.h"

namespace hapticwall::emulator {

// The words of all kinds, joined by commas.
[[nodiscard]] std::string fault_names();

// A usage error names the option, the text, and what would be right.
[[nodiscard]] Result<device::hid::Fault> parse_fault(std::string_view text);

}  // namespace hapticwall::emulator
