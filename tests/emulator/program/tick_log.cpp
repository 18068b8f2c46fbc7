#include "tests/emulator/program/tick_log.h"

#include <fmt/format.h>

#include <iterator>
#include <string_view>

#include "app/file/text/text.h"

namespace hapticwall::emulator {
namespace {

constexpr std::string_view kHeader =
    "time_us,sequence,plugged,enabled,acknowledged,true_position_m,force_n,y_true_position_m,"
    "y_force_n\n";
constexpr std::size_t kUsualRowBytes = 80;

}  // namespace

TickRow row_of(const device::hid::FirmwareEmulator& device) {
  TickRow row;
  row.time_us = device.now_us();
  row.sequence = device.state().sequence;
  row.plugged = device.is_plugged();
  row.enabled = (device.state().status & device::hid::kStatusEnabled) != 0;
  row.acknowledged = device.state().acknowledged_sequence;
  for (std::size_t axis = 0; axis < device.axes(); ++axis) {
    row.true_position_m.at(axis) = device.truth(axis).position_m;
  }
  row.force_n = device.amplifier_force_n();
  return row;
}

std::string TickLog::text() const {
  std::string text(kHeader);
  text.reserve(text.size() + rows_.size() * kUsualRowBytes);
  for (const TickRow& row : rows_) {
    fmt::format_to(std::back_inserter(text), "{},{},{:d},{:d},{}", row.time_us, row.sequence,
                   row.plugged, row.enabled, row.acknowledged);
    for (std::size_t axis = 0; axis < row.force_n.size(); ++axis) {
      text += ',';
      file::append_number(text, row.true_position_m.at(axis));
      text += ',';
      file::append_number(text, row.force_n.at(axis));
    }
    text += '\n';
  }
  return text;
}

}  // namespace hapticwall::emulator
