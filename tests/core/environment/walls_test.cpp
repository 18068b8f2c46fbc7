#include "core/environment/walls.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "core/encoder.h"
#include "core/tick/energy_ledger.h"

namespace hapticwall {
namespace {

TEST(Wall, PushesWithSpringAndDamperWhileInside) {
  const std::array<WallSettings, 1> wall{WallSettings{0.05, 1000.0, 10.0}};
  const WallContact contact = evaluate_walls(WallSet(wall), 0.052, 0.1);
  EXPECT_TRUE(contact.in_contact);
  EXPECT_NEAR(contact.penetration_m, 0.002, 1e-15);
  EXPECT_NEAR(contact.force_n, 1000.0 * 0.002 + 10.0 * 0.1, 1e-12);
}

TEST(Wall, NeverPulls) {
  const std::array<WallSettings, 1> wall{WallSettings{0.05, 1000.0, 10.0}};
  EXPECT_EQ(evaluate_walls(WallSet(wall), 0.0501, -1.0).force_n, 0.0);
}

TEST(Wall, IsAbsentOutside) {
  const std::array<WallSettings, 1> wall{WallSettings{0.05, 1000.0, 10.0}};
  const WallContact contact = evaluate_walls(WallSet(wall), 0.05, 1.0);
  EXPECT_FALSE(contact.in_contact);
  EXPECT_EQ(contact.force_n, 0.0);
  EXPECT_NEAR(evaluate_walls(WallSet(wall), 0.03, 1.0).penetration_m, -0.02, 1e-15);
}

TEST(Wall, LayersAddUpInWhateverOrderTheyAreNamed) {
  const std::array<WallSettings, 3> walls{WallSettings{0.06, 3000.0, 0.0},
                                          WallSettings{0.05, 1000.0, 0.0},
                                          WallSettings{0.055, 2000.0, 0.0}};
  const WallContact contact = evaluate_walls(WallSet(walls), 0.058, 0.0);
  EXPECT_NEAR(contact.force_n, 1000.0 * 0.008 + 2000.0 * 0.003, 1e-12);
  EXPECT_NEAR(contact.penetration_m, 0.008, 1e-15);
}

TEST(Encoder, CountsToTheNearest) {
  EXPECT_DOUBLE_EQ(quantise(0.0501, 0.254e-3), 197 * 0.254e-3);
  EXPECT_DOUBLE_EQ(quantise(-0.0501, 0.254e-3), -197 * 0.254e-3);
  EXPECT_EQ(quantise(0.0, 0.254e-3), 0.0);
}

TEST(EnergyLedger, AddsItsFourSumsAsDefined) {
  EnergyLedger ledger;
  ledger.add(2.0, 0.0, 0.001, 500.0);  // b = 0.5 N·s/m at 1 kHz
  ledger.add(5.0, 2.0, 0.002, 500.0);
  ledger.add(1.0, 5.0, -0.001, 500.0);
  EXPECT_NEAR(ledger.cv_j, 2e-3 + 10e-3 - 1e-3, 1e-15);
  EXPECT_NEAR(ledger.hold_j, -2e-3 - 6e-3 - 4e-3, 1e-15);
  EXPECT_NEAR(ledger.scv_j, 0.0 + 4e-3 - 5e-3, 1e-15);
  EXPECT_NEAR(ledger.budget_j, -0.5 * (1e-3 + 4e-3 + 1e-3), 1e-15);
}

}  // namespace
}  // namespace hapticwall
