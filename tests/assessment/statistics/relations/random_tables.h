// Random tables for R to be asked about: ties, missing values, groups of unequal size; and what R is told of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "sim/base/hash.h"
#include "tests/assessment/statistics/r_oracle.h"
#include "tests/assessment/statistics/relations/tables_of.h"

namespace seldinger::fixtures {

// A stream of random numbers for each thing simulated at each size.
inline std::uint64_t stream_of(const std::string& what, std::size_t size) {
  return base::hash_combine(base::hash_bytes(std::as_bytes(std::span(what.data(), what.size()))),
                            std::uint64_t{size});
}

class RandomTables {
 public:
  explicit RandomTables(std::uint64_t stream) : rng_(base::hash_combine(r_seed(), stream)) {}

  std::size_t from_to(std::size_t from, std::size_t to) {
    return from + static_cast<std::size_t>(rng_.uniform() * static_cast<double>(to - from + 1));
  }
  double uniform() { return rng_.uniform(); }
  double normal() { return rng_.normal(); }
  double one_or_zero(double chance) { return rng_.uniform() < chance ? 1.0 : 0.0; }
  double exponential(double mean) { return -mean * std::log(1.0 - rng_.uniform()); }
  double poisson(double mean) {
    double count = 0.0, left = std::exp(-mean);
    for (double u = rng_.uniform(), p = left; u > p && count < 500.0; p += left) left *= mean / ++count;
    return count;
  }
  // A mean of its own for each person: exponential, so that counts are negative binomial with θ 1.
  double overdispersed(double mean) { return poisson(exponential(mean)); }

  // One in fifteen is missing.
  void lose_some(std::vector<double>& values) {
    for (double& value : values)
      if (rng_.uniform() < 1.0 / 15.0) value = kMissing;
  }
  template <typename Draw>
  std::vector<double> some(std::size_t n, const Draw& draw) {
    std::vector<double> values;
    for (std::size_t i = 0; i < n; ++i) values.push_back(draw());
    return values;
  }

 private:
  base::Rng rng_;
};

// v, w, x and g in R, the rows where all are there.
inline std::string in_r(const DataTable& table) {
  std::string text = "v <- " + r_vector(table.values[0].values) + "\n";
  text += "w <- " + (table.values.size() > 1 ? r_vector(table.values[1].values) : std::string("v")) + "\n";
  text += "x <- " + (table.x.empty() ? std::string("0 * v") : r_vector(table.x)) + "\ng <- c(";
  for (std::size_t i = 0; i < table.rows; ++i)
    text += std::string(i > 0 ? "," : "") + "'" + (table.group.empty() ? "a" : table.group[i]) + "'";
  return text + ")\nok <- complete.cases(v, w, x); v <- v[ok]; w <- w[ok]; x <- x[ok]; g <- g[ok]\n";
}

// A name for R to say something of set i under.
inline std::string said(std::size_t set, const std::string& name) {
  return "s" + std::to_string(set) + "_" + name;
}

// `body` after each table, with `s` in front of what it says.
inline std::string script_of(const std::vector<DataTable>& tables, const std::string& head,
                             const std::string& body) {
  std::string script = head + "\nasked <- function() {\n" + body + "\n}\n";
  for (std::size_t i = 0; i < tables.size(); ++i)
    script += in_r(tables[i]) + "s <- function(n, v) say(paste0('s" + std::to_string(i) + "_', n), v)\nasked()\n";
  return script;
}

// Compares by name; a NaN on both sides is equal, on one side not.
class RAnswers {
 public:
  explicit RAnswers(const std::string& script) : values_(r_values(script)) {}
  double of(std::size_t set, const std::string& name) const {
    const auto found = values_.find(said(set, name));
    if (found == values_.end()) {
      ADD_FAILURE() << "R did not say " << said(set, name);
      return kMissing;
    }
    return found->second;
  }
  void expect(std::size_t set, const std::string& name, double got, double tolerance) {
    const double want = of(set, name);
    if (std::isnan(want)) {
      EXPECT_TRUE(std::isnan(got)) << said(set, name) << ": " << got << ", where R has none";
      return;
    }
    expect_near_relative(got, want, tolerance, said(set, name));
    worst_ = std::max(worst_, std::abs(got - want) / std::max(std::abs(want), 1e-5));
    ++compared_;
  }
  // Printed, for the page that lists each procedure with its oracle.
  ~RAnswers() { std::printf("  %zu numbers compared, worst relative difference %.2g\n", compared_, worst_); }
  RAnswers(const RAnswers&) = delete;
  RAnswers& operator=(const RAnswers&) = delete;

 private:
  std::map<std::string, double> values_;
  double worst_ = 0.0;
  std::size_t compared_ = 0;
};

}  // namespace seldinger::fixtures
