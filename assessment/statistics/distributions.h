// Distributions, by Boost.Math: the only door to it. Outside of where a distribution is defined, and where the
// computation fails, the answer is NaN, which settled() keeps from every reader.
#pragma once

#include <cstdint>

namespace seldinger::assessment::statistics {

// Shares below x, shares above x (exact in the far tail), and where a share p lies below.
double normal_cdf(double x);
double normal_upper(double x);
double normal_pdf(double x);
double normal_quantile_of(double p);

double student_t_cdf(double t, double df);
double student_t_upper(double t, double df);
double student_t_quantile(double p, double df);
// With the non-centrality `delta`.
double noncentral_t_cdf(double t, double df, double delta);

double f_upper(double f, double df1, double df2);
double f_quantile(double p, double df1, double df2);
double noncentral_f_cdf(double f, double df1, double df2, double lambda);

double chi_squared_upper(double x, double df);
double chi_squared_quantile_of(double p, double df);
double noncentral_chi_squared_cdf(double x, double df, double lambda);

double beta_cdf(double x, double a, double b);
double beta_quantile(double p, double a, double b);

double binomial_cdf(std::int64_t k, std::int64_t n, double p);
double binomial_pdf(std::int64_t k, std::int64_t n, double p);
double poisson_pdf(std::int64_t k, double mean);
// k marked among `draws` from `total` of which `marked` are.
double hypergeometric_pdf(std::int64_t k, std::int64_t marked, std::int64_t draws, std::int64_t total);

double digamma(double x);
double trigamma(double x);
double log_gamma(double x);

}  // namespace seldinger::assessment::statistics
