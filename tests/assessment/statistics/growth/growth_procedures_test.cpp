// Every row of the shelf's table, with whatever it is given: numbers or a reason, nothing else.
#include "assessment/statistics/growth/growth_procedures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <string>

#include "assessment/statistics/reasons.h"
#include "sim/base/rng.h"

namespace seldinger::assessment::statistics {
namespace {

std::size_t sweeps() {
  const char* asked = std::getenv("SELDINGER_SWEEPS");
  return asked != nullptr ? std::strtoull(asked, nullptr, 10) : 2000;
}

double odd_value(base::Rng& rng, std::uint64_t kind) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  if (rng.uniform() < 0.1) return kNan;
  switch (kind % 8) {
    case 0:
      return 7.0;
    case 1:
      return static_cast<double>(rng.bits() % 2);
    case 2:
      return static_cast<double>(rng.bits() % 4);
    case 3:
      return rng.normal();
    case 4:
      return (rng.bits() % 2 == 0 ? 1.0 : -1.0) * 1e300;
    case 5:
      return 1e-320;
    case 6:
      return static_cast<double>(rng.bits() % 3) * 1e300 + rng.normal();
    default:
      return 1e9 + static_cast<double>(rng.bits() % 3) * 1e-6;
  }
}

std::vector<std::string> odd_labels(base::Rng& rng, std::size_t rows, std::uint64_t kinds) {
  std::vector<std::string> labels;
  for (std::size_t i = 0; i < rows; ++i)
    labels.push_back(rng.uniform() < 0.05 ? "" : std::string(1, static_cast<char>('a' + rng.bits() % kinds)));
  return labels;
}

// `rows` of them; 31 and more now and then, so that what asks for 30 persons is asked, too.
DataTable odd_table(base::Rng& rng, const Needs& needs) {
  DataTable table;
  table.rows = rng.uniform() < 0.1 ? 31 + rng.bits() % 30 : rng.bits() % 9;
  const std::size_t columns = needs.least_values + rng.bits() % 5;
  const std::uint64_t kind = rng.bits();
  for (std::size_t c = 0; c < std::min(columns, needs.most_values); ++c) {
    table.values.push_back({"v" + std::to_string(c), {}});
    for (std::size_t i = 0; i < table.rows; ++i) table.values.back().values.push_back(odd_value(rng, kind));
  }
  const std::uint64_t x_kind = rng.bits();
  if (needs.x || rng.uniform() < 0.6)
    for (std::size_t i = 0; i < table.rows; ++i) table.x.push_back(odd_value(rng, x_kind));
  if (needs.group || rng.uniform() < 0.4) table.group = odd_labels(rng, table.rows, 1 + rng.bits() % 4);
  if (needs.subject || rng.uniform() < 0.7)
    table.subject = odd_labels(rng, table.rows, table.rows > 30 && rng.uniform() < 0.5 ? 40 : 1 + rng.bits() % 5);
  if (needs.rater || rng.uniform() < 0.4) table.rater = odd_labels(rng, table.rows, 1 + rng.bits() % 3);
  return table;
}

ProcedureOptions odd_options(base::Rng& rng, const Procedure& procedure) {
  static const char* const kTexts[] = {"0.05", "0.3", "1",     "0",      "-2",        "nan",   "inf",   "",
                                       "yes",  "no",  "lower", "higher", "intercept", "slope", "1e300", "25"};
  std::map<std::string, std::string> values;
  for (const ProcedureOption& option : procedure.options)
    if (rng.uniform() < 0.15) values[option.name] = kTexts[rng.bits() % std::size(kTexts)];
  return ProcedureOptions(values);
}

void expect_finite(const std::vector<Named>& values) {
  for (const Named& one : values) EXPECT_TRUE(std::isfinite(one.value)) << one.name;
}

void expect_sound(const Answer& answer) {
  EXPECT_FALSE(answer.test.empty());
  if (!answer.estimable()) {
    EXPECT_NE(find_reason(answer.reason.c_str()), nullptr) << answer.reason;
    EXPECT_FALSE(answer.estimate.has_value() || answer.p_value.has_value() || answer.statistic.has_value());
    return;
  }
  EXPECT_FALSE(answer.method.empty());
  EXPECT_TRUE(std::isfinite(answer.statistic.value_or(0.0)) && std::isfinite(answer.estimate.value_or(0.0)));
  const Interval interval = answer.ci95.value_or(Interval{});
  EXPECT_TRUE(std::isfinite(interval.low) && interval.low <= interval.high && std::isfinite(interval.high));
  EXPECT_TRUE(answer.p_value.value_or(0.5) >= 0.0 && answer.p_value.value_or(0.5) <= 1.0);
  for (const double df : answer.df) EXPECT_TRUE(std::isfinite(df));
  expect_finite(answer.more);
  for (const Row& row : answer.rows) expect_finite(row.values);
}

TEST(GrowthProcedures, AnswerOddValuesWithNumbersOrAReason) {
  for (const Procedure& procedure : growth_procedures()) {
    std::size_t answered = 0;
    for (std::size_t i = 0; i < sweeps(); ++i) {
      base::Rng rng(i);
      const DataTable table = odd_table(rng, procedure.needs);
      const Answer answer = procedure.run(table, odd_options(rng, procedure));
      EXPECT_EQ(answer.test, procedure.name);
      expect_sound(answer);
      answered += answer.estimable() ? 1 : 0;
      if (testing::Test::HasFailure()) FAIL() << procedure.name << " of sweep " << i;
    }
    EXPECT_GT(answered, 0u) << procedure.name;  // else the sweep asks nothing
  }
}

TEST(GrowthProcedures, NameTheOptionThatIsWrong) {
  base::Rng rng(1);
  for (const Procedure& procedure : growth_procedures())
    for (const ProcedureOption& option : procedure.options) {
      DataTable table = odd_table(rng, procedure.needs);
      const std::map<std::string, std::string> nonsense{{option.name, "nonsense"}};
      const Answer answer = procedure.run(table, ProcedureOptions(nonsense));
      EXPECT_EQ(answer.reason, "bad_value") << procedure.name << " " << option.name;
      ASSERT_FALSE(answer.notes.empty());
      EXPECT_NE(answer.notes.front().find(option.name), std::string::npos) << procedure.name << " " << option.name;
    }
}

}  // namespace
}  // namespace seldinger::assessment::statistics
