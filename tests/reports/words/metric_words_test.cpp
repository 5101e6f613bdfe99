// How values are written: null is never 0, units stand beside numbers, digits fit the unit.
#include "reports/words/metric_words.h"

#include <gtest/gtest.h>

#include <limits>

#include "assessment/registry.h"
#include "reports/words/attempt_words.h"

namespace seldinger::reports {
namespace {

std::string shown(double value, const std::string& unit, const std::string& id = "x") {
  return value_text({id, 1, value, unit, ""});
}

TEST(Values, NullIsADashWithItsReasonAndNeverZero) {
  const casedb::MetricValue metric{"hit", 1, std::nullopt, "bool", "no_endpoint"};
  EXPECT_EQ(value_text(metric), "—");
  EXPECT_EQ(reason_text(metric), "the needle was neither fired nor declared to be on target");
  EXPECT_EQ(reason_text({"x", 1, std::nullopt, "mm", ""}), "no reason was stored");
}

TEST(Values, ANumberThatIsNotFiniteIsNotShown) {
  for (const double value : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                             -std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(shown(value, "mm"), "—");
    EXPECT_EQ(shown(value, "bool", "hit"), "—");
    EXPECT_EQ(reason_text({"x", 1, value, "mm", ""}), "the stored number is not finite");
  }
}

TEST(Values, CarryTheirUnitAndSensibleDigits) {
  EXPECT_EQ(shown(2.34, "mm"), "2.3 mm");
  EXPECT_EQ(shown(31.25, "s"), "31.2 s");
  EXPECT_EQ(shown(0.424, "share"), "42 %");
  EXPECT_EQ(shown(3.0, "count"), "3");
  EXPECT_EQ(shown(12.345, "deg"), "12.3°");
  EXPECT_EQ(shown(1.0, "bool", "hit"), "Yes");
  EXPECT_EQ(shown(0.0, "bool", "hit"), "No");
  EXPECT_EQ(reason_text({"x", 1, 0.0, "mm", ""}), "");
}

TEST(Values, AMinusIsAMinusAndNoneStandsBeforeARoundedZero) {
  EXPECT_EQ(shown(-1.26, "mm"), "−1.3 mm");
  EXPECT_EQ(shown(-0.04, "mm"), "0.0 mm");
  EXPECT_EQ(shown(-0.0, "mm"), "0.0 mm");
}

TEST(Values, TheLargestNumberFits) {
  EXPECT_EQ(number_text(std::numeric_limits<double>::max(), 1).size(), 311U);
}

TEST(Times, AreUtcAndSaySo) {
  EXPECT_EQ(utc_text(0), "1970-01-01 00:00 UTC");
  EXPECT_EQ(utc_text(1772373909000000), "2026-03-01 14:05 UTC");
  EXPECT_EQ(utc_machine_text(1772373909999999), "2026-03-01T14:05:09Z");
  EXPECT_EQ(told_text(1709164800000000), "2024-02-29") << "cut to its day";
  EXPECT_EQ(told_machine_text(1709164800000000), "2024-02-29");
  EXPECT_EQ(told_text(1709164800000000 + 61'000'000), "2024-02-29 00:01 UTC");
  EXPECT_EQ(utc_text(1709164800000000), "2024-02-29 00:00 UTC");  // a leap day
  EXPECT_EQ(utc_machine_text(-1), "1969-12-31T23:59:59Z");
}

TEST(Times, AnInterruptionIsToldInTheUnitOneWouldSay) {
  casedb::AttemptHead attempt;
  EXPECT_EQ(away_text(attempt), "");
  for (const auto& [away_s, words] : {std::pair{0.0, "0 s"},
                                      {119.0, "119 s"},
                                      {754.0, "13 min"},
                                      {5.0 * 3600.0, "5 hours"},
                                      {3.2 * 86400.0, "3 days"}}) {
    attempt.away_s = away_s;
    EXPECT_EQ(away_text(attempt), std::string("Interrupted, and resumed after ") + words + ".");
  }
}

TEST(Words, EveryRegisteredMetricHasALabelAndAPlace) {
  for (const assessment::MetricInfo& info : assessment::registry()) {
    EXPECT_EQ(metric_label(info.id), info.label);
    EXPECT_NE(metric_group(info.id), "Other") << info.id;
    EXPECT_STRNE(info.definition, "") << info.id;
  }
}

TEST(Words, AnUnknownMetricIsShownByItsIdUnderOther) {
  EXPECT_EQ(metric_label("new_thing"), "new thing");
  EXPECT_EQ(metric_group("new_thing"), "Other");
  EXPECT_EQ(metric_groups().back(), "Other");
}

}  // namespace
}  // namespace seldinger::reports
