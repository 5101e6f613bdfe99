// Procedures against R of Debian 12 and its packages, and Brunner–Munzel against SciPy, on fresh random data.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <functional>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "assessment/statistics/groups/brunner_munzel.h"
#include "assessment/statistics/groups/describe.h"
#include "assessment/statistics/groups/effect_sizes.h"
#include "assessment/statistics/groups/mann_whitney.h"
#include "assessment/statistics/groups/multiplicity.h"
#include "assessment/statistics/groups/power.h"
#include "assessment/statistics/groups/rank_tests.h"
#include "assessment/statistics/groups/shapiro_wilk.h"
#include "assessment/statistics/groups/signed_rank.h"
#include "assessment/statistics/groups/t_tests.h"
#include "assessment/statistics/groups/variance_analysis.h"
#include "tests/assessment/statistics/groups/random_tables.h"
#include "tests/assessment/statistics/groups/tables.h"
#include "tests/assessment/statistics/r_oracle.h"

namespace seldinger::assessment::statistics {
namespace {

using fixtures::r_sets;
using fixtures::r_vector;

// effectsize looks for a non-centrality by optim(), which in one of some hundred sets stops 0.01 early.
constexpr double kExactly = 1e-9, kIterated = 1e-6, kSearched = 0.02;

// What R is to say, and what it is held against; asked at once, since R takes long to start.
class Questions {
 public:
  void add(const std::string& r) { script_ += r + "\n"; }
  // `r` is an expression of what R holds at that moment.
  void ask(const std::string& r, double got, double tolerance, const std::string& what) {
    const std::string name = "q" + std::to_string(asked_.size());
    script_ += "say(\"" + name + "\", try(" + r + ", silent = TRUE))\n";
    asked_.push_back({got, tolerance, what});
  }
  void ask(const std::string& r, const std::optional<double>& got, double tolerance, const std::string& what) {
    ask(r, got.value_or(std::nan("")), tolerance, what);
  }
  void hold() const {
    const auto values = fixtures::r_values(script_);
    std::map<std::string, double> worst;
    for (std::size_t i = 0; i < asked_.size(); ++i) {
      const double want =
          values.contains("q" + std::to_string(i)) ? values.at("q" + std::to_string(i)) : std::nan("");
      expect_close(asked_[i].got, want, asked_[i].tolerance, asked_[i].what);
      double& largest = worst[asked_[i].what];
      largest = std::max(largest, std::abs(asked_[i].got - want) / std::max(1.0, std::abs(want)));
    }
    for (const auto& [what, difference] : worst)
      testing::Test::RecordProperty(what, std::to_string(difference * 1e12) + "e-12");
    if (std::getenv("SELDINGER_R_WORST") != nullptr)
      for (const auto& [what, difference] : worst) std::printf("%-34s %.1e\n", what.c_str(), difference);
  }

 private:
  struct Asked {
    double got, tolerance;
    std::string what;
  };
  std::string script_;
  std::vector<Asked> asked_;
};

std::string r_groups(const std::vector<Group>& groups) {
  std::string values, names;
  for (const Group& group : groups) {
    values += (values.empty() ? "" : ", ") + r_vector(group.values);
    names +=
        (names.empty() ? "" : ", ") + ("rep(\"" + group.name + "\", " + std::to_string(group.values.size()) + ")");
  }
  std::string r = "v <- c(" + values + "); g <- factor(c(" + names + ")); g <- g[!is.na(v)]; v <- v[!is.na(v)]\n";
  return r + "x <- v[g == \"a\"]; y <- v[g == \"b\"]";
}

// The kind of set: every fourth has ties and gaps.
bool tied(std::size_t set) {
  return set % 2 == 1;
}
bool gapped(std::size_t set) {
  return set % 4 >= 2;
}

TEST(AgainstR, Means) {
  SELDINGER_NEEDS_R();
  Questions questions;
  questions.add("library(car)");
  RandomTables random(oracle_seed());
  for (std::size_t set = 0; set < r_sets(); ++set) {
    const std::vector<Group> three = random.groups(3, 4, 20, tied(set), gapped(set));
    const DataTable two = table_of({three[0], three[1]}), all = table_of(three);
    questions.add(r_groups(three) + "\nw <- t.test(x, y); s <- t.test(x, y, var.equal = TRUE)");
    const Answer t = welch(two, {});
    questions.ask("w$statistic", t.statistic, kExactly, "welch t");
    questions.ask("w$parameter", t.df.at(0), kExactly, "welch df");
    questions.ask("w$p.value", t.p_value, kExactly, "welch p");
    questions.ask("w$conf.int[1]", t.ci95.value().low, kExactly, "welch low");
    questions.ask("w$conf.int[2]", t.ci95.value().high, kExactly, "welch high");
    const Answer equal = student(two, {});
    questions.ask("s$statistic", equal.statistic, kExactly, "student t");
    questions.ask("s$p.value", equal.p_value, kExactly, "student p");
    questions.ask("s$conf.int[1]", equal.ci95.value().low, kExactly, "student low");
    const Answer equivalent = tost(two, with({{"low", "-1.5"}, {"high", "2"}}));
    questions.ask(
        "max(t.test(x, y, mu = -1.5, alternative = \"greater\")$p.value, t.test(x, y, mu = 2, alternative = "
        "\"less\")$p.value)",
        equivalent.p_value, kExactly, "tost p");
    questions.ask("t.test(x, y, conf.level = .9)$conf.int[1]", more(equivalent, "ci90_low"), kExactly, "tost 90 %");
    questions.add("a <- oneway.test(v ~ g)");
    const Answer anova = welch_anova(all, {});
    questions.ask("a$statistic", anova.statistic, kExactly, "welch_anova F");
    questions.ask("a$parameter[2]", anova.df.at(1), kExactly, "welch_anova df");
    questions.ask("a$p.value", anova.p_value, kExactly, "welch_anova p");
    questions.add("l <- leveneTest(v, g, center = median)");
    const Answer spreads = brown_forsythe(all, {});
    questions.ask("l[1, 2]", spreads.statistic, kExactly, "brown_forsythe F");
    questions.ask("l[1, 3]", spreads.p_value, kExactly, "brown_forsythe p");
    const Answer described = describe(table_of(three[0].values), {});
    questions.ask("mean(x)", described.estimate, kExactly, "mean");
    questions.ask("sd(x)", more(described, "sd"), kExactly, "sd");
    questions.ask("quantile(x, .25)", more(described, "q1"), kExactly, "q1");
    questions.ask("IQR(x)", more(described, "iqr"), kExactly, "iqr");
    questions.ask("mad(x)", more(described, "mad"), kExactly, "mad");
    questions.ask("t.test(x)$conf.int[2]", described.ci95.value().high, kExactly, "interval of the mean");
    const Answer normal = shapiro(all, {});
    questions.ask("shapiro.test(x)$statistic", in_row(normal, "a", "w"), kIterated, "shapiro W");
    questions.ask("shapiro.test(x)$p.value", in_row(normal, "a", "p"), kIterated, "shapiro p");
  }
  questions.hold();
}

// Each size has coefficients of its own up to 11.
TEST(AgainstR, ShapiroWilkOfEverySize) {
  SELDINGER_NEEDS_R();
  Questions questions;
  RandomTables random(oracle_seed() + 1);
  for (std::size_t n = 3; n <= 40; ++n)
    for (const bool ties : {false, true}) {
      const std::vector<double> values = random.values(n, 0.0, 3.0, ties, false);
      const ShapiroWilk test = shapiro_wilk(values);
      questions.add("s <- shapiro.test(" + r_vector(values) + ")");
      questions.ask("s$statistic", test.w, kIterated, n < 12 ? "shapiro W below 12" : "shapiro W");
      questions.ask("s$p.value", test.p_value, kIterated, n < 12 ? "shapiro p below 12" : "shapiro p");
    }
  questions.hold();
}

TEST(AgainstR, RanksOfGroups) {
  SELDINGER_NEEDS_R();
  Questions questions;
  questions.add("library(coin); library(rstatix)");
  RandomTables random(oracle_seed() + 2);
  for (std::size_t set = 0; set < r_sets(); ++set) {
    const std::vector<Group> three = random.groups(3, 4, 20, tied(set), gapped(set));
    const DataTable two = table_of({three[0], three[1]}), all = table_of(three);
    questions.add(r_groups(three) +
                  "\ntwo <- data.frame(v = c(x, y), g = factor(rep(1:2, c(length(x), length(y)))))");
    const Answer test = mann_whitney(two, {});
    questions.ask("pvalue(coin::wilcox_test(v ~ g, two, distribution = \"exact\"))", test.p_value, kExactly,
                  "mann_whitney exact p");
    questions.ask("wilcox.test(x, y)$statistic", test.statistic, kExactly, "mann_whitney U");
    questions.ask("wilcox.test(x, y, exact = FALSE)$p.value",
                  mann_whitney(two, with({{"method", "asymptotic"}})).p_value, kExactly,
                  "mann_whitney asymptotic p");
    questions.ask("median(outer(x, y, \"-\"))", test.estimate, kExactly, "mann_whitney shift");
    if (!tied(set)) {
      questions.add("i <- wilcox.test(x, y, exact = TRUE, conf.int = TRUE)$conf.int");
      if (test.ci95) questions.ask("i[1]", test.ci95->low, kExactly, "mann_whitney low");
      if (test.ci95) questions.ask("i[2]", test.ci95->high, kExactly, "mann_whitney high");
    }
    const Answer several = kruskal(all, {});
    questions.ask("kruskal.test(v, g)$statistic", several.statistic, kExactly, "kruskal H");
    questions.ask("kruskal.test(v, g)$p.value", several.p_value, kExactly, "kruskal p");
    questions.add("d <- dunn_test(data.frame(v, g), v ~ g, p.adjust.method = \"holm\")");
    const Answer pairs = dunn(all, {});
    questions.ask("d$statistic[2]", in_row(pairs, "a – c", "z"), kExactly, "dunn z");
    questions.ask("d$p.adj[3]", in_row(pairs, "b – c", "p_holm"), kExactly, "dunn Holm");
  }
  questions.hold();
}

TEST(AgainstR, Pairs) {
  SELDINGER_NEEDS_R();
  Questions questions;
  questions.add("library(coin)");
  RandomTables random(oracle_seed() + 3);
  for (std::size_t set = 0; set < r_sets(); ++set) {
    const std::size_t n = random.from_to(6, 20);
    std::vector<Group> conditions;
    for (const char* name : {"a", "b", "c"})
      conditions.push_back({name, random.values(n, random.normal(), 2.0, tied(set), gapped(set))});
    const DataTable two = table_of_persons({conditions[0], conditions[1]}), all = table_of_persons(conditions);
    questions.add("m <- cbind(" + r_vector(conditions[0].values) + ", " + r_vector(conditions[1].values) + ", " +
                  r_vector(conditions[2].values) +
                  ")\np <- na.omit(m[, 1:2]); x <- p[, 1]; y <- p[, 2]; d <- x - y");
    const Answer t = paired(two, {});
    questions.ask("t.test(x, y, paired = TRUE)$statistic", t.statistic, kExactly, "paired t");
    questions.ask("t.test(x, y, paired = TRUE)$p.value", t.p_value, kExactly, "paired p");
    questions.ask("t.test(x, y, paired = TRUE)$conf.int[1]", t.ci95.value().low, kExactly, "paired low");
    const std::string exact = "pvalue(wilcoxsign_test(x ~ y, distribution = \"exact\", zero.method = ";
    questions.ask(exact + "\"Wilcoxon\"))", wilcoxon(two, {}).p_value, kExactly, "wilcoxon p");
    questions.ask(exact + "\"Pratt\"))", wilcoxon(two, with({{"zeros", "pratt"}})).p_value, kExactly,
                  "wilcoxon Pratt");
    questions.ask("wilcox.test(x, y, paired = TRUE)$statistic", wilcoxon(two, {}).statistic, kExactly,
                  "wilcoxon V");
    std::vector<double> differences;
    for (std::size_t i = 0; i < n; ++i) differences.push_back(conditions[0].values[i] - conditions[1].values[i]);
    differences = present(differences);
    questions.ask("wilcox.test(d, exact = FALSE)$p.value", normal_signed_rank(differences, false).p_value, kExactly,
                  "wilcoxon asymptotic p");
    questions.ask("{w <- outer(d, d, \"+\") / 2; median(w[lower.tri(w, TRUE)])}", wilcoxon(two, {}).estimate,
                  kExactly, "wilcoxon middle");
    if (const Shift shift = pseudo_median(differences); !tied(set) && shift.ci95) {
      questions.add("w <- wilcox.test(d, exact = TRUE, conf.int = TRUE)");
      questions.ask("w$conf.int[1]", shift.ci95->low, kExactly, "wilcoxon low");
      questions.ask("w$conf.int[2]", shift.ci95->high, kExactly, "wilcoxon high");
    }
    const Answer blocks = friedman(all, {});
    questions.ask("friedman.test(na.omit(m))$statistic", blocks.statistic, kExactly, "friedman χ²");
    questions.ask("friedman.test(na.omit(m))$p.value", blocks.p_value, kExactly, "friedman p");
  }
  questions.hold();
}

TEST(AgainstR, EffectSizes) {
  SELDINGER_NEEDS_R();
  Questions questions;
  questions.add("library(effectsize)");
  RandomTables random(oracle_seed() + 4);
  for (std::size_t set = 0; set < r_sets(); ++set) {
    const std::vector<Group> two = random.groups(2, 4, 25, tied(set), gapped(set));
    questions.add(r_groups(two));
    const Answer answer = effect_size(table_of(two), {});
    const std::vector<std::pair<std::string, std::string>> effects = {
        {"cohen_d", "cohens_d(x, y)"},
        {"hedges_g", "hedges_g(x, y)"},
        {"glass_delta", "glass_delta(x, y)"},
        {"d_unpooled", "cohens_d(x, y, pooled_sd = FALSE)"},
        {"cliff_delta", "rank_biserial(x, y)"}};
    for (const auto& [name, r] : effects) {
      const double value = in_row(answer, name, "value");
      questions.add("e <- " + r);
      questions.ask("e[[1]]", value, kExactly, name);
      if (name == "cliff_delta" && std::abs(value) == 1.0) continue;  // R has no interval then
      questions.ask("e$CI_low", in_row(answer, name, "ci95_low"), kSearched, name + " low");
      questions.ask("e$CI_high", in_row(answer, name, "ci95_high"), kSearched, name + " high");
    }
    // R's distribution at our limits, without its search.
    questions.add(
        "m <- length(x); n <- length(y); vx <- var(x); vy <- var(y); pooled <- ((m - 1) * vx + (n - 1) * vy) / (m "
        "+ n - 2)");
    questions.add("off <- mean(x) - mean(y); h <- sqrt(1 / m + 1 / n)");
    const auto ask_chances = [&](const std::string& name, const std::string& t, const std::string& df,
                                 const std::string& scale) {
      for (const auto& [end, chance] : {std::pair("ci95_low", 0.975), {"ci95_high", 0.025}}) {
        const std::string limit = r_vector(std::vector{in_row(answer, name, end)});
        questions.ask("pt(" + t + ", " + df + ", " + limit + " / (" + scale + "))", chance, kExactly,
                      name + ", chance at its limits");
      }
    };
    ask_chances("cohen_d", "off / sqrt(pooled) / h", "m + n - 2", "h");
    ask_chances("glass_delta", "off / sqrt(vy / n + vx / m)", "n - 1", "sqrt(1 / n + vx / vy / m)");
    ask_chances("d_unpooled", "off / sqrt(vx / m + vy / n)", "t.test(x, y)$parameter",
                "sqrt((vx / m + vy / n) / ((vx + vy) / 2))");
  }
  questions.hold();
}

TEST(AgainstR, Families) {
  SELDINGER_NEEDS_R();
  Questions questions;
  questions.add("suppressMessages(library(multtest))");
  RandomTables random(oracle_seed() + 5);
  for (std::size_t set = 0; set < r_sets(); ++set) {
    std::vector<double> p;
    for (std::size_t i = random.from_to(1, 20); i > 0; --i) p.push_back(random.uniform() * random.uniform());
    questions.add("p <- " + r_vector(p));
    for (std::size_t i = 0; i < p.size(); ++i) {
      const std::string at = "[" + std::to_string(i + 1) + "]";
      questions.ask("p.adjust(p, \"holm\")" + at, holm_adjusted(p)[i], 1e-12, "holm");
      questions.ask("p.adjust(p, \"BH\")" + at, bh_adjusted(p)[i], 1e-12, "bh");
    }
    const std::size_t n1 = random.from_to(3, 5), n2 = random.from_to(3, 5);
    std::vector<std::vector<double>> outcomes;
    std::string rows;
    for (std::size_t k = 0; k < 4; ++k) {
      outcomes.push_back(random.values(n1 + n2, 0.0, 2.0, false, false));
      for (std::size_t i = 0; i < n1; ++i) outcomes[k][i] += k > 0 ? 0.5 * outcomes[k - 1][i] + 1.0 : 0.0;
      rows += (rows.empty() ? "" : ", ") + r_vector(outcomes[k]);
    }
    std::vector<char> is_first(n1 + n2, 0);
    for (std::size_t i = 0; i < n1; ++i) is_first[i] = 1;
    const MaxT test = max_t_test(outcomes, is_first, 10'000, 1);
    EXPECT_TRUE(test.all);
    questions.add("invisible(capture.output(r <- mt.maxT(rbind(" + rows + "), rep(0:1, c(" + std::to_string(n1) +
                  ", " + std::to_string(n2) + ")), B = 0))); r <- r[order(r$index), ]");
    for (std::size_t k = 0; k < outcomes.size(); ++k) {
      const std::string at = "[" + std::to_string(k + 1) + "]";
      questions.ask("abs(r$teststat" + at + ")", test.t[k], kExactly, "max_t |T|");
      questions.ask("r$rawp" + at, test.raw[k], kExactly, "max_t raw p");
      questions.ask("r$adjp" + at, test.adjusted[k], kExactly, "max_t adjusted p");
    }
  }
  questions.hold();
}

TEST(AgainstR, Planning) {
  SELDINGER_NEEDS_R();
  Questions questions;
  questions.add("library(pwr)");
  RandomTables random(oracle_seed() + 6);
  for (std::size_t set = 0; set < r_sets(); ++set) {
    const double n1 = static_cast<double>(random.from_to(3, 40)), n2 = static_cast<double>(random.from_to(3, 40));
    const double d = 0.2 + 1.5 * random.uniform(), aim = 0.6 + 0.35 * random.uniform();
    const std::string numbers = "n1 <- " + std::to_string(n1) + "; n2 <- " + std::to_string(n2);
    questions.add(numbers + "; d <- " + r_vector(std::vector{d}) + "; aim <- " + r_vector(std::vector{aim}));
    questions.ask("pwr.t2n.test(n1, n2, d)$power", t_test_power(n1, n2, d, 0.05), kExactly, "power of t");
    questions.ask("pwr.t2n.test(n1, n2, d = NULL, power = aim)$d", t_test_detectable(n1, n2, aim, 0.05), 1e-4,
                  "detectable d");
    questions.ask("pwr.t2n.test(n1, n2, " + r_vector(std::vector{t_test_detectable(n1, n2, aim, 0.05)}) + ")$power",
                  aim, kExactly, "power at the detectable d");
    questions.ask("pwr.t.test(n = " + r_vector(std::vector{t_test_n(d, aim, 0.05)}) + ", d = d)$power", aim,
                  kExactly, "power at the n");
    questions.ask("pwr.anova.test(k = 3, n = n1, f = " +
                      r_vector(std::vector{detectable_f(3.0, 3.0 * n1, aim, 0.05)}) + ")$power",
                  aim, 1e-8, "power at the detectable f");
    questions.ask("pwr.chisq.test(w = sqrt(" + r_vector(std::vector{detectable_noncentrality(4.0, aim, 0.05)}) +
                      " / 100), N = 100, df = 4)$power",
                  aim, kExactly, "power at the detectable non-centrality");
  }
  questions.hold();
}

TEST(AgainstSciPy, BrunnerMunzel) {
  if (std::system("/usr/bin/python3 -c 'import scipy.stats' >/dev/null 2>&1") != 0)
    GTEST_SKIP() << "there is no SciPy (Debian: python3-scipy): no oracle to ask";
  const auto folder = fixtures::fresh_folder("scipy_oracle");
  std::ofstream script(folder / "oracle.py");
  script << "from scipy.stats import brunnermunzel\ndef say(x, y):\n  r = brunnermunzel(x, y)\n"
            "  print(repr(float(r.statistic)), repr(float(r.pvalue)))\n";
  RandomTables random(oracle_seed() + 7);
  std::vector<std::vector<Group>> sets;
  for (std::size_t set = 0; set < r_sets(); ++set) {
    sets.push_back(random.groups(2, 15, 30, tied(set), false));
    script << "say(" << r_vector(sets.back()[0].values).substr(1) << ", "
           << r_vector(sets.back()[1].values).substr(1) << ")\n";
  }
  script.close();
  const std::string said = (folder / "said.txt").string();
  ASSERT_EQ(std::system(("/usr/bin/python3 '" + (folder / "oracle.py").string() + "' > '" + said + "'").c_str()),
            0);
  std::ifstream answers(said);
  for (const std::vector<Group>& groups : sets) {
    double statistic = 0.0, p_value = 0.0;
    ASSERT_TRUE(answers >> statistic >> p_value);
    const Answer answer = brunner_munzel(table_of(groups), {});
    // SciPy's is above 0 where the second group is the larger.
    fixtures::note_difference(answer.statistic.value_or(NAN), -statistic);
    fixtures::note_difference(answer.p_value.value_or(NAN), p_value);
    expect_close(answer.statistic, -statistic, kExactly, "brunner_munzel statistic");
    expect_close(answer.p_value, p_value, kExactly, "brunner_munzel p");
  }
}

}  // namespace
}  // namespace seldinger::assessment::statistics
