#include "app/table/hand_column.h"

#include <fmt/format.h>

#include "app/table/text_table.h"

namespace hapticwall::table {

std::string hand_column_title(std::uint64_t hands) { return fmt::format("{} hands", hands); }

std::string hand_column_text(const Summary& summary) {
  return fixed(summary.typical_taken_j, 1.0, 3);
}

std::string hand_column_note(std::uint64_t hands) {
  return fmt::format(
      "{}: median energy of 32 hands within 1 % of the one that a search found; let go, wide "
      "bounds, seed 1;\n"
      "  -: no hand took 1e-9 J, which proves nothing; 'hapticwall worst-hand' shows the hand\n",
      hand_column_title(hands));
}

}  // namespace hapticwall::table
