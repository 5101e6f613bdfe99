// Rasch's models: R's eRm on fresh data, conditional probabilities by enumeration, what is refused or left out.
#include "assessment/statistics/growth/rasch/rasch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "assessment/statistics/growth/rasch/conditional_likelihood.h"
#include "sim/base/rng.h"
#include "tests/assessment/statistics/growth/numbers_of.h"
#include "tests/assessment/statistics/r_oracle.h"

namespace seldinger::assessment::statistics {
namespace {

using fixtures::number_of;

// Difficulties and severities that were planted add up to 0.
struct Planted {
  std::size_t persons = 80, items = 6, raters = 1;
  int most = 1;
  double missing = 0.0;
  double difficulty(std::size_t item) const {
    return 0.5 * (static_cast<double>(item) - 0.5 * static_cast<double>(items - 1));
  }
  double severity(std::size_t rater) const {
    return 0.8 * (static_cast<double>(rater) - 0.5 * static_cast<double>(raters - 1));
  }
  double step(int h) const { return most == 1 ? 0.0 : 1.2 * (h - 0.5 * (most + 1)); }
};

int answer_of(base::Rng& rng, const Planted& of, double place) {
  std::vector<double> shares{1.0};
  double log = 0.0, all = 1.0;
  for (int h = 1; h <= of.most; ++h) {
    log += place - of.step(h);
    shares.push_back(std::exp(log));
    all += shares.back();
  }
  double u = rng.uniform() * all;
  int score = 0;
  while (score < of.most && (u -= shares[static_cast<std::size_t>(score)]) > 0.0) ++score;
  return score;
}

// A column for each item, a row for each person and rater.
DataTable answered(base::Rng& rng, const Planted& of) {
  DataTable table;
  for (std::size_t i = 0; i < of.items; ++i) table.values.push_back({"q" + std::to_string(i + 1), {}});
  for (std::size_t p = 0; p < of.persons; ++p) {
    const double ability = 1.2 * rng.normal();
    for (std::size_t r = 0; r < of.raters; ++r) {
      std::size_t left = of.items;  // two at the least: eRm stops at a person with one answer
      for (std::size_t i = 0; i < of.items; ++i) {
        const int score = answer_of(rng, of, ability - of.difficulty(i) - of.severity(r));
        const bool missing = rng.uniform() < of.missing && left > 2;
        left -= missing ? 1 : 0;
        table.values[i].values.push_back(missing ? std::nan("") : score);
      }
      table.subject.push_back("p" + std::to_string(p));
      if (of.raters > 1) table.rater.push_back("r" + std::to_string(r + 1));
      ++table.rows;
    }
  }
  return table;
}

// X of eRm: persons by cells, an item's raters beside each other.
std::string r_cells(const DataTable& table, std::size_t raters) {
  std::string text = "X <- cbind(";
  for (std::size_t i = 0; i < table.values.size(); ++i)
    for (std::size_t r = 0; r < raters; ++r) {
      std::vector<double> column;
      for (std::size_t row = r; row < table.rows; row += raters) column.push_back(table.values[i].values[row]);
      text += (i + r > 0 ? ", " : "") + fixtures::r_vector(column);
    }
  return text + ")\n";
}

void expect_near(double got, double want, double within, const std::string& what) {
  fixtures::note_difference(got, want);
  EXPECT_LE(std::abs(got - want), within) << what << ": " << got << " for " << want;
}

TEST(Rasch, PlacesItemsAsErm) {
  SELDINGER_NEEDS_R();
  std::ostringstream script;
  script << "suppressMessages(library(eRm))\n";
  std::vector<DataTable> tables;
  base::Rng rng(fixtures::r_seed() + 71);
  for (std::size_t k = 0; k < fixtures::r_sets(); ++k) {
    tables.push_back(answered(rng, {60 + rng.bits() % 60, 4 + k % 5, 1, 1, k % 4 == 3 ? 0.05 : 0.0}));
    script << r_cells(tables.back(), 1) << "m <- RM(X)\npp <- person.parameter(m)\nf <- itemfit(pp)\n"
           << "say('ll" << k << "', m$loglik)\nfor (i in 1:ncol(X)) { n <- paste0('" << k << "_', i)\n"
           << "say(paste0('b', n), -m$betapar[i]); say(paste0('se', n), m$se.beta[i])\n"
           << "say(paste0('in', n), f$i.infitMSQ[i]); say(paste0('out', n), f$i.outfitMSQ[i]) }\n"
           << "for (i in 1:10) say(paste0('theta" << k << "_', i), pp$theta.table[i, 1])\n"
           << "for (i in 1:10) say(paste0('left" << k << "_', i), pp$theta.table[i, 3])\n";
  }
  const auto r = fixtures::r_values(script.str());
  for (std::size_t k = 0; k < tables.size(); ++k) {
    const Answer answer = rasch(tables[k]);
    ASSERT_TRUE(answer.estimable()) << answer.reason;
    expect_near(number_of(answer, "log_likelihood"), r.at("ll" + std::to_string(k)), 1e-5, "ll");
    for (std::size_t i = 0; i < tables[k].values.size(); ++i) {
      const std::string name = std::to_string(k) + "_" + std::to_string(i + 1),
                        row = "item: q" + std::to_string(i + 1);
      expect_near(number_of(answer, row, "logits"), r.at("b" + name), 1e-4, "b" + name);
      expect_near(number_of(answer, row, "se"), r.at("se" + name), 1e-3, "se" + name);
      if (k % 4 == 3) continue;  // eRm counts a missing answer's variance into infit
      expect_near(number_of(answer, row, "infit"), r.at("in" + name), 1e-3, "in" + name);
      expect_near(number_of(answer, row, "outfit"), r.at("out" + name), 1e-3, "out" + name);
    }
    for (std::size_t p = 1; p <= 10; ++p) {
      const std::string name = std::to_string(k) + "_" + std::to_string(p);
      const double theta = r.at("theta" + name);
      const double got = number_of(answer, "person: p" + std::to_string(p - 1), "logits");
      if (r.at("left" + name) == 0.0) expect_near(got, theta, 1e-3, "theta" + name);
    }
  }
}

TEST(Rasch, PlacesRatersAsErm) {
  SELDINGER_NEEDS_R();
  std::ostringstream script;
  script << "suppressMessages(library(eRm))\n";
  std::vector<DataTable> tables;
  std::vector<Planted> planted;
  base::Rng rng(fixtures::r_seed() + 72);
  const std::size_t sets = std::min<std::size_t>(fixtures::r_sets(), 100);  // eRm takes seconds for each
  for (std::size_t k = 0; k < (sets + 1) / 2; ++k) {
    planted.push_back({60 + rng.bits() % 40, 3 + k % 2, 2 + k % 2, k % 3 == 0 ? 2 : 1, 0.0});
    const Planted& of = planted.back();
    tables.push_back(answered(rng, of));
    script
        << r_cells(tables.back(), of.raters) << "I <- " << of.items << "; J <- " << of.raters << "; m <- "
        << of.most
        << "\nci <- contr.sum(I); cj <- contr.sum(J); ct <- if (m > 1) apply(contr.sum(m), 2, cumsum) else NULL\n"
        << "W <- NULL\nfor (i in 1:I) for (j in 1:J) for (h in 1:m) W <- rbind(W, c(-h * ci[i, ], -h * cj[j, ], "
           "if (m > 1) -ct[h, ]))\n"
        << "f <- if (m > 1) LPCM(X, W) else LLTM(X, W)\neta <- f$etapar\n"
        << "say('ll" << k << "', f$loglik)\nfor (i in seq_along(eta)) say(paste0('eta" << k << "_', i), eta[i])\n"
        << "for (i in seq_along(eta)) say(paste0('se" << k << "_', i), f$se.eta[i])\n";
  }
  const auto r = fixtures::r_values(script.str());
  for (std::size_t k = 0; k < tables.size(); ++k) {
    const Answer answer = rasch(tables[k]);
    ASSERT_TRUE(answer.estimable()) << answer.reason;
    const Planted& of = planted[k];
    expect_near(number_of(answer, "log_likelihood"), r.at("ll" + std::to_string(k)), 1e-4, "ll");
    std::size_t eta = 0;
    const auto expect = [&](const std::string& row) {
      const std::string name = std::to_string(k) + "_" + std::to_string(++eta);
      expect_near(number_of(answer, row, "logits"), r.at("eta" + name), 1e-4, row + name);
      expect_near(number_of(answer, row, "se"), r.at("se" + name), 1e-3, row + name);
    };
    for (std::size_t i = 1; i < of.items; ++i) expect("item: q" + std::to_string(i));
    for (std::size_t j = 1; j < of.raters; ++j) expect("rater: r" + std::to_string(j));
    if (of.most > 1)
      expect_near(number_of(answer, "step_1"), r.at("eta" + std::to_string(k) + "_" + std::to_string(++eta)), 1e-4,
                  "step");
  }
}

// Each way to answer four cells of up to two points, weighed, beside the likelihood by recursion.
TEST(Rasch, ConditionalLikelihoodIsThatOfAllWays) {
  ScoreModel model;
  model.parameters = 3;
  for (int c = 0; c < 4; ++c) {
    const double a = c == 0 ? 1.0 : 0.0, b = c == 1 ? 1.0 : 0.0, last = c == 3 ? -1.0 : 0.0;
    model.weights.push_back({{a + last, b + last, 0.3}, {2.0 * (a + last), 2.0 * (b + last), -0.2}});
  }
  const std::vector<std::vector<int>> scores{{0, 1, 2, 0}, {1, 1, 0, 2}, {2, 0, 1, 1}, {0, 2, 2, 1}, {1, 0, 0, 0},
                                             {0, 0, 1, 0}, {2, 2, 1, 2}, {1, 2, 0, 1}, {0, 0, 0, 1}, {2, 1, 1, 0}};
  const auto fit = fit_conditional(model, scores);
  ASSERT_TRUE(fit.has_value());
  const auto logs = model.logs(fit->eta);
  double want = 0.0;
  for (const auto& own : scores) {
    double top = 0.0, all = 0.0;
    const int total = own[0] + own[1] + own[2] + own[3];
    for (int w = 0; w < 81; ++w) {
      const int way[] = {w % 3, w / 3 % 3, w / 9 % 3, w / 27};
      if (way[0] + way[1] + way[2] + way[3] != total) continue;
      double log = 0.0;
      for (std::size_t c = 0; c < 4; ++c) log += logs[c][static_cast<std::size_t>(way[c])];
      all += std::exp(log);
      if (std::equal(own.begin(), own.end(), way)) top = std::exp(log);
    }
    want += std::log(top / all);
  }
  EXPECT_NEAR(fit->log_likelihood, want, 1e-10);
}

TEST(Rasch, FindsWhatWasPlanted) {
  base::Rng rng(9);
  const Planted of{2000, 5, 3, 2, 0.1};
  const Answer answer = rasch(answered(rng, of));
  ASSERT_TRUE(answer.estimable());
  EXPECT_THAT(answer.method, testing::HasSubstr("many-facet rating scale"));
  for (std::size_t i = 0; i < of.items; ++i) {
    const std::string row = "item: q" + std::to_string(i + 1);
    expect_near(number_of(answer, row, "logits"), of.difficulty(i), 4.0 * number_of(answer, row, "se"), row);
    expect_near(number_of(answer, row, "infit"), 1.0, 0.1, row);
  }
  for (std::size_t j = 0; j < of.raters; ++j) {
    const std::string row = "rater: r" + std::to_string(j + 1);
    expect_near(number_of(answer, row, "logits"), of.severity(j), 4.0 * number_of(answer, row, "se"), row);
  }
  expect_near(number_of(answer, "step_2"), of.step(2), 0.1, "step");
}

TEST(Rasch, TakesItemsFromRowsAsFromColumns) {
  base::Rng rng(10);
  const DataTable wide = answered(rng, Planted{});
  DataTable rows;
  rows.values.push_back({"score", {}});
  for (const Column& item : wide.values)
    for (std::size_t i = 0; i < wide.rows; ++i) {
      rows.values.front().values.push_back(item.values[i]);
      rows.group.push_back(item.name);
      rows.subject.push_back(wide.subject[i]);
      ++rows.rows;
    }
  const Answer a = rasch(wide), b = rasch(rows);
  ASSERT_TRUE(a.estimable() && b.estimable());
  EXPECT_EQ(number_of(a, "item: q2", "logits"), number_of(b, "item: q2", "logits"));
}

TEST(Rasch, RefusesAndLeavesOut) {
  base::Rng rng(11);
  EXPECT_EQ(rasch(answered(rng, {29, 5, 1, 1, 0.0})).reason, "too_few");
  DataTable table = answered(rng, Planted{});
  DataTable easy = table;
  easy.values.push_back({"easy", std::vector<double>(easy.rows, 1.0)});
  const Answer left = rasch(easy), without = rasch(table);
  ASSERT_TRUE(left.estimable());
  EXPECT_THAT(left.notes, testing::Contains(testing::HasSubstr("Item easy is left out")));
  EXPECT_EQ(number_of(left, "item: q1", "logits"), number_of(without, "item: q1", "logits"));
  DataTable twice = table;
  twice.subject[1] = twice.subject[0];
  EXPECT_EQ(rasch(twice).reason, "repeated_subject");
  DataTable half = table;
  half.values[0].values[3] = 0.5;
  EXPECT_EQ(rasch(half).reason, "bad_value");
  // Two items that everybody meets in the same order, and nothing else.
  DataTable ordered;
  for (const char* name : {"first", "second"}) ordered.values.push_back({name, {}});
  for (int i = 0; i < 40; ++i) {
    ordered.values[0].values.push_back(i > 5 ? 1.0 : 0.0);
    ordered.values[1].values.push_back(i > 30 ? 1.0 : 0.0);
    ++ordered.rows;
  }
  EXPECT_FALSE(rasch(ordered).estimable());
}

}  // namespace
}  // namespace seldinger::assessment::statistics
