// Every row of a shelf's table given what nobody hopes for: few rows, constants, ties, huge and tiny values, holes,
// and options that make sense or none. The answer is numbers or a reason.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "assessment/statistics/procedure.h"
#include "assessment/statistics/reasons.h"
#include "sim/base/rng.h"

namespace seldinger::fixtures {

inline std::size_t up_to(base::Rng& rng, std::size_t most) {
  return rng.bits() % (most + 1);
}

inline double odd_number(base::Rng& rng, std::size_t kind) {
  switch (kind) {
    case 0:
      return 7.0;
    case 1:
      return static_cast<double>(up_to(rng, 1));
    case 2:
      return static_cast<double>(1 + up_to(rng, 4));
    case 3:
      return rng.normal();
    case 4:
      return (up_to(rng, 1) == 0 ? 1.0 : -1.0) * 1e300;
    case 5:
      return 1e-320 * static_cast<double>(up_to(rng, 2));
    case 6:
      return static_cast<double>(up_to(rng, 2)) * 1e300 + rng.normal();
    case 7:
      return 1e9 + static_cast<double>(up_to(rng, 2)) * 1e-6;
    case 8:
      return 1e150 * rng.normal();
    case 9:
      return 1e-160 * rng.normal();
    default:
      return rng.uniform();
  }
}

// Columns of numbers with holes, or not; labels that make a full table of subjects and raters, or any.
inline assessment::statistics::DataTable odd_table(base::Rng& rng, const assessment::statistics::Needs& needs) {
  assessment::statistics::DataTable table;
  const bool full = (needs.rater || rng.uniform() < 0.3) && rng.uniform() < 0.7;
  const std::size_t raters = 1 + up_to(rng, 3), occasions = 1 + up_to(rng, 1);
  table.rows = full ? up_to(rng, 8) * raters * occasions : rng.uniform() < 0.4 ? up_to(rng, 40) : up_to(rng, 8);
  const double holes = rng.uniform() < 0.5 ? 0.0 : 0.1;
  const std::size_t kind = up_to(rng, 10), most = std::min<std::size_t>(needs.most_values, needs.least_values + 4);
  const std::size_t columns = needs.least_values + up_to(rng, most - needs.least_values);
  const auto number = [&](std::size_t of_kind) {
    const std::size_t other = up_to(rng, 10);
    if (rng.uniform() < holes) return std::numeric_limits<double>::quiet_NaN();
    return odd_number(rng, rng.uniform() < 0.05 ? other : of_kind);
  };
  for (std::size_t j = 0; j < columns; ++j) {
    table.values.push_back({"v" + std::to_string(j), {}});
    for (std::size_t i = 0; i < table.rows; ++i) table.values.back().values.push_back(number(kind));
  }
  const auto label = [&](std::size_t kinds) {
    return rng.uniform() < 0.3 * holes ? std::string()
                                       : std::string(1, static_cast<char>('a' + up_to(rng, kinds - 1)));
  };
  const std::size_t x_kind = up_to(rng, 10), groups = 1 + up_to(rng, 2);
  const bool has_x = needs.x || rng.uniform() < 0.4, has_group = needs.group || rng.uniform() < 0.3;
  const bool has_subject = needs.subject || full || rng.uniform() < 0.3;
  const bool has_rater = needs.rater || full || rng.uniform() < 0.2;
  for (std::size_t i = 0; i < table.rows; ++i) {
    if (has_x) table.x.push_back(full ? static_cast<double>(i / raters % occasions) : number(x_kind));
    if (has_group) table.group.push_back(label(groups));
    if (has_subject) table.subject.push_back(full ? "s" + std::to_string(i / raters / occasions) : label(9));
    if (has_rater) table.rater.push_back(full ? "r" + std::to_string(i % raters) : label(4));
  }
  return table;
}

using OptionTexts = std::map<std::string, std::string>;

// `sensible`, of which some are left out and some are anything.
inline assessment::statistics::ProcedureOptions odd_options(base::Rng& rng,
                                                            const assessment::statistics::Procedure& procedure,
                                                            const OptionTexts& sensible) {
  static const char* const kTexts[] = {"0.05",   "0.3",       "1",    "0",     "-2",     "nan",    "inf",
                                       "",       "yes",       "2.50", "100",   "1e300",  "1e-320", "v0:v1",
                                       "a",      "2:3:1",     "::",   "5.19",  "higher", "lower",  "group",
                                       "linear", "quadratic", "icc1", "icc3k", "28"};
  OptionTexts values;
  const double wildness = rng.uniform() < 0.5 ? 0.0 : 0.3;
  for (const auto& option : procedure.options) {
    const auto found = sensible.find(option.name);
    if (found != sensible.end() && rng.uniform() >= 0.5 * wildness) values[option.name] = found->second;
    // Thousands of draws for each odd table would only take time.
    if (rng.uniform() < wildness && std::string(option.name) != "resamples")
      values[option.name] = kTexts[up_to(rng, std::size(kTexts) - 1)];
  }
  return assessment::statistics::ProcedureOptions(values);
}

inline void expect_sound(const assessment::statistics::Answer& answer) {
  EXPECT_FALSE(answer.test.empty());
  if (!answer.estimable()) {
    EXPECT_NE(assessment::statistics::find_reason(answer.reason.c_str()), nullptr) << answer.reason;
    EXPECT_FALSE(answer.estimate || answer.p_value || answer.statistic || answer.ci95);
    return;
  }
  EXPECT_FALSE(answer.method.empty());
  EXPECT_TRUE(std::isfinite(answer.statistic.value_or(0.0)) && std::isfinite(answer.estimate.value_or(0.0)));
  if (answer.ci95) {
    EXPECT_TRUE(std::isfinite(answer.ci95->low) && std::isfinite(answer.ci95->high));
    EXPECT_LE(answer.ci95->low, answer.ci95->high);
  }
  EXPECT_TRUE(answer.p_value.value_or(0.5) >= 0.0 && answer.p_value.value_or(0.5) <= 1.0);
  for (const double df : answer.df) EXPECT_TRUE(std::isfinite(df) && df > 0.0) << df;
  for (const auto& one : answer.more) EXPECT_TRUE(std::isfinite(one.value)) << one.name;
  for (const auto& row : answer.rows)
    for (const auto& one : row.values) EXPECT_TRUE(std::isfinite(one.value)) << row.name << " " << one.name;
}

// `runs` odd tables for each procedure; `also` looks at each answer, `sensible` holds options by procedure.
template <typename Also>
void expect_sound_answers(std::span<const assessment::statistics::Procedure> procedures, std::size_t runs,
                          const std::map<std::string, OptionTexts>& sensible, const Also& also) {
  for (const auto& procedure : procedures) {
    std::size_t estimated = 0;
    for (std::size_t i = 0; i < runs && !testing::Test::HasFailure(); ++i) {
      SCOPED_TRACE(std::string(procedure.name) + " of sweep " + std::to_string(i));
      base::Rng rng(i);
      const auto table = odd_table(rng, procedure.needs);
      const auto options = sensible.find(procedure.name);
      const auto answer = procedure.run(
          table, odd_options(rng, procedure, options == sensible.end() ? OptionTexts{} : options->second));
      EXPECT_EQ(answer.test, procedure.name);
      expect_sound(answer);
      also(answer);
      estimated += answer.estimable() ? 1 : 0;
    }
    // Else it was asked nothing.
    EXPECT_GE(estimated * 500, runs) << procedure.name;
    testing::Test::RecordProperty(std::string(procedure.name) + "_estimated", static_cast<int>(estimated));
  }
}

// Every option of every procedure answers nonsense by its name.
inline void expect_wrong_options_named(std::span<const assessment::statistics::Procedure> procedures,
                                       const std::map<std::string, OptionTexts>& sensible) {
  for (const auto& procedure : procedures)
    for (const auto& option : procedure.options) {
      base::Rng rng(1);
      OptionTexts values = sensible.contains(procedure.name) ? sensible.at(procedure.name) : OptionTexts{};
      values[option.name] = "nonsense";
      auto table = odd_table(rng, procedure.needs);
      const auto answer = procedure.run(table, assessment::statistics::ProcedureOptions(values));
      EXPECT_EQ(answer.reason, "bad_value") << procedure.name << " " << option.name;
      ASSERT_FALSE(answer.notes.empty()) << procedure.name << " " << option.name;
      EXPECT_NE(answer.notes.front().find(option.name), std::string::npos) << answer.notes.front();
    }
}

}  // namespace seldinger::fixtures
