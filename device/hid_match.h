// Which of the listed devices a session is for.
#pragma once

#include <optional>
#include <vector>

#include "device/hid_port.h"
#include "device/link_options.h"

namespace hapticwall::device::hid {

// Whether a listing is what the options ask for. Realtime-safe: no.
[[nodiscard]] bool fits(const Listing& listing, const ImpulseEngineOptions& options);

// The first one that fits. After a loss (`known` is what the session had before) the same device
// and no other, wherever it is plugged in now; where it has no serial number, the same path is
// preferred, and is required if the options name it. Realtime-safe: no.
[[nodiscard]] std::optional<Listing> choose(const std::vector<Listing>& listings,
                                            const ImpulseEngineOptions& options,
                                            const std::optional<Listing>& known);

}  // namespace hapticwall::device::hid
