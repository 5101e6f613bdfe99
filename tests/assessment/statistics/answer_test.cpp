// An answer shows numbers or a reason, never NaN.
#include "assessment/statistics/answer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "assessment/statistics/reasons.h"

namespace seldinger::assessment::statistics {
namespace {

TEST(Answer, LosesWhatIsNoNumberAndSaysSo) {
  Answer answer;
  answer.statistic = 2.0;
  answer.p_value = 1.0 + 1e-15;
  answer.estimate = std::nan("");
  answer.ci95 = Interval{0.0, std::numeric_limits<double>::infinity()};
  answer.rows = {{"a – b", {{"z", std::nan("")}, {"p", 0.5}}}};
  const Answer got = settled(answer);
  EXPECT_TRUE(got.estimable());
  EXPECT_FALSE(got.estimate || got.ci95);
  EXPECT_EQ(got.p_value, 1.0);
  ASSERT_EQ(got.rows[0].values.size(), 1U);
  EXPECT_EQ(got.notes.size(), 1U);
}

TEST(Answer, OfNothingIsNotEstimable) {
  Answer answer;
  answer.test = "welch";
  answer.p_value = std::nan("");
  const Answer got = settled(answer);
  EXPECT_EQ(got.reason, "no_finite_answer");
  EXPECT_EQ(got.test, "welch");
}

TEST(Answer, EveryReasonHasWords) {
  for (const Reason& one : reasons()) EXPECT_NE(find_reason(one.code)->words[0], '\0');
  EXPECT_EQ(find_reason("no such"), nullptr);
}

}  // namespace
}  // namespace seldinger::assessment::statistics
