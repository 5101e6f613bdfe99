// Coverage of the cuts' intervals, and the shelf's rows with ten thousand odd tables each.
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "assessment/statistics/standards/angoff.h"
#include "assessment/statistics/standards/borderline.h"
#include "assessment/statistics/standards/classification.h"
#include "assessment/statistics/standards/contrasting_groups.h"
#include "assessment/statistics/standards/hofstee.h"
#include "sim/base/rng.h"
#include "tests/assessment/statistics/covered.h"
#include "tests/assessment/statistics/standards/odd_standards.h"

namespace seldinger::assessment::statistics {
namespace {

using fixtures::Coverage;

constexpr std::size_t kRuns = 20000, kBootstrapRuns = 2000, kDraws = 400;
constexpr std::size_t kSizes[] = {12, 30, 100};

bool warns_of_interval(const Answer& answer) {
  for (const std::string& note : answer.notes)
    if (note.find("covers") != std::string::npos) return true;
  return false;
}

std::string of_n(const char* what, std::size_t n) {
  return std::string(what) + ", n = " + std::to_string(n);
}

// Whether every answer warns whose interval is counted.
struct Watched {
  Coverage coverage;
  bool warned = true;
  void add(const Answer& answer, double truth) {
    if (!answer.estimable()) return;
    coverage.add(answer.ci95, truth);
    warned = warned && (!answer.ci95 || warns_of_interval(answer));
  }
};

TEST(StandardsLong, OddTables) {
  fixtures::expect_sound_standards(10000);
}

TEST(StandardsLong, ContrastingGroupsCover) {
  for (const std::size_t n : kSizes) {
    Watched watched;
    for (std::size_t run = 0; run < kBootstrapRuns; ++run) {
      base::Rng rng(run);
      ContrastingGroups groups{{"novice", n}, {"expert", n}, {}, {}, true, 0};
      for (std::size_t i = 0; i < n; ++i) {
        groups.without.push_back(60.0 + 10.0 * rng.normal());
        groups.competent.push_back(80.0 + 6.0 * rng.normal());
      }
      watched.add(contrasting_groups(groups, kDraws, run), 71.0255004345306);
    }
    watched.coverage.expect_near_or_warned(of_n("contrasting groups, each", n), watched.warned);
  }
}

TEST(StandardsLong, BorderlineCovers) {
  for (const std::size_t n : kSizes) {
    Watched line;
    for (std::size_t run = 0; run < kBootstrapRuns; ++run) {
      base::Rng rng(run);
      RatedScores rated{{}, {}, 0, 2.0};
      for (std::size_t i = 0; i < n; ++i) {
        rated.rating.push_back(std::floor(1.0 + 5.0 * rng.uniform()));
        rated.score.push_back(40.0 + 8.0 * rated.rating.back() + 6.0 * rng.normal());
      }
      line.add(borderline(rated, BorderlineMethod::kRegression, kDraws, run), 56.0);
    }
    line.coverage.expect_near_or_warned(of_n("borderline regression", n), line.warned);
  }
}

TEST(StandardsLong, AngoffCovers) {
  for (const std::size_t n : kSizes) {
    Coverage coverage;
    for (std::size_t run = 0; run < kRuns; ++run) {
      base::Rng rng(run);
      std::vector<double> strict;
      for (std::size_t judge = 0; judge < n; ++judge) strict.push_back(0.05 * rng.normal());
      CompleteTable judged;
      for (std::size_t judge = 0; judge < n; ++judge) judged.columns.push_back(std::to_string(judge));
      for (const double share : {0.4, 0.6, 0.5, 0.7}) {
        ++judged.rows;
        for (std::size_t judge = 0; judge < n; ++judge) judged.values.push_back(share + strict[judge]);
      }
      coverage.add(angoff({{1.0, judged}}).ci95, 0.55);
    }
    coverage.expect_exact(of_n("Angoff, judges", n));
  }
}

// Normal scores: the line meets their distribution where Φ((c − 60) / 10) is .6 − .4 (c − 50) / 20.
TEST(StandardsLong, HofsteeCovers) {
  double low = 50.0, high = 70.0;
  for (int i = 0; i < 200; ++i) {
    const double cut = 0.5 * (low + high);
    (0.5 * std::erfc(-(cut - 60.0) / 10.0 / std::sqrt(2.0)) < 0.6 - 0.4 * (cut - 50.0) / 20.0 ? low : high) = cut;
  }
  for (const std::size_t n : kSizes) {
    Watched watched;
    for (std::size_t run = 0; run < kBootstrapRuns; ++run) {
      base::Rng rng(run);
      std::vector<double> scores;
      for (std::size_t i = 0; i < n; ++i) scores.push_back(60.0 + 10.0 * rng.normal());
      watched.add(hofstee(std::move(scores), 0, {{50}, {70}, {.2}, {.6}}, true, kDraws, run), low);
    }
    watched.coverage.expect_near_or_warned(of_n("Hofstee", n), watched.warned);
  }
}

TEST(StandardsLong, ClassificationCovers) {
  const double truth = classification_of(60.0, 10.0, 0.8, 52.0).consistency;
  for (const std::size_t n : kSizes) {
    Coverage coverage;
    for (std::size_t run = 0; run < kRuns; ++run) {
      base::Rng rng(run);
      CutScores of{{}, 0, 52.0, 0.8, true};
      for (std::size_t i = 0; i < n; ++i) of.scores.push_back(60.0 + 10.0 * rng.normal());
      coverage.add(classification(of).ci95, truth);
    }
    coverage.expect_exact(of_n("classification consistency", n));
  }
}

}  // namespace
}  // namespace seldinger::assessment::statistics
