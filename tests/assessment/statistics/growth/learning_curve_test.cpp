// Learning curves: the fixture, R's nls on fresh data, curves that are none.
#include "assessment/statistics/growth/learning_curve.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "sim/base/rng.h"
#include "tests/assessment/statistics/growth/numbers_of.h"
#include "tests/assessment/statistics/r_oracle.h"

namespace seldinger::assessment::statistics {
namespace {

using fixtures::number_of;

DataTable attempts(std::vector<double> values) {
  DataTable table;
  table.rows = values.size();
  table.values.push_back({"seconds", std::move(values)});
  return table;
}

const std::vector<double> kFixture{120, 95, 83, 76, 70, 66, 63, 60.5, 58, 56.5};

TEST(LearningCurve, IsThatOfTheFixture) {
  const Answer answer = learning_curve(attempts(kFixture), {});
  ASSERT_TRUE(answer.estimable());
  EXPECT_NEAR(number_of(answer, "power", "a"), 112.942763086, 1e-6 * 112.9);
  EXPECT_NEAR(number_of(answer, "power", "b"), 0.360845261837, 1e-6 * 0.36);
  EXPECT_NEAR(number_of(answer, "power", "c"), 7.06754488176, 1e-6 * 7.07);
  EXPECT_NEAR(number_of(answer, "power", "rss"), 0.41579337067, 1e-6 * 0.416);
  EXPECT_THAT(answer.method, testing::HasSubstr("power"));
  EXPECT_NEAR(answer.estimate.value(), 0.360845261837, 1e-6);
  EXPECT_NEAR(number_of(answer, "half_way_at"), std::pow(2.0, 1.0 / 0.360845261837), 1e-4);
}

TEST(LearningCurve, CurvesAndTheirErrorsAreThoseOfNls) {
  SELDINGER_NEEDS_R();
  std::ostringstream script;
  base::Rng rng(fixtures::r_seed() + 41);
  std::vector<std::vector<double>> times, values;
  for (std::size_t i = 0; i < fixtures::r_sets(); ++i) {
    const bool power = i % 2 == 0;
    const double a = 50.0 + 50.0 * rng.uniform(), b = (power ? 0.6 : 0.15) * (1.0 + rng.uniform()), c = 30.0;
    std::vector<double> t, y;
    for (int k = 1; k <= 25; ++k) {
      if (rng.uniform() < 0.2) continue;  // attempts that were not recorded
      t.push_back(k);
      y.push_back(a * (power ? std::pow(k, -b) : std::exp(-b * k)) + c + rng.normal());
    }
    script.precision(17);
    script << "t <- " << fixtures::r_vector(t) << "; y <- " << fixtures::r_vector(y)
           << "\nfit <- function(...) nls(y ~ a * " << (power ? "t^-b" : "exp(-b * t)")
           << " + c, start = list(a = " << a << ", b = " << b
           << ", c = 30), ...)\n"
           // Gauss's steps, which nls takes unless it is told otherwise, do not always get there.
           << "m <- tryCatch(fit(control = nls.control(tol = 1e-7, minFactor = 1e-12, maxiter = 500)), "
              "error = function(e) fit(algorithm = 'port'))\n";
    for (const char* one : {"a", "b", "c"})
      script << "say('" << one << i << "', coef(m)['" << one << "'])\nsay('se_" << one << i
             << "', summary(m)$coefficients['" << one << "', 2])\n";
    script << "say('rss" << i << "', deviance(m))\nk <- 4; n <- length(y)\nsay('aicc" << i
           << "', AIC(m) - n * (1 + log(2 * pi)) + 2 * k * (k + 1) / (n - k - 1))\n";
    times.push_back(t);
    values.push_back(y);
  }
  const auto r = fixtures::r_values(script.str());
  for (std::size_t i = 0; i < times.size(); ++i) {
    const auto curve = fit_curve(i % 2 == 0 ? CurveKind::power : CurveKind::exponential, times[i], values[i]);
    ASSERT_TRUE(curve.has_value());
    const auto expect = [&](const char* name, double got) {
      const double want = r.at(name + std::to_string(i));
      fixtures::note_difference(got, want);
      EXPECT_LE(std::abs(got - want), 1e-6 * std::abs(want)) << name << i << ": " << got << " for " << want;
    };
    expect("a", curve->a);
    expect("b", curve->b);
    expect("c", curve->c);
    expect("rss", curve->rss);
    expect("aicc", curve->aicc.value());
    expect("se_a", curve->se_a);
    expect("se_b", curve->se_b);
    expect("se_c", curve->se_c);
  }
}

TEST(LearningCurve, ChoosesTheCurveThatMadeTheValues) {
  std::vector<double> power, exponential;
  base::Rng rng(5);
  for (int k = 1; k <= 30; ++k) {
    power.push_back(80.0 * std::pow(k, -0.8) + 20.0 + 0.2 * rng.normal());
    exponential.push_back(80.0 * std::exp(-0.2 * k) + 20.0 + 0.2 * rng.normal());
  }
  EXPECT_THAT(learning_curve(attempts(power), {}).method, testing::HasSubstr("the power curve"));
  const Answer answer = learning_curve(attempts(exponential), {});
  EXPECT_THAT(answer.method, testing::HasSubstr("the exponential curve"));
  EXPECT_NEAR(answer.estimate.value(), 0.2, 0.01);
  EXPECT_NEAR(number_of(answer, "plateau"), 20.0, 0.5);
  EXPECT_NEAR(number_of(answer, "half_way_at"), 1.0 + std::log(2.0) / 0.2, 0.3);
}

// Of a long course, too, that levels off within a few attempts: before, the rate was at its bound, and there was no
// interval.
TEST(LearningCurve, FindsAPlateauThatIsReachedEarly) {
  for (const int last : {18, 50}) {
    std::vector<double> values;
    for (int t = 1; t <= last; ++t) values.push_back(3.0 + 12.0 * std::exp(-0.5 * t) + 0.01 * std::cos(9.0 * t));
    const Answer answer = learning_curve(attempts(values), {});
    ASSERT_TRUE(answer.ci95.has_value()) << last;
    EXPECT_NEAR(answer.estimate.value(), 0.5, 0.01) << last;
    EXPECT_NEAR(number_of(answer, "plateau"), 3.0, 0.01) << last;
    EXPECT_LT(number_of(answer, "plateau_low"), 3.0) << last;
    EXPECT_GT(number_of(answer, "plateau_high"), 3.0) << last;
  }
}

// Ceilings that were planted lie within their intervals as often as is said.
TEST(LearningCurve, PlateausLieWithinTheirIntervals) {
  base::Rng rng(11);
  constexpr int kSets = 400;
  int covered = 0, sets = 0;
  for (int set = 0; set < kSets; ++set) {
    const double rate = 0.15 + 0.3 * rng.uniform(), plateau = 2.0 + 8.0 * rng.uniform();
    std::vector<double> values;
    for (int t = 1; t <= 30; ++t) values.push_back(plateau + 15.0 * std::exp(-rate * t) + 0.8 * rng.normal());
    // The curve that made them: what the choice of a curve adds is not in the interval.
    const Answer answer = learning_curve(attempts(values), {});
    if (answer.method.find("exponential") == std::string::npos) continue;
    ++sets;
    covered += number_of(answer, "plateau_low") <= plateau && plateau <= number_of(answer, "plateau_high") ? 1 : 0;
  }
  ASSERT_GT(sets, 200);
  EXPECT_NEAR(covered / static_cast<double>(sets), 0.95, 0.04);
}

TEST(LearningCurve, SaysWhereNothingIsLearned) {
  std::vector<double> rising, scores;
  for (int k = 1; k <= 12; ++k) {
    rising.push_back(10.0 + 0.3 * k * k + (k % 2));
    scores.push_back(90.0 - 60.0 * std::pow(k, -0.7) + 0.3 * (k % 3));
  }
  EXPECT_THAT(learning_curve(attempts(rising), {}).notes, testing::Contains("No learning detected."));
  EXPECT_THAT(learning_curve(attempts(scores), {}).notes, testing::Contains("No learning detected."));
  const Answer better = learning_curve(attempts(scores), {true, 0.9});
  EXPECT_THAT(better.notes, testing::Not(testing::Contains("No learning detected.")));
  EXPECT_NEAR(number_of(better, "plateau"), 90.0, 3.0);
}

// A first attempt unlike the others, which lie about 3: the steepest curve that is searched fits best, and when it
// would have arrived is nothing that was seen.
TEST(LearningCurve, TellsNoCourseWhereOnlyTheFirstAttemptDiffers) {
  std::vector<double> values{15.0};
  for (int k = 2; k <= 18; ++k) values.push_back(3.0 + 0.1 * std::cos(9.0 * k));
  const Answer answer = learning_curve(attempts(values), {});
  ASSERT_TRUE(answer.estimable());
  EXPECT_THAT(answer.notes, testing::Contains(kTooSudden));
  for (const Named& one : answer.more) {
    EXPECT_NE(one.name, "half_way_at");
    EXPECT_NE(one.name, "plateau_reached_at");
  }
  EXPECT_NEAR(number_of(answer, "plateau"), 3.0, 0.2);
  // A third of the way is left at the second attempt: that is a course.
  values.clear();
  for (int k = 1; k <= 18; ++k) values.push_back(3.0 + 12.0 * std::exp(-1.1 * (k - 1)) + 0.01 * std::cos(9.0 * k));
  EXPECT_THAT(learning_curve(attempts(values), {}).notes, testing::Not(testing::Contains(kTooSudden)));
  EXPECT_GT(number_of(learning_curve(attempts(values), {}), "plateau_reached_at"), 2.0);
}

TEST(LearningCurve, NeedsFiveAttempts) {
  EXPECT_EQ(learning_curve(attempts({9, 7, 6, 5.5}), {}).reason, "too_few");
  EXPECT_EQ(learning_curve(attempts({}), {}).reason, "no_data");
  EXPECT_EQ(learning_curve(attempts({4, 4, 4, 4, 4, 4}), {}).reason, "no_variation");
  EXPECT_TRUE(learning_curve(attempts({9, 7, 6, 5.5, 5.2}), {}).estimable());
}

TEST(LearningCurve, IsOfEachPersonAndInTheOrderOfX) {
  DataTable table;
  table.values.push_back({"seconds", {}});
  for (int person = 0; person < 3; ++person)
    for (std::size_t k = person == 2 ? 7 : 0; k < kFixture.size(); ++k) {  // the third has three attempts
      const std::size_t at = kFixture.size() - 1 - k;
      table.values.front().values.push_back(kFixture[at] * (person + 1));
      table.x.push_back(static_cast<double>(at + 1));
      table.subject.push_back(std::string(1, static_cast<char>('a' + person)));
      ++table.rows;
    }
  const Answer answer = learning_curve(table, {});
  ASSERT_TRUE(answer.estimable());
  EXPECT_EQ(answer.n, 2u);
  EXPECT_NEAR(number_of(answer, "b", "b"), 0.360845261837, 1e-6);
  EXPECT_NEAR(number_of(answer, "b", "a"), 2 * 112.942763086, 1e-3);
  EXPECT_NEAR(answer.estimate.value(), 0.360845261837, 1e-6);
  EXPECT_EQ(number_of(answer, "persons_learning"), 2.0);
  EXPECT_THAT(answer.notes, testing::Contains(testing::HasSubstr("1 persons")));
}

}  // namespace
}  // namespace seldinger::assessment::statistics
