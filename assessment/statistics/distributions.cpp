#include "assessment/statistics/distributions.h"

#include <boost/math/distributions/beta.hpp>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/non_central_chi_squared.hpp>
#include <boost/math/distributions/non_central_f.hpp>
#include <boost/math/distributions/non_central_t.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/poisson.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/policies/policy.hpp>
#include <boost/math/special_functions/digamma.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <boost/math/special_functions/trigamma.hpp>
#include <cmath>
#include <exception>
#include <limits>

namespace seldinger::assessment::statistics {
namespace {

namespace math = boost::math;
namespace rules = boost::math::policies;

// No exception for what a number says as well; in double throughout, so that every machine answers alike.
using Policy =
    rules::policy<rules::domain_error<rules::ignore_error>, rules::pole_error<rules::ignore_error>,
                  rules::overflow_error<rules::ignore_error>, rules::underflow_error<rules::ignore_error>,
                  rules::evaluation_error<rules::ignore_error>, rules::promote_double<false>>;

// Some of Boost's functions throw all the same, where an iteration does not end.
template <typename Function>
double or_nan(const Function& function) {
  try {
    return static_cast<double>(function());
  } catch (const std::exception&) {
    return std::numeric_limits<double>::quiet_NaN();
  }
}

template <typename Distribution>
double below(const Distribution& distribution, double x) {
  return or_nan([&] { return math::cdf(distribution, x); });
}

template <typename Distribution>
double above(const Distribution& distribution, double x) {
  return or_nan([&] { return math::cdf(math::complement(distribution, x)); });
}

template <typename Distribution>
double where(const Distribution& distribution, double p) {
  return or_nan([&] { return math::quantile(distribution, p); });
}

using Normal = math::normal_distribution<double, Policy>;
using StudentT = math::students_t_distribution<double, Policy>;
using FisherF = math::fisher_f_distribution<double, Policy>;
using ChiSquared = math::chi_squared_distribution<double, Policy>;
using Beta = math::beta_distribution<double, Policy>;
using Binomial = math::binomial_distribution<double, Policy>;
using Poisson = math::poisson_distribution<double, Policy>;

}  // namespace

double normal_cdf(double x) {
  return below(Normal(), x);
}
double normal_upper(double x) {
  return above(Normal(), x);
}
double normal_pdf(double x) {
  return or_nan([&] { return math::pdf(Normal(), x); });
}
double normal_quantile_of(double p) {
  return where(Normal(), p);
}

double student_t_cdf(double t, double df) {
  return below(StudentT(df), t);
}
double student_t_upper(double t, double df) {
  return above(StudentT(df), t);
}
double student_t_quantile(double p, double df) {
  return where(StudentT(df), p);
}
double noncentral_t_cdf(double t, double df, double delta) {
  return or_nan([&] { return math::cdf(math::non_central_t_distribution<double, Policy>(df, delta), t); });
}

double f_upper(double f, double df1, double df2) {
  return above(FisherF(df1, df2), f);
}
double f_quantile(double p, double df1, double df2) {
  return where(FisherF(df1, df2), p);
}
double noncentral_f_cdf(double f, double df1, double df2, double lambda) {
  return or_nan([&] { return math::cdf(math::non_central_f_distribution<double, Policy>(df1, df2, lambda), f); });
}

double chi_squared_upper(double x, double df) {
  return above(ChiSquared(df), x);
}
double chi_squared_quantile_of(double p, double df) {
  return where(ChiSquared(df), p);
}

double noncentral_chi_squared_cdf(double x, double df, double lambda) {
  return or_nan(
      [&] { return math::cdf(math::non_central_chi_squared_distribution<double, Policy>(df, lambda), x); });
}

double beta_cdf(double x, double a, double b) {
  return below(Beta(a, b), x);
}
double beta_quantile(double p, double a, double b) {
  return where(Beta(a, b), p);
}

double binomial_cdf(std::int64_t k, std::int64_t n, double p) {
  if (k < 0) return 0.0;
  if (k >= n) return 1.0;
  return below(Binomial(static_cast<double>(n), p), static_cast<double>(k));
}
double binomial_pdf(std::int64_t k, std::int64_t n, double p) {
  if (k < 0 || k > n) return 0.0;
  return or_nan([&] { return math::pdf(Binomial(static_cast<double>(n), p), static_cast<double>(k)); });
}
double poisson_pdf(std::int64_t k, double mean) {
  if (k < 0) return 0.0;
  if (mean == 0.0) return k == 0 ? 1.0 : 0.0;
  return or_nan([&] { return math::pdf(Poisson(mean), static_cast<double>(k)); });
}

// By logarithms of factorials: Boost's own takes unsigned counts and tables of primes.
double hypergeometric_pdf(std::int64_t k, std::int64_t marked, std::int64_t draws, std::int64_t total) {
  if (k < 0 || k > marked || k > draws || draws - k > total - marked) return 0.0;
  const auto choose = [](std::int64_t n, std::int64_t m) {
    return log_gamma(static_cast<double>(n) + 1.0) - log_gamma(static_cast<double>(m) + 1.0) -
           log_gamma(static_cast<double>(n - m) + 1.0);
  };
  return std::exp(choose(marked, k) + choose(total - marked, draws - k) - choose(total, draws));
}

double digamma(double x) {
  return or_nan([&] { return math::digamma(x, Policy()); });
}
double trigamma(double x) {
  return or_nan([&] { return math::trigamma(x, Policy()); });
}
double log_gamma(double x) {
  return or_nan([&] { return math::lgamma(x, Policy()); });
}

}  // namespace seldinger::assessment::statistics
