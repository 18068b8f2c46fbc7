// The column of a search for a hand that takes energy, in tables of other subjects.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/summary.h"

namespace hapticwall::table {

// "10000 hands" above the typical energy.
[[nodiscard]] std::string hand_column_title(std::uint64_t hands);
inline constexpr std::string_view kHandColumnUnit = "J typical";

// "7.835", or "-" if no hand took energy.
[[nodiscard]] std::string hand_column_text(const Summary& summary);

// Lines below the table: the meaning of the column and its conditions.
[[nodiscard]] std::string hand_column_note(std::uint64_t hands);

}  // namespace hapticwall::table
