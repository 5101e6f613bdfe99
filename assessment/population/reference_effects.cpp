#include "assessment/population/reference_effects.h"

#include <cmath>

#include "assessment/statistics/distributions.h"

namespace seldinger::assessment::population {
namespace {

using statistics::normal_cdf;
using statistics::normal_pdf;
using statistics::normal_quantile_of;
using statistics::student_t_quantile;

constexpr std::string_view kJohnson = "Johnson et al., Br. J. Radiol. 85, 2012, 555";
constexpr std::string_view kMadsen = "Madsen et al., Ultrasound Obstet. Gynecol. 44, 2014, 693";
constexpr std::string_view kMidterm = "Vidal, thesis, Bangor University 2008, table 6.2";
constexpr std::string_view kFinal = "Vidal, thesis, Bangor University 2008, table 6.3";
constexpr std::string_view kXia = "Xia et al., Proc. SPIE 2018, 10.1117/12.2293789";
constexpr std::string_view kFromT = "d = t √(1/n₁ + 1/n₂)";
constexpr std::string_view kBeforeAfter = "of the two figures given, of the same people";
constexpr std::string_view kFromMeans = "difference of means by the pooled standard deviation";

// d of two means and standard deviations.
constexpr double of_means(double m1, double sd1, double n1, double m2, double sd2, double n2) {
  const double pooled = ((n1 - 1) * sd1 * sd1 + (n2 - 1) * sd2 * sd2) / (n1 + n2 - 2);
  double root = pooled;  // Newton's, for a constant
  for (int i = 0; i < 40; ++i) root = 0.5 * (root + pooled / root);
  return (m2 - m1) / root;
}

constexpr ReferenceEffect difference(std::string_view source, std::string_view what, double d, std::size_t n1,
                                     std::size_t n2, bool selected, bool fitted, std::string_view how) {
  return {source, what, EffectKind::difference, d, n1, n2, 0, selected, fitted, how};
}
// Table 6.3 is what simulated people answer by; table 6.2 is held against that.
constexpr ReferenceEffect answer(std::string_view source, std::string_view what, int statement, double m1,
                                 double sd1, double m2, double sd2, std::size_t n1, std::size_t n2) {
  ReferenceEffect row =
      difference(source, what, of_means(m1, sd1, static_cast<double>(n1), m2, sd2, static_cast<double>(n2)), n1, n2,
                 false, source == kFinal && statement >= 0, kFromMeans);
  row.statement = statement;
  row.of_answers = true;
  return row;
}
constexpr ReferenceEffect share(std::string_view source, std::string_view what, std::size_t hits, std::size_t of,
                                std::size_t n1, std::size_t n2, bool fitted) {
  return {source,
          what,
          EffectKind::discriminating,
          static_cast<double>(hits) / static_cast<double>(of),
          n1,
          n2,
          of,
          false,
          fitted,
          "counted"};
}
// Madsen et al. looked for valid metrics in the first two performances of each module.
constexpr ReferenceEffect of_two(ReferenceEffect row) {
  row.of_two = true;
  return row;
}
constexpr ReferenceEffect as_metric(std::string_view metric, ReferenceEffect row) {
  row.metric = metric;
  return row;
}
// Sources give no standard error of these. `n`: people, who are the same before and after, or of both groups.
constexpr ReferenceEffect ratio(std::string_view source, std::string_view what, double after, double before,
                                std::size_t n, std::string_view how) {
  return {source, what, EffectKind::ratio, after / before, n, 0, 0, false, false, how};
}
constexpr ReferenceEffect level(std::string_view source, std::string_view what, double value) {
  return {source, what, EffectKind::level, value, 0, 0, 0, false, false, "given"};
}
// So many events in so many procedures of n people, were each independent of all others.
constexpr ReferenceEffect rate(std::string_view source, std::string_view what, double events, double procedures,
                               std::size_t n) {
  ReferenceEffect row = level(source, what, events / procedures);
  row.n1 = n;
  double root = events;  // Newton's, for a constant
  for (int i = 0; i < 40; ++i) root = 0.5 * (root + events / root);
  row.error = root / procedures;
  row.how = "counted; standard error by Poisson's law, as if errors were independent";
  return row;
}

// √(1/14 + 1/26), Johnson's consultants and trainees.
constexpr double kJohnsonRoot = 0.331497;

constexpr ReferenceEffect kEffects[] = {
    share(kJohnson, "metrics that told trainees from consultants", 3, 19, 26, 14, true),
    difference(kJohnson, "targeting", 2.487 * kJohnsonRoot, 26, 14, true, true, kFromT),
    difference(kJohnson, "time of using the probe", 2.132 * kJohnsonRoot, 26, 14, true, true, kFromT),
    difference(kJohnson, "mean length of the needle in the beam", 2.272 * kJohnsonRoot, 26, 14, true, true, kFromT),
    of_two(share(kMadsen, "metrics that told novices from consultants", 48, 153, 16, 12, true)),
    {"Virtual prostate biopsy, core.ac.uk 17159683", "score of a prostate biopsy, 52 and 64 %",
     EffectKind::difference, 0.629, 14, 7, 0, false, false, "from p = .19, two-sided t with 19 degrees of freedom"},
    {"PMC5318157", "first pass with needle guidance, 76.4 and 88.9 %", EffectKind::difference, 0.499, 35, 35, 0,
     false, false, "logarithm of the odds ratio by √3/π; the same people"},
    as_metric("swept_area", ratio("Keri et al. 2015, randomised trial with Perk Tutor",
                                  "potential tissue damage with training, 39.7 to 128.3 cm²", 39.7, 128.3, 24,
                                  "of the medians of two groups")),
    as_metric("path_inefficiency",
              ratio(kXia, "path inefficiency after practice, 127.1 to 45.8 %", 45.8, 127.1, 19, kBeforeAfter)),
    as_metric("path_tip",
              ratio(kXia, "needle's path after practice, 58.0 to 41.1 mm", 41.1, 58.0, 19, kBeforeAfter)),
    ratio(kXia, "probe's path after practice, 43.8 to 11.6 mm", 11.6, 43.8, 19, kBeforeAfter),
    as_metric("first_pass_success", level("BMC Med. Educ. 2024, PMC11583760", "first pass", 0.809)),
    level("BMC Med. Educ. 2024, PMC11583760", "complications", 0.191),
    rate("Sites et al., Reg. Anesth. Pain Med. 32, 2007, 107", "errors in a nerve block, 398 in 520", 398.0, 520.0,
         6),
    answer(kMidterm, "likeness to the procedure in patients", -1, 2.26, 1.05, 3.00, 1.73, 19, 3),
    answer(kMidterm, "touch was accurate", 1, 2.58, 0.69, 2.67, 1.53, 19, 3),
    answer(kMidterm, "insertion through skin is realistic", 2, 2.63, 0.96, 3.00, 1.73, 19, 3),
    answer(kMidterm, "insertion through tissues is realistic", 3, 2.84, 0.83, 3.00, 1.73, 19, 3),
    answer(kMidterm, "level of realism", 5, 2.61, 0.92, 2.33, 0.58, 19, 3),
    answer(kFinal, "likeness to the procedure in patients", -1, 2.29, 0.95, 2.80, 1.1, 10, 5),
    answer(kFinal, "US visual elements were of high quality", 0, 3.56, 0.53, 3.80, 0.45, 10, 5),
    answer(kFinal, "touch was accurate", 1, 2.44, 0.88, 3.00, 1.41, 10, 5),
    answer(kFinal, "insertion through skin is realistic", 2, 2.44, 0.53, 3.00, 1.41, 10, 5),
    answer(kFinal, "insertion through tissues is realistic", 3, 2.67, 0.87, 3.25, 1.5, 10, 5),
    answer(kFinal, "cases were appropriately difficult", 4, 3.33, 0.87, 4.00, 1.41, 10, 5),
    answer(kFinal, "level of realism", 5, 2.44, 0.73, 3.67, 0.58, 10, 5),
};

double critical(std::size_t n1, std::size_t n2) {
  return student_t_quantile(0.975, static_cast<double>(n1 + n2 - 2));
}

double root_of(std::size_t n1, std::size_t n2) {
  return std::sqrt(1.0 / static_cast<double>(n1) + 1.0 / static_cast<double>(n2));
}

}  // namespace

std::span<const ReferenceEffect> reference_effects() {
  return kEffects;
}

double difference_of_t(double t, std::size_t n1, std::size_t n2) {
  return t * root_of(n1, n2);
}

double difference_error(double d, std::size_t n1, std::size_t n2) {
  const double root = root_of(n1, n2);
  return std::sqrt(root * root + d * d / (2.0 * static_cast<double>(n1 + n2)));
}

double share_error(double share, std::size_t of) {
  return std::sqrt(share * (1.0 - share) / static_cast<double>(of));
}

std::optional<double> standard_error(const ReferenceEffect& effect) {
  switch (effect.kind) {
    case EffectKind::difference:
      return difference_error(effect.value, effect.n1, effect.n2);
    case EffectKind::discriminating:
      return share_error(effect.value, effect.of);
    case EffectKind::ratio:
    case EffectKind::level:
      break;
  }
  return effect.error > 0.0 ? std::optional(effect.error) : std::nullopt;
}

std::optional<statistics::Interval> interval95(const ReferenceEffect& effect) {
  const auto error = standard_error(effect);
  if (!error) return std::nullopt;
  const double z = normal_quantile_of(0.975);
  if (effect.kind != EffectKind::discriminating)
    return statistics::Interval{effect.value - z * *error, effect.value + z * *error};
  // Wilson's
  const auto n = static_cast<double>(effect.of);
  const double p = effect.value, denominator = 1.0 + z * z / n;
  const double middle = (p + z * z / (2.0 * n)) / denominator;
  const double half = z * std::sqrt(p * (1.0 - p) / n + z * z / (4.0 * n * n)) / denominator;
  return statistics::Interval{middle - half, middle + half};
}

double unselected(double d, std::size_t n1, std::size_t n2) {
  const double root = root_of(n1, n2), z = std::abs(d) / root, c = critical(n1, n2);
  double best = 0.0, most = -1e300;
  for (double delta = 0.0; delta <= z + 1e-9; delta += 0.001) {
    const double selected = normal_cdf(delta - c) + normal_cdf(-delta - c);
    const double likelihood = -0.5 * (z - delta) * (z - delta) - std::log(selected);
    if (likelihood > most) {
      most = likelihood;
      best = delta;
    }
  }
  return std::copysign(best * root, d);
}

Selected selected_of(double true_difference, std::size_t n1, std::size_t n2) {
  const double root = root_of(n1, n2), delta = std::abs(true_difference) / root, c = critical(n1, n2);
  Selected sum;
  sum.power = normal_cdf(delta - c) + normal_cdf(-delta - c);
  // E|Z| beyond ±c of a normal with mean δ.
  const double beyond = delta * normal_cdf(delta - c) + normal_pdf(c - delta) - delta * normal_cdf(-delta - c) +
                        normal_pdf(c + delta);
  sum.mean_size = beyond / sum.power * root;
  return sum;
}

}  // namespace seldinger::assessment::population
