#include "sim/devices/hands/even_intent.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace seldinger::devices {
namespace {

constexpr double kTickS = 0.001;

TEST(EvenIntent, GivesOutEvenlyWhatWasTold) {
  EvenIntent even;
  HandIntent sum;
  sum.advance_mm = 5.0;
  sum.slide_lps_mm = {10.0, 0.0, -20.0};
  even.tell(sum, 0.05);
  double gone_mm = 0.0, most_mm = 0.0, least_mm = 1.0;
  for (int tick = 0; tick < 50; ++tick) {
    const HandIntent given = even.advance(kTickS);
    gone_mm += given.advance_mm;
    most_mm = std::max(most_mm, given.advance_mm);
    least_mm = std::min(least_mm, given.advance_mm);
  }
  EXPECT_NEAR(gone_mm, 5.0, 1e-12);
  EXPECT_NEAR(most_mm, 0.1, 1e-9);
  EXPECT_NEAR(least_mm, 0.1, 1e-9);
  EXPECT_EQ(even.advance(kTickS).advance_mm, 0.0);
}

// However tellings and ticks fall together, what is given is what was told.
// Whichever device says it first.
TEST(HandIntent, DevicesOfOneHandAddUpAndALevelHoldsWhereAnyHasIt) {
  HandIntent fires, slides;
  fires.fire = true;
  fires.advance_mm = 1.0;
  slides.slide_lps_mm = {0.0, 3.0, 0.0};
  slides.advance_mm = 0.5;
  slides.swaps = 1;
  slides.keep_tilt = slides.in_space = true;
  for (const bool first : {false, true}) {
    HandIntent both = first ? fires : slides;
    join(first ? slides : fires, both);
    EXPECT_TRUE(both.fire);
    EXPECT_TRUE(both.keep_tilt);
    EXPECT_TRUE(both.in_space) << "as the longer slide is meant";
    EXPECT_EQ(both.slide_lps_mm.y, 3.0);
    EXPECT_EQ(both.advance_mm, 1.5);
    EXPECT_EQ(both.swaps, 1U);
  }
  HandIntent still, dragged;
  still.in_space = true;  // a cap at rest
  dragged.slide_lps_mm = {1.0, 0.0, 0.0};
  join(still, dragged);
  EXPECT_FALSE(dragged.in_space);
}

TEST(EvenIntent, LosesNothingAndGivesNothingTwice) {
  EvenIntent even;
  HandIntent sum, given;
  for (int frame = 0; frame < 100; ++frame) {
    sum.advance_mm += 0.1 * (frame % 7) - 0.2;
    sum.turn_own_rad.x += 0.01;
    if (frame % 10 == 3) ++sum.swaps;
    sum.fire = frame % 2 == 1;
    even.tell(sum, 0.001 * (frame % 23));
    for (int tick = 0; tick < frame % 19; ++tick) add(even.advance(kTickS), given);
  }
  for (int tick = 0; tick < 200; ++tick) add(even.advance(kTickS), given);
  EXPECT_NEAR(given.advance_mm, sum.advance_mm, 1e-12);
  EXPECT_NEAR(given.turn_own_rad.x, sum.turn_own_rad.x, 1e-12);
  EXPECT_EQ(given.swaps, sum.swaps);
  EXPECT_EQ(given.fire, sum.fire);
}

TEST(EvenIntent, ButtonsActInTheNextTickAndOnce) {
  EvenIntent even;
  HandIntent sum;
  sum.swaps = 1;
  sum.fire = true;
  even.tell(sum, 0.05);
  HandIntent given = even.advance(kTickS);
  EXPECT_EQ(given.swaps, 1U);
  EXPECT_TRUE(given.fire);
  given = even.advance(kTickS);
  EXPECT_EQ(given.swaps, 0U);
  EXPECT_TRUE(given.fire) << "it is still held";
}

// A window that stood for a second does not make the hand crawl for one.
TEST(EvenIntent, AfterAPauseItTakesATenthOfASecond) {
  EvenIntent even;
  HandIntent sum;
  sum.advance_mm = 1.0;
  even.tell(sum, 1.0);
  double gone_mm = 0.0;
  for (int tick = 0; tick < 100; ++tick) gone_mm += even.advance(kTickS).advance_mm;
  EXPECT_NEAR(gone_mm, 1.0, 1e-12);
}

}  // namespace
}  // namespace seldinger::devices
