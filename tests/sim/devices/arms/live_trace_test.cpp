// Tests of sim/devices/arms/live_trace.
#include "sim/devices/arms/live_trace.h"

#include <gtest/gtest.h>

#include <limits>

namespace seldinger::devices {
namespace {

TEST(LiveTrace, KeepsThePeakOfAMillisecond) {
  LiveTrace trace;
  for (int ms = 0; ms < 100; ++ms) trace.add(ms == 42 ? 3.0 : ms == 47 ? -1.0 : 0.5, 0.001);
  EXPECT_FALSE(trace.bin(0).filled) << "a new one has begun";
  EXPECT_EQ(trace.bin(6).most, 3.0F);
  EXPECT_EQ(trace.bin(6).least, -1.0F);
  for (const std::size_t other : {1U, 5U, 7U, 10U}) {
    EXPECT_EQ(trace.bin(other).most, 0.5F);
    EXPECT_EQ(trace.bin(other).least, 0.5F);
  }
  EXPECT_FALSE(trace.bin(11).filled) << "before it began";
}

TEST(LiveTrace, OldBinsAreForgottenAndGapsStayGaps) {
  LiveTrace trace;
  trace.add(9.0, kTraceBinS);
  for (std::size_t i = 0; i < kTraceBins - 1; ++i) trace.add(1.0, kTraceBinS);
  for (std::size_t i = 1; i < kTraceBins; ++i) ASSERT_EQ(trace.bin(i).most, 1.0F) << i;
  trace.add(2.0, 0.031);  // a stall: three bins, of which only the first was told of
  EXPECT_EQ(trace.bin(3).most, 2.0F);
  EXPECT_FALSE(trace.bin(1).filled);
  EXPECT_FALSE(trace.bin(2).filled);
  trace.add(std::numeric_limits<double>::quiet_NaN(), kTraceBinS);
  EXPECT_FALSE(trace.bin(1).filled) << "no number is no zero";
  trace.add(1.0, 1e9);
  for (std::size_t i = 0; i < kTraceBins; ++i) ASSERT_FALSE(trace.bin(i).filled) << i;
  trace.add(1.0, -1.0);
  EXPECT_FALSE(trace.bin(0).filled);
}

}  // namespace
}  // namespace seldinger::devices
