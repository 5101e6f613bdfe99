// Shares, correlations, areas and counts of random tables against R.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/assessment/statistics/relations/random_tables.h"

namespace seldinger::assessment::statistics {
namespace {

using fixtures::answer_of;
using fixtures::grouped;
using fixtures::high_of;
using fixtures::low_of;
using fixtures::named;
using fixtures::or_missing;
using fixtures::r_sets;
using fixtures::RandomTables;
using fixtures::RAnswers;
using fixtures::script_of;

constexpr double kClosedForm = 1e-9;

TEST(RelationsR, SharesAreItsShares) {
  SELDINGER_NEEDS_R();
  RandomTables random(1);
  std::vector<DataTable> tables;
  for (std::size_t i = 0; i < r_sets(); ++i) {
    const double p = random.uniform(), q = random.uniform();
    std::vector<double> a = random.some(random.from_to(3, 40), [&] { return random.one_or_zero(p); });
    std::vector<double> b = random.some(random.from_to(3, 40), [&] { return random.one_or_zero(q); });
    random.lose_some(a);
    random.lose_some(b);
    tables.push_back(grouped({a, b}));
  }
  // fisher.test finds odds ratios to four digits only; the same equations are solved to all.
  RAnswers r(script_of(tables, R"(
odds <- function(x, m, n, k) {
  lo <- max(0, k - n); hi <- min(k, m); s <- lo:hi; l <- dhyper(s, m, n, k, log = TRUE)
  d <- function(b) { e <- l + b * s; e <- exp(e - max(e)); e / sum(e) }
  root <- function(f) exp(uniroot(f, c(-100, 100), tol = 1e-15, maxiter = 9999)$root)
  c(if (x == lo) 0 else if (x == hi) NA else root(function(b) sum(s * d(b)) - x),
    if (x == lo) 0 else root(function(b) sum(d(b)[s >= x]) - .025),
    if (x == hi) NA else root(function(b) sum(d(b)[s <= x]) - .025)) })",
                       R"(
k <- sum(v); n <- length(v); w <- prop.test(k, n, correct = FALSE)$conf.int; b <- binom.test(k, n)$conf.int
s('wl', w[1]); s('wh', w[2]); s('cl', b[1]); s('ch', b[2])
y <- factor(v, c(1, 0)); t <- table(g, y); f <- fisher.test(t); s('p', f$p.value)
o <- odds(t[1, 1], sum(t[1, ]), sum(t[2, ]), sum(t[, 1]))
if (k == 0 || k == n) o <- c(NA, NA, NA)
s('or', o[1]); s('ol', if (is.na(o[3])) NA else o[2]); s('oh', o[3]); s('rough', if (is.na(o[1])) NA else f$estimate)
a <- prop.test(t[1, 1], sum(t[1, ]), correct = FALSE)$conf.int; c <- prop.test(t[2, 1], sum(t[2, ]), correct = FALSE)$conf.int
p <- t[, 1] / rowSums(t)
s('nl', p[1] - p[2] - sqrt((p[1] - a[1])^2 + (c[2] - p[2])^2)); s('nh', p[1] - p[2] + sqrt((a[2] - p[1])^2 + (p[2] - c[1])^2))
)"));
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const Answer one = answer_of("wilson", tables[i]), two = answer_of("fisher", tables[i]);
    r.expect(i, "wl", low_of(one), kClosedForm);
    r.expect(i, "wh", high_of(one), kClosedForm);
    r.expect(i, "cl", named(one, "clopper_pearson_low"), kClosedForm);
    r.expect(i, "ch", named(one, "clopper_pearson_high"), kClosedForm);
    r.expect(i, "p", or_missing(two.p_value), kClosedForm);
    r.expect(i, "or", or_missing(two.estimate), kClosedForm);
    r.expect(i, "ol", low_of(two), kClosedForm);
    r.expect(i, "oh", high_of(two), kClosedForm);
    r.expect(i, "nl", named(two, "risk_difference_low"), kClosedForm);
    r.expect(i, "nh", named(two, "risk_difference_high"), kClosedForm);
    if (two.estimate) {
      EXPECT_NEAR(*two.estimate, r.of(i, "rough"), 1e-2 * std::max(1.0, *two.estimate)) << i;
    }
  }
}

bool tied(const std::vector<double>& values) {
  const std::vector<double> there = present(values);
  return std::set<double>(there.begin(), there.end()).size() < there.size();
}

TEST(RelationsR, CorrelationsAreItsCorrelations) {
  SELDINGER_NEEDS_R();
  RandomTables random(2);
  std::vector<DataTable> tables;
  for (std::size_t i = 0; i < r_sets(); ++i) {
    const std::size_t n = random.from_to(7, i % 4 == 0 ? 9 : 60);
    const double slope = 2.0 * random.uniform() - 1.0, grain = i % 3 == 0 ? 1.0 : 0.0;
    std::vector<double> x = random.some(n, [&] { return random.normal(); }), y;
    for (double& value : x) {
      y.push_back(slope * value + random.normal());
      if (grain > 0.0) value = std::round(2.0 * value), y.back() = std::round(y.back());
    }
    random.lose_some(x);
    random.lose_some(y);
    tables.push_back(fixtures::related(y, x));
  }
  RAnswers r(script_of(tables, "", R"(
n <- length(v); p <- cor.test(v, x); s('r', p$estimate); s('t', p$statistic); s('rp', p$p.value)
s('rl', p$conf.int[1]); s('rh', p$conf.int[2])
ties <- anyDuplicated(v) || anyDuplicated(x)
sp <- cor.test(v, x, method = 'spearman', exact = n <= 9 && !ties); s('rho', sp$estimate); s('rhop', sp$p.value)
h <- qnorm(.975) * sqrt((1 + sp$estimate^2 / 2) / (n - 3)); s('rhol', tanh(atanh(sp$estimate) - h)); s('rhoh', tanh(atanh(sp$estimate) + h))
k <- cor.test(v, x, method = 'kendall', exact = n < 50 && !ties); s('tau', k$estimate); s('taup', k$p.value)
h <- qnorm(.975) * sqrt(.437 / (n - 4)); s('taul', tanh(atanh(k$estimate) - h)); s('tauh', tanh(atanh(k$estimate) + h))
)"));
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const Answer pearson = answer_of("pearson", tables[i]), spearman = answer_of("spearman", tables[i]);
    const Answer kendall = answer_of("kendall", tables[i]);
    r.expect(i, "r", or_missing(pearson.estimate), kClosedForm);
    r.expect(i, "t", or_missing(pearson.statistic), kClosedForm);
    r.expect(i, "rp", or_missing(pearson.p_value), kClosedForm);
    r.expect(i, "rl", low_of(pearson), kClosedForm);
    r.expect(i, "rh", high_of(pearson), kClosedForm);
    r.expect(i, "rho", or_missing(spearman.estimate), kClosedForm);
    if (spearman.ci95) {  // R's formula has one without width where all are in order
      r.expect(i, "rhol", low_of(spearman), kClosedForm);
      r.expect(i, "rhoh", high_of(spearman), kClosedForm);
    } else if (spearman.n > 3) {
      EXPECT_NEAR(std::abs(r.of(i, "rho")), 1.0, 1e-12);
    }
    r.expect(i, "tau", or_missing(kendall.estimate), kClosedForm);
    if (kendall.ci95) {
      r.expect(i, "taul", low_of(kendall), kClosedForm);
      r.expect(i, "tauh", high_of(kendall), kClosedForm);
    } else if (kendall.n > 4) {
      EXPECT_NEAR(std::abs(r.of(i, "tau")), 1.0, 1e-12);
    }
    // Up to nine persons with ties are exact here, and not in R.
    if (pearson.n <= 9 && (tied(tables[i].values[0].values) || tied(tables[i].x))) continue;
    r.expect(i, "rhop", or_missing(spearman.p_value), kClosedForm);
    r.expect(i, "taup", or_missing(kendall.p_value), kClosedForm);
  }
}

TEST(RelationsR, AreasAreThoseOfPRoc) {
  SELDINGER_NEEDS_R();
  RandomTables random(3);
  std::vector<DataTable> tables;
  for (std::size_t i = 0; i < r_sets(); ++i) {
    const double grain = i % 2 == 0 ? 2.0 : 1e6;
    const std::size_t n = random.from_to(5, 40), m = random.from_to(5, 40);
    DataTable table = grouped({std::vector<double>(n, 0.0), std::vector<double>(m, 0.0)});
    table.values.push_back({"other", {}});
    for (std::size_t j = 0; j < table.rows; ++j) {
      const double skill = random.normal() + (j < n ? 0.0 : 0.7);
      table.values[0].values[j] = std::round(grain * (skill + 0.5 * random.normal())) / grain;
      table.values[1].values.push_back(std::round(grain * (skill + random.normal())) / grain);
    }
    random.lose_some(table.values[0].values);
    random.lose_some(table.values[1].values);
    tables.push_back(table);
  }
  RAnswers r(script_of(tables, "suppressMessages(library(pROC))", R"(
one <- function(u) roc(g, u, levels = c('a', 'b'), direction = '<', quiet = TRUE)
a <- one(v); b <- one(w); s('auc', a$auc); s('se', sqrt(var(a, method = 'delong')))
y <- coords(a, 'best', ret = c('sensitivity', 'specificity'), transpose = FALSE); s('youden', y[1, 1] + y[1, 2])
d <- ci.auc(a, method = 'delong'); s('dl', d[1]); s('dh', d[3])
l <- qlogis(a$auc); h <- qnorm(.975) * sqrt(var(a)) / (a$auc * (1 - a$auc)); s('ll', plogis(l - h)); s('lh', plogis(l + h))
t <- roc.test(a, b, method = 'delong', paired = TRUE); s('z', t$statistic); s('p', t$p.value)
)"));
  for (std::size_t i = 0; i < tables.size(); ++i) {
    // pROC is given the rows where both values are there.
    DataTable table = tables[i];
    for (std::size_t j = 0; j < table.rows; ++j)
      if (std::isnan(table.values[1].values[j])) table.values[0].values[j] = fixtures::kMissing;
    const Answer auc = answer_of("auc", table), delong = answer_of("delong", tables[i]);
    r.expect(i, "auc", or_missing(auc.estimate), kClosedForm);
    r.expect(i, "se", named(auc, "delong_se"), kClosedForm);
    r.expect(i, "dl", named(auc, "delong_low"), kClosedForm);
    r.expect(i, "dh", named(auc, "delong_high"), kClosedForm);
    r.expect(i, "ll", low_of(auc), kClosedForm);
    r.expect(i, "lh", high_of(auc), kClosedForm);
    r.expect(i, "youden", named(auc, "youden_sensitivity") + named(auc, "youden_specificity"), kClosedForm);
    r.expect(i, "z", or_missing(delong.statistic), kClosedForm);
    r.expect(i, "p", or_missing(delong.p_value), kClosedForm);
  }
}

TEST(RelationsR, SubarachnoidHaemorrhageIsAsPublished) {
  SELDINGER_NEEDS_R();
  // The 113 patients are read from pROC: their oracle values were stored from another run of it.
  std::string script = "suppressMessages(library(pROC)); data(aSAH)\nfor (i in 1:113) {\n";
  for (const char* column : {"s100b", "ndka", "wfns"})
    script += std::string("say(paste0('") + column + "', i), as.numeric(aSAH$" + column + "[i]))\n";
  const auto values = fixtures::r_values(script + "say(paste0('poor', i), aSAH$outcome[i] == 'Poor') }\n");
  const auto table_of = [&](const std::vector<std::string>& columns) {
    DataTable table;
    table.rows = 113;
    for (const std::string& column : columns) {
      table.values.push_back({column, {}});
      for (int i = 1; i <= 113; ++i) table.values.back().values.push_back(values.at(column + std::to_string(i)));
    }
    for (int i = 1; i <= 113; ++i)
      table.group.push_back(values.at("poor" + std::to_string(i)) == 1.0 ? "Poor" : "Good");
    return table;
  };
  const Answer s100b = answer_of("auc", table_of({"s100b"}));
  fixtures::expect_near_relative(or_missing(s100b.estimate), 0.73136856368564, kClosedForm, "area");
  fixtures::expect_near_relative(named(s100b, "delong_low"), 0.63011821176162, kClosedForm, "low");
  fixtures::expect_near_relative(named(s100b, "delong_high"), 0.83261891560965, kClosedForm, "high");
  fixtures::expect_near_relative(std::pow(named(s100b, "delong_se"), 2), 0.00266868245717, kClosedForm, "variance");
  fixtures::expect_near_relative(named(s100b, "youden_cut"), 0.205, kClosedForm, "cut");
  fixtures::expect_near_relative(named(s100b, "youden_specificity"), 0.805555555556, kClosedForm, "specificity");
  fixtures::expect_near_relative(named(s100b, "youden_sensitivity"), 0.634146341463, kClosedForm, "sensitivity");
  const Answer ndka = answer_of("auc", table_of({"ndka"})), wfns = answer_of("auc", table_of({"wfns"}));
  fixtures::expect_near_relative(or_missing(ndka.estimate), 0.61195799457995, kClosedForm, "ndka");
  fixtures::expect_near_relative(or_missing(wfns.estimate), 0.82367886178862, kClosedForm, "wfns");
  const Answer pair = answer_of("delong", table_of({"s100b", "wfns"}));
  fixtures::expect_near_relative(or_missing(pair.statistic), -2.2089835914409, kClosedForm, "Z");
  fixtures::expect_near_relative(or_missing(pair.p_value), 0.0271757822292, kClosedForm, "p");
  const Answer other = answer_of("delong", table_of({"s100b", "ndka"}));
  fixtures::expect_near_relative(or_missing(other.statistic), 1.390770025736, kClosedForm, "Z");
}

TEST(RelationsR, CountsAreThoseOfRAndMass) {
  SELDINGER_NEEDS_R();
  RandomTables random(4);
  std::vector<DataTable> tables;
  for (std::size_t i = 0; i < r_sets(); ++i) {
    const std::size_t n = random.from_to(8, 30), m = random.from_to(8, 30);
    const double mean = 1.0 + 5.0 * random.uniform(), other = 1.0 + 5.0 * random.uniform();
    std::vector<double> a = random.some(n, [&] { return random.overdispersed(mean); });
    std::vector<double> b = random.some(m, [&] { return random.overdispersed(other); });
    a.front() = b.front() = 2.0;
    std::vector<double> exposure;
    if (i % 2 == 0) exposure = random.some(n + m, [&] { return 0.5 + random.uniform(); });
    DataTable table = grouped({a, b}, exposure);
    random.lose_some(table.values[0].values);
    if (!table.x.empty()) random.lose_some(table.x);
    table.values[0].values[0] = table.values[0].values[n] = 2.0;
    if (!table.x.empty()) table.x[0] = table.x[n] = 1.0;
    tables.push_back(table);
  }
  RAnswers r(script_of(tables, "suppressMessages(library(MASS))", R"(
e <- if (all(x == 0)) x + 1 else x; g <- factor(g, c('b', 'a'))
k <- c(sum(v[g == 'a']), sum(v[g == 'b'])); t <- c(sum(e[g == 'a']), sum(e[g == 'b'])); p <- poisson.test(k, t)
s('p', p$p.value); s('rr', p$estimate); s('rl', p$conf.int[1]); s('rh', p$conf.int[2])
m <- glm.nb(v ~ g + offset(log(e)), control = glm.control(epsilon = 1e-14, maxit = 500)); f <- summary(m)$coefficients
s('theta', m$theta); s('b', f[2, 1]); s('se', f[2, 2]); s('nbp', f[2, 4])
)"));
  std::size_t fitted = 0;
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const Answer poisson = answer_of("poisson", tables[i]), many = answer_of("negative_binomial", tables[i]);
    r.expect(i, "p", or_missing(poisson.p_value), kClosedForm);
    r.expect(i, "rr", or_missing(poisson.estimate), kClosedForm);
    r.expect(i, "rl", low_of(poisson), kClosedForm);
    r.expect(i, "rh", high_of(poisson), kClosedForm);
    // Near Poisson's, where θ is without bound, glm.nb gives up somewhere.
    if (!(named(many, "theta") < 50.0)) continue;
    ++fitted;
    r.expect(i, "theta", named(many, "theta"), 1e-5);
    r.expect(i, "b", named(many, "log_rate_ratio"), 1e-6);
    r.expect(i, "se", named(many, "standard_error"), 1e-6);
    r.expect(i, "nbp", or_missing(many.p_value), 1e-6);
  }
  EXPECT_GT(fitted, tables.size() / 2);
}

}  // namespace
}  // namespace seldinger::assessment::statistics
