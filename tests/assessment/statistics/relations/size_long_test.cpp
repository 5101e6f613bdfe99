// How often tests of this shelf reject what is true at 5 %, over 20,000 null samples of two groups.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "tests/assessment/statistics/relations/coverage.h"

namespace seldinger::assessment::statistics {
namespace {

using fixtures::answer_of;
using fixtures::grouped;
using fixtures::RandomTables;
using fixtures::related;

constexpr std::size_t kRuns = 20000;
// .05 and three standard errors.
const double kExactAtMost = 0.05 + 3.0 * std::sqrt(0.05 * 0.95 / kRuns);

struct Cell {
  std::size_t first, second;
};
constexpr Cell kCells[] = {{6, 6}, {8, 16}, {12, 12}, {30, 30}};

struct Rejected {
  double share = 0.0;
  double warned = 0.0;  // of the answers that have a p
};

Rejected size_of(const std::string& what, const Cell& cell, const std::function<Answer(RandomTables&)>& sample) {
  RandomTables random(fixtures::stream_of(what, 1000 * cell.first + cell.second));
  std::size_t rejected = 0, warned = 0, tested = 0;
  for (std::size_t run = 0; run < kRuns; ++run) {
    const Answer answer = sample(random);
    if (!answer.p_value) continue;
    ++tested;
    rejected += *answer.p_value <= 0.05;
    warned += fixtures::warns_of(answer, fixtures::kRejectsTooMuch);
  }
  const Rejected found{static_cast<double>(rejected) / static_cast<double>(kRuns),
                       static_cast<double>(warned) / static_cast<double>(tested)};
  std::printf("  size  %-40s %2zu/%2zu  %.4f  without p %.4f  warned %.2f\n", what.c_str(), cell.first, cell.second,
              found.share, 1.0 - static_cast<double>(tested) / static_cast<double>(kRuns), found.warned);
  EXPECT_GT(tested, kRuns / 2) << what;
  return found;
}

void expect_exact(const std::string& what, const Cell& cell, const std::function<Answer(RandomTables&)>& sample) {
  EXPECT_LE(size_of(what, cell, sample).share, kExactAtMost) << what << cell.first;
}

void expect_printed(const std::string& what, const Cell& cell, const std::function<Answer(RandomTables&)>& sample) {
  const Rejected got = size_of(what, cell, sample);
  if (got.share > 0.06) {
    EXPECT_EQ(got.warned, 1.0) << what << ' ' << cell.first << '/' << cell.second;
  }
  EXPECT_LT(got.share, 0.25) << what;
}

TEST(Size, OfExactTestsIsAtMostFivePercent) {
  for (const Cell& cell : kCells) {
    expect_exact("Fisher, share .3", cell, [&](RandomTables& random) {
      return answer_of("fisher", grouped({random.some(cell.first, [&] { return random.one_or_zero(0.3); }),
                                          random.some(cell.second, [&] { return random.one_or_zero(0.3); })}));
    });
    expect_exact("Poisson, rate 2", cell, [&](RandomTables& random) {
      return answer_of("poisson", grouped({random.some(cell.first, [&] { return random.poisson(2.0); }),
                                           random.some(cell.second, [&] { return random.poisson(2.0); })}));
    });
  }
  for (const char* name : {"spearman", "kendall"})
    for (const double grain : {1.0, 1e6})
      expect_exact(std::string(name) + (grain == 1.0 ? ", 8 persons, tied" : ", 8 persons"), {8, 8},
                   [&](RandomTables& random) {
                     const auto draw = [&] { return std::round(grain * random.normal()); };
                     return answer_of(name, related(random.some(8, draw), random.some(8, draw)));
                   });
}

TEST(Size, OfLogRankIsPrinted) {
  const std::function<double(RandomTables&)> draws[] = {
      [](RandomTables& random) { return random.exponential(100.0); },
      [](RandomTables& random) { return 100.0 * std::exp(random.normal()); },
      [](RandomTables& random) { return 30.0 * std::ceil(random.exponential(100.0) / 30.0); }};
  const char* const names[] = {"exponential", "log-normal", "tied"};
  for (std::size_t kind = 0; kind < 3; ++kind)
    for (const Cell& cell : kCells)
      for (const char* name : {"log_rank", "rmst"})
        expect_printed(std::string(name) + ", " + names[kind] + ", censored", cell, [&](RandomTables& random) {
          std::vector<std::vector<double>> groups(2);
          std::vector<double> events;
          for (std::size_t g = 0; g < 2; ++g)
            for (std::size_t i = 0; i < (g == 0 ? cell.first : cell.second); ++i) {
              const double event = draws[kind](random);
              const double gave_up =
                  kind == 2 ? 30.0 * std::ceil(random.exponential(250.0) / 30.0) : random.exponential(250.0);
              groups[g].push_back(std::min(event, gave_up));
              events.push_back(event <= gave_up ? 1.0 : 0.0);
            }
          return answer_of(name, grouped(groups, events));
        });
}

TEST(Size, OfDeLongIsPrinted) {
  for (const bool tied : {false, true})
    for (const double spread : {1.0, 3.0})
      for (const Cell& cell : kCells)
        expect_printed(
            "DeLong, AUC .75, " + std::string(tied ? "tied" : "normal") + ", SD ratio " +
                std::to_string(spread).substr(0, 1),
            cell, [&](RandomTables& random) {
              DataTable table = grouped({std::vector<double>(cell.first), std::vector<double>(cell.second)});
              table.values.push_back({"other", std::vector<double>(table.rows)});
              for (std::size_t i = 0; i < table.rows; ++i) {
                const bool positive = i >= cell.first;
                const double own = positive ? spread : 1.0, skill = random.normal();
                const double shift = positive ? 0.6745 * std::sqrt(1.0 + spread * spread) : 0.0;
                for (Column& column : table.values) {
                  const double value = own * std::sqrt(0.5) * (skill + random.normal()) + shift;
                  column.values[i] = tied ? std::round(value) : value;
                }
              }
              return answer_of("delong", table);
            });
}

TEST(Size, OfLikelihoodsIsPrinted) {
  for (const Cell& cell : kCells) {
    expect_printed("negative binomial, theta 1, mean 4", cell, [&](RandomTables& random) {
      return answer_of("negative_binomial",
                       grouped({random.some(cell.first, [&] { return random.overdispersed(4.0); }),
                                random.some(cell.second, [&] { return random.overdispersed(4.0); })}));
    });
    for (const double spread : {1.0, 3.0})
      expect_printed(
          "tobit, 30 % censored, SD ratio " + std::to_string(spread).substr(0, 1), cell, [&](RandomTables& random) {
            return answer_of("tobit",
                             grouped({random.some(cell.first, [&] { return random.normal(); }),
                                      random.some(cell.second, [&] { return spread * random.normal(); })}),
                             {{"limit", "0.52"}});
          });
  }
}

}  // namespace
}  // namespace seldinger::assessment::statistics
