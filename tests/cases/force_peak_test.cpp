#include "cases/force_peak.hpp"

#include <gtest/gtest.h>

namespace nilas::cases {
namespace {

const Vec3 kUp(0, 0, 1);

TEST(ForcePeak, OfARectangularPulseLongerThanTheWindowIsThePulse) {
  ForcePeak peak(1.0);
  for (int n = 1; n <= 40; ++n) peak.add(0.1 * n, 0.1, n > 10 && n <= 30 ? Vec3(2 * kUp) : Vec3::Zero().eval());
  EXPECT_NEAR(peak.filtered(), 2, 1e-12);
  EXPECT_GE(peak.filtered_time(), 1.5 - 1e-9);  // its middle: from when the window is full until the pulse ends
  EXPECT_LE(peak.filtered_time(), 2.5 + 1e-9);
  EXPECT_EQ(peak.raw(), 2);
}

TEST(ForcePeak, OfAPulseShorterThanTheWindowIsItsImpulseOverTheWindow) {
  ForcePeak peak(1.0);
  for (int n = 1; n <= 40; ++n) peak.add(0.1 * n, 0.1, n == 20 ? Vec3(5 * kUp) : Vec3::Zero().eval());
  EXPECT_NEAR(peak.filtered(), 0.5, 1e-12);
}

TEST(ForcePeak, CountsTheTimeBeforeTheFirstSampleAsZeroForce) {
  ForcePeak peak(1.0);
  peak.add(0.25, 0.25, 4 * kUp);
  EXPECT_NEAR(peak.filtered(), 1, 1e-12);
}

TEST(ForcePeak, IsExactForUnequalStepsThatStraddleTheWindow) {
  ForcePeak peak(1.0);
  peak.add(0.7, 0.7, 1 * kUp);
  peak.add(1.5, 0.8, 3 * kUp);  // window [0.5, 1.5]: 0.2 of the first, 0.8 of the second
  EXPECT_NEAR(peak.filtered(), 0.2 * 1 + 0.8 * 3, 1e-12);
  peak.add(4.0, 2.5, -1 * kUp);  // one step longer than the window
  EXPECT_NEAR(peak.largest_components().z(), 2.6, 1e-12);
}

TEST(ForcePeak, WithoutAWindowIsTheRawPeak) {
  ForcePeak peak(0);
  peak.add(1, 1, Vec3(3, 0, -4));
  peak.add(2, 1, Vec3(0, 1, 0));
  EXPECT_EQ(peak.filtered(), 5);
  EXPECT_EQ(peak.components(), Vec3(3, 0, -4));
}

TEST(ForcePeak, AveragesVectorsNotMagnitudes) {
  ForcePeak peak(1.0);
  for (int n = 1; n <= 20; ++n) peak.add(0.1 * n, 0.1, (n % 2 ? 1.0 : -1.0) * kUp);
  EXPECT_NEAR(peak.filtered(), 0.1, 1e-12);
  EXPECT_EQ(peak.raw(), 1);
}

}  // namespace
}  // namespace nilas::cases
