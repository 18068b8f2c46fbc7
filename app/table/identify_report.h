// The result of `hapticwall identify` in words, as JSON, and as a device file.
#pragma once

#include <string>

#include "app/file/scene/device_file.h"
#include "core/study/identify/identify.h"

namespace hapticwall::table {

// The experiment behind a result.
struct IdentifiedBy {
  std::string device;
  std::string date;            // UTC
  double force_limit_n = 0.0;  // force limit of the experiment
  double seconds = 0.0;        // duration of the strokes
  std::uint32_t turns = 0;
  std::uint64_t missed_ticks = 0;
};

[[nodiscard]] std::string identify_text(const IdentifiedBy& by,
                                        const identify::Identification& found);
[[nodiscard]] std::string identify_json(const IdentifiedBy& by,
                                        const identify::Identification& found);
// Reason why a model that does not fit gives no device file.
[[nodiscard]] std::string misfit_text(const IdentifiedBy& by);
// Message about a device file that was written.
[[nodiscard]] std::string written_text(const std::string& path);
// One line with date and intervals, for a device file.
[[nodiscard]] std::string identified_line(const IdentifiedBy& by,
                                          const identify::Identification& found);
// `device` with the numbers that were found.
[[nodiscard]] file::DeviceDescription identified_device(file::DeviceDescription device,
                                                        const IdentifiedBy& by,
                                                        const identify::Identification& found);

}  // namespace hapticwall::table
