// Times to an event, censored values and draws of random tables against R.
#include <gtest/gtest.h>

#include <algorithm>

#include "assessment/statistics/relations/bootstrap.h"
#include "assessment/statistics/relations/survival.h"
#include "tests/assessment/statistics/relations/random_tables.h"

namespace seldinger::assessment::statistics {
namespace {

using fixtures::answer_of;
using fixtures::grouped;
using fixtures::high_of;
using fixtures::low_of;
using fixtures::named;
using fixtures::or_missing;
using fixtures::RandomTables;
using fixtures::RAnswers;
using fixtures::said;
using fixtures::script_of;

constexpr double kSameForm = 1e-9;

TEST(TimesR, CurvesTestsAndMeansAreThoseOfSurvival) {
  SELDINGER_NEEDS_R();
  RandomTables random(5);
  std::vector<DataTable> tables;
  for (std::size_t i = 0; i < fixtures::r_sets(); ++i) {
    const std::size_t groups = i % 3 == 2 ? 3 : 2;
    std::vector<std::vector<double>> times(groups);
    std::vector<double> events;
    for (std::vector<double>& group : times)
      for (std::size_t n = random.from_to(6, 35); n > 0; --n) {
        const double event = random.exponential(60.0), gave_up = random.exponential(120.0);
        const double grain = i % 2 == 0 ? 5.0 : 1e-3;
        group.push_back(grain * std::ceil(std::min(event, gave_up) / grain));
        events.push_back(event <= gave_up ? 1.0 : 0.0);
      }
    DataTable table = grouped(times, events);
    random.lose_some(table.values[0].values);
    random.lose_some(table.x);
    table.values[0].values[0] = 30.0;  // group a stands first
    table.x[0] = 1.0;
    tables.push_back(table);
  }
  RAnswers r(script_of(tables, "suppressMessages(library(survival))", R"(
n <- 0
for (h in unique(g)) {
  f <- survfit(Surv(v[g == h], x[g == h]) ~ 1, conf.type = 'log-log'); u <- summary(f)
  q <- quantile(f, .5); s(paste0('m', h), q$quantile); s(paste0('ml', h), q$lower); s(paste0('mh', h), q$upper)
  for (j in seq_along(u$time)) {
    s(paste0('t', n), u$time[j]); s(paste0('n', n), u$n.risk[j]); s(paste0('s', n), u$surv[j])
    s(paste0('e', n), if (u$surv[j] > 0) u$std.err[j] else 0); s(paste0('l', n), u$lower[j]); s(paste0('h', n), u$upper[j]); n <- n + 1
  }
}
d <- survdiff(Surv(v, x) ~ g); s('chi', d$chisq); s('o', d$obs[1]); s('ex', d$exp[1]); s('rows', n)
s('p', pchisq(d$chisq, length(d$n) - 1, lower.tail = FALSE)); s('peto', exp((d$obs[1] - d$exp[1]) / d$var[1, 1]))
w <- g != 'c'; tau <- min(max(v[g == 'a']), max(v[g == 'b']))
m <- summary(survfit(Surv(v[w], x[w]) ~ g[w]), rmean = tau)$table
s('tau', tau); s('rm', m[1, 'rmean'] - m[2, 'rmean']); s('rs', sqrt(sum(m[, 'se(rmean)']^2)))
)"));
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const Answer curve = answer_of("kaplan_meier", tables[i]), test = answer_of("log_rank", tables[i]);
    ASSERT_EQ(static_cast<double>(curve.rows.size()), r.of(i, "rows"));
    for (std::size_t j = 0; j < curve.rows.size(); ++j) {
      const auto value = [&](std::size_t place) { return curve.rows[j].values[place].value; };
      const std::string line = std::to_string(j);
      r.expect(i, "t" + line, value(0), kSameForm);
      r.expect(i, "n" + line, value(1), kSameForm);
      r.expect(i, "s" + line, value(3), kSameForm);
      r.expect(i, "e" + line, value(4), kSameForm);
      if (value(3) == 0.0) continue;  // no interval there in R
      r.expect(i, "l" + line, value(5), kSameForm);
      r.expect(i, "h" + line, value(6), kSameForm);
    }
    for (const GroupCount& group : curve.groups) {
      r.expect(i, "m" + group.name, named(curve, "median " + group.name), kSameForm);
      r.expect(i, "ml" + group.name, named(curve, "median_low " + group.name), kSameForm);
      r.expect(i, "mh" + group.name, named(curve, "median_high " + group.name), kSameForm);
    }
    r.expect(i, "chi", or_missing(test.statistic), kSameForm);
    r.expect(i, "p", or_missing(test.p_value), kSameForm);
    r.expect(i, "o", test.rows[0].values[0].value, kSameForm);
    r.expect(i, "ex", test.rows[0].values[1].value, kSameForm);
    if (test.groups.size() == 2) r.expect(i, "peto", or_missing(test.estimate), kSameForm);
    const Answer mean = answer_of("rmst", tables[i], {{"order", "a:b"}});
    r.expect(i, "tau", named(mean, "tau"), kSameForm);
    r.expect(i, "rm", or_missing(mean.estimate), kSameForm);
    r.expect(i, "rs", *mean.estimate / *mean.statistic, kSameForm);
  }
}

TEST(TimesR, CensoredMeansAreThoseOfAer) {
  SELDINGER_NEEDS_R();
  RandomTables random(6);
  std::vector<DataTable> tables;
  std::string limits = "suppressMessages(library(AER)); L <- c(";
  std::vector<std::string> limit_of;
  for (std::size_t i = 0; i < fixtures::r_sets(); ++i) {
    const double far = i % 2 == 0 ? 0.5 : 5.0;
    std::vector<double> a = random.some(random.from_to(6, 30), [&] { return 100.0 + 20.0 * random.normal(); });
    std::vector<double> b = random.some(random.from_to(6, 30), [&] { return 110.0 + 20.0 * random.normal(); });
    limit_of.push_back(i % 2 == 0 ? "115" : "160");
    const double limit = 110.0 + 10.0 * far;
    for (std::vector<double>* group : {&a, &b}) {
      for (double& value : *group) value = std::min(value, limit);
      random.lose_some(*group);
      (*group)[0] = 90.0;
    }
    tables.push_back(grouped({a, b}));
    limits += (i > 0 ? "," : "") + limit_of.back();
  }
  RAnswers r(script_of(tables, limits + "); i <- 0", R"(
i <<- i + 1; g <- factor(g, c('b', 'a'))
m <- tobit(v ~ g, left = -Inf, right = L[i], control = survreg.control(rel.tolerance = 1e-13, maxiter = 500)); f <- summary(m)$coefficients
s('d', f[2, 1]); s('se', f[2, 2]); s('p', f[2, 4]); s('sigma', m$scale)
)"));
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const Answer got = answer_of("tobit", tables[i], {{"limit", limit_of[i]}});
    r.expect(i, "d", or_missing(got.estimate), 1e-6);
    r.expect(i, "se", named(got, "standard_error"), 1e-6);
    r.expect(i, "p", or_missing(got.p_value), 1e-6);
    r.expect(i, "sigma", named(got, "sigma"), 1e-6);
    // The mirror image at a lower limit is the same but for its sign.
    DataTable mirrored = tables[i];
    for (double& value : mirrored.values[0].values) value = -value;
    const Answer other = answer_of("tobit", mirrored, {{"limit", "-" + limit_of[i]}, {"side", "lower"}});
    EXPECT_EQ(-or_missing(other.estimate), or_missing(got.estimate));
  }
}

// R is given who was drawn, and does all else itself; the mean of one group goes through package boot.
TEST(TimesR, DrawsOfTheSamePersonsGiveTheSameLimits) {
  SELDINGER_NEEDS_R();
  RandomTables random(7);
  std::string script = R"(
suppressMessages(library(boot))
median_or_mean <- function(u, m) if (m) median(u) else mean(u)
place <- function(t, p) {
  k <- p * (length(t) + 1); j <- floor(k); if (k < 1) return(t[1]); if (k >= length(t)) return(t[length(t)])
  if (k == j) return(t[j])
  z <- qnorm(c(p, j / (length(t) + 1), (j + 1) / (length(t) + 1))); t[j] + (z[1] - z[2]) / (z[3] - z[2]) * (t[j + 1] - t[j])
}
bca <- function(groups, draws, m) {
  c0 <- sapply(groups, median_or_mean, m); t0 <- c0[1] - if (length(groups) > 1) c0[2] else 0
  ts <- sapply(seq_along(groups), function(h) apply(draws[[h]], 1, function(d) median_or_mean(groups[[h]][d + 1], m)))
  t <- ts[, 1] - if (length(groups) > 1) ts[, 2] else 0
  L <- unlist(lapply(seq_along(groups), function(h) { n <- length(groups[[h]])
    j <- sapply(1:n, function(i) median_or_mean(groups[[h]][-i], m)); (if (h == 1) 1 else -1) * (n - 1) * (mean(j) - j) / n }))
  a <- if (sum(L^2) > 0) sum(L^3) / (6 * sum(L^2)^1.5) else 0
  same <- abs(t - t0) <= 1e-12 * max(abs(unlist(groups))); z0 <- qnorm(mean(t < t0 & !same) + mean(same) / 2)
  z <- z0 + qnorm(c(.025, .975)); p <- pnorm(z0 + z / (1 - a * z)); t <- sort(t); c(t0, place(t, p[1]), place(t, p[2]), sum(same))
})";
  const std::size_t sets = fixtures::r_sets(), draws = 400;
  std::vector<Answer> answers;
  for (std::size_t i = 0; i < sets; ++i) {
    const bool two = i % 2 == 0, median = i % 4 < 2;
    std::vector<std::vector<double>> groups(two ? 2 : 1);
    std::string values, drawn;
    for (std::size_t g = 0; g < groups.size(); ++g) {
      const double grain = i % 5 == 0 ? 1.0 : 1e4;
      groups[g] =
          random.some(random.from_to(6, 16), [&] { return std::round(grain * random.exponential(5.0)) / grain; });
      groups[g][0] = 1.0;
      groups[g][1] = 7.0;
      const Resamples resamples(groups[g].size(), draws, base::hash_combine(std::uint64_t{i}, std::uint64_t{g}));
      std::vector<double> indices;
      for (std::size_t d = 0; d < draws; ++d)
        for (std::size_t j = 0; j < groups[g].size(); ++j)
          indices.push_back(static_cast<double>(resamples.at(d, j)));
      values += (g > 0 ? "," : "") + fixtures::r_vector(groups[g]);
      drawn += std::string(g > 0 ? "," : "") + "matrix(" + fixtures::r_vector(indices) + ", " +
               std::to_string(draws) + ", byrow = TRUE)";
    }
    const std::string name = "'s" + std::to_string(i) + "_";
    script += "\ngs <- list(" + values + "); ds <- list(" + drawn + "); b <- bca(gs, ds, " +
              (median ? "TRUE" : "FALSE") + ")\nsay(" + name + "t', b[1]); say(" + name + "l', b[2]); say(" + name +
              "h', b[3]); say(" + name + "e', b[4])\n";
    if (!two && !median)
      script += "v <- gs[[1]]; o <- boot(v, function(u, k) mean(u[k]), R = " + std::to_string(draws) +
                "); o$t[, 1] <- apply(ds[[1]], 1, function(d) mean(v[d + 1]))\nq <- boot.ci(o, type = 'bca', L = v "
                "- mean(v))$bca\n"
                "say(" +
                name + "bl', q[4]); say(" + name + "bh', q[5])\n";
    answers.push_back(answer_of("bootstrap", grouped(groups),
                                {{"statistic", median ? "median" : "mean"},
                                 {"resamples", std::to_string(draws)},
                                 {"seed", std::to_string(i)}}));
  }
  RAnswers r(script);
  std::size_t through_boot = 0;
  for (std::size_t i = 0; i < sets; ++i) {
    r.expect(i, "t", or_missing(answers[i].estimate), kSameForm);
    if (!answers[i].ci95) continue;
    r.expect(i, "l", low_of(answers[i]), kSameForm);
    r.expect(i, "h", high_of(answers[i]), kSameForm);
    // boot counts draws equal to the estimate as above it.
    if (i % 2 == 0 || i % 4 < 2 || r.of(i, "e") > 0.0) continue;
    ++through_boot;
    r.expect(i, "bl", low_of(answers[i]), kSameForm);
    r.expect(i, "bh", high_of(answers[i]), kSameForm);
  }
  EXPECT_GT(through_boot, 0U);
}

}  // namespace
}  // namespace seldinger::assessment::statistics
