#include "app/table/order.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace hapticwall::table {
namespace {

using Cells = std::vector<std::string>;

std::vector<std::size_t> order_of(const Cells& cells, bool descending) {
  Sheet sheet;
  for (const std::string& cell : cells) sheet.rows.push_back({"another", cell});
  return ordered(sheet, 1, descending);
}

Cells in_order(const Cells& cells, bool descending) {
  Cells sorted;
  for (const std::size_t i : order_of(cells, descending)) sorted.push_back(cells[i]);
  return sorted;
}

TEST(Order, NumbersAreNumbersWithAnyMark) {
  EXPECT_EQ(in_order({"135.38", "9.00 *", "1.2e-09", "-3.5 +"}, false),
            (Cells{"-3.5 +", "1.2e-09", "9.00 *", "135.38"}));
  EXPECT_EQ(in_order({"11 !", "0  ", "3 !"}, true), (Cells{"11 !", "3 !", "0  "}));
}

TEST(Order, MissingValuesComeLastInEitherDirection) {
  EXPECT_EQ(in_order({"-", "2.0", "-  ", "1.0"}, false), (Cells{"1.0", "2.0", "-", "-  "}));
  EXPECT_EQ(in_order({"-", "2.0", "-  ", "1.0"}, true), (Cells{"2.0", "1.0", "-", "-  "}));
}

TEST(Order, VerdictsRankFromGoodToBad) {
  EXPECT_EQ(in_order({"diverged at tick 12 !", "oscillating", "settled !"}, false),
            (Cells{"settled !", "oscillating", "diverged at tick 12 !"}));
}

TEST(Order, WordsAreSortedAndEqualRowsStay) {
  EXPECT_EQ(in_order({"none", "half-sample", "energy-bounding"}, false),
            (Cells{"energy-bounding", "half-sample", "none"}));
  EXPECT_EQ(order_of({"1.0", "2.0", "1.00", "2.0"}, true), (std::vector<std::size_t>{1, 3, 0, 2}));
}

}  // namespace
}  // namespace hapticwall::table
