// Whatever a table holds, each procedure answers with finite numbers or a reason.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iterator>
#include <map>
#include <string>

#include "assessment/statistics/reasons.h"
#include "tests/assessment/statistics/relations/tables_of.h"

namespace seldinger::assessment::statistics {
namespace {

// How many tables each procedure gets: 2,000, in `./run test --long` 10,000 (SELDINGER_FUZZ).
std::size_t tables_tried() {
  const char* asked = std::getenv("SELDINGER_FUZZ");
  return asked != nullptr ? static_cast<std::size_t>(std::strtoul(asked, nullptr, 10)) : 2000;
}

class Degenerate {
 public:
  explicit Degenerate(std::uint64_t seed) : rng_(seed) {}

  DataTable table(const Procedure& procedure) {
    DataTable table;
    table.rows = upto(9) * (std::string_view(procedure.name) == "imputed" ? 3 : 1);  // which asks for ten at least
    const std::size_t kind = upto(8), groups = upto(3) == 0 ? 1 + upto(3) : 2;
    for (std::size_t c = 0; c < procedure.needs.most_values; ++c)
      table.values.push_back({"v", column(table.rows, kind)});
    if (procedure.needs.group || upto(2) == 0)
      for (std::size_t i = 0; i < table.rows; ++i)
        table.group.push_back(upto(40) == 0 ? "" : std::string(1, static_cast<char>('a' + upto(groups))));
    if (procedure.needs.x || upto(2) == 0) table.x = column(table.rows, upto(3) == 0 ? upto(8) : 0);
    if (upto(4) == 0)
      for (std::size_t i = 0; i < table.rows; ++i) table.subject.push_back("p" + std::to_string(upto(20)));
    return table;
  }

  ProcedureOptions options(const Procedure& procedure) {
    static const char* const kTexts[] = {"",    "a",  "b",     "a:b", "b:a",    "a:z", "0",     "0.5",    "1",
                                         "300", "-1", "1e300", "nan", "median", "2",   "lower", "1e-320", "mean"};
    std::map<std::string, std::string> values;
    for (const ProcedureOption& option : procedure.options)
      if (upto(2) == 0) values[option.name] = kTexts[upto(std::size(kTexts))];
    if (std::string_view(procedure.name) == "bootstrap" && upto(8) != 0) values["resamples"] = "200";
    if (std::string_view(procedure.name) == "tobit" && upto(4) != 0)
      values = {{"limit", upto(2) == 0 ? "0.5" : "1"}};
    return ProcedureOptions(values);
  }

 private:
  std::size_t upto(std::size_t end) { return static_cast<std::size_t>(rng_.uniform() * static_cast<double>(end)); }

  std::vector<double> column(std::size_t rows, std::size_t kind) {
    static constexpr double kExtreme[] = {1e300, -1e300, 1e-320, -1e-320, 0.0, 1.7e308, 1.0, -1.7e308};
    std::vector<double> values;
    const double constant = kExtreme[upto(std::size(kExtreme))];
    for (std::size_t i = 0; i < rows; ++i) {
      double value = static_cast<double>(upto(2));
      if (kind == 1) value = static_cast<double>(upto(4));
      if (kind == 2) value = rng_.normal();
      if (kind == 3) value = constant;
      if (kind == 4) value = kExtreme[upto(std::size(kExtreme))];
      if (kind == 5) value = std::exp(20.0 * rng_.normal());
      if (kind == 6) value = 1e9 + static_cast<double>(upto(3)) * 1e-7;
      if (kind == 7) value = upto(2) == 0 ? std::numeric_limits<double>::infinity() : 1.0;
      values.push_back(upto(20) == 0 ? fixtures::kMissing : value);
    }
    return values;
  }

  base::Rng rng_;
};

bool all_finite(const Answer& answer) {
  const auto finite = [](const std::vector<Named>& values) {
    return std::all_of(values.begin(), values.end(), [](const Named& one) { return std::isfinite(one.value); });
  };
  return (!answer.statistic || std::isfinite(*answer.statistic)) &&
         (!answer.estimate || std::isfinite(*answer.estimate)) &&
         (!answer.p_value || (*answer.p_value >= 0.0 && *answer.p_value <= 1.0)) &&
         (!answer.ci95 || (std::isfinite(answer.ci95->low) && std::isfinite(answer.ci95->high) &&
                           answer.ci95->low <= answer.ci95->high)) &&
         finite(answer.more) &&
         std::all_of(answer.rows.begin(), answer.rows.end(), [&](const Row& row) { return finite(row.values); });
}

TEST(Relations, AnswerAnyTableWithNumbersOrAReason) {
  std::uint64_t seed = 0;
  for (const Procedure& procedure : relations_procedures()) {
    Degenerate degenerate(++seed);
    std::size_t estimable = 0;
    for (std::size_t i = 0; i < tables_tried(); ++i) {
      const DataTable table = degenerate.table(procedure);
      const Answer answer = procedure.run(table, degenerate.options(procedure));
      ASSERT_EQ(answer.test, procedure.name);
      ASSERT_TRUE(all_finite(answer)) << procedure.name << " table " << i;
      if (answer.estimable()) {
        ++estimable;
        ASSERT_FALSE(answer.method.empty());
        ASSERT_TRUE(answer.estimate || answer.p_value || !answer.more.empty() || !answer.rows.empty());
        for (const Row& row : answer.rows) ASSERT_EQ(row.values.size(), answer.rows.front().values.size());
      } else {
        ASSERT_NE(find_reason(answer.reason.c_str()), nullptr) << procedure.name;
      }
    }
    EXPECT_GT(estimable, tables_tried() / 100) << procedure.name << ": hardly a table was answered";
  }
}

}  // namespace
}  // namespace seldinger::assessment::statistics
