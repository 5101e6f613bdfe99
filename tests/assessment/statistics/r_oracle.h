// R as the oracle of statistics: a script goes to Rscript, what it says with say("name", value) comes back.
// Debian's packages are what `./run test` installs; where there is no R a test is skipped with words.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <span>
#include <sstream>
#include <string>

#include "tests/fixtures/folders.h"

namespace seldinger::fixtures {

inline bool has_r() {
  static const bool kHas = std::system("Rscript --version >/dev/null 2>&1") == 0;
  return kHas;
}

#define SELDINGER_NEEDS_R() \
  if (!seldinger::fixtures::has_r()) GTEST_SKIP() << "there is no Rscript (Debian: r-base-core): no oracle to ask"

// How many random data sets R is asked about: 20, in `./run test --long` 500 (SELDINGER_R_SETS).
inline std::size_t r_sets() {
  const char* asked = std::getenv("SELDINGER_R_SETS");
  return asked != nullptr ? static_cast<std::size_t>(std::strtoul(asked, nullptr, 10)) : 20;
}

// What random data sets are made from: the same in every run, unless SELDINGER_R_SEED says otherwise.
inline std::uint64_t r_seed() {
  const char* asked = std::getenv("SELDINGER_R_SEED");
  return asked != nullptr ? std::strtoull(asked, nullptr, 10) : 20261124;
}

// c(…) with every digit; NA where a value is NaN. On several lines: R ends a script without a word where one has
// more than 16,000 letters.
inline std::string r_vector(std::span<const double> values) {
  std::string text = "c(";
  char digits[40];
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double value = values[i];
    std::snprintf(digits, sizeof digits, "%.17g", value);
    text += (i == 0 ? "" : i % 50 == 0 ? ",\n" : ",") + std::string(std::isnan(value) ? "NA_real_" : digits);
  }
  return text + ")";
}

// What `script` says, by name; in it say(name, value) is there, and says NaN for NA and for an error caught by
// try(). Packages that are missing fail the test that asks for them.
inline std::map<std::string, double> r_values(const std::string& script) {
  // Several programs' tests may ask at once.
  const auto folder = fresh_folder("r_oracle_" + std::to_string(getpid()));
  const auto file = folder / "oracle.R", out = folder / "said.txt";
  std::ofstream(file) << "options(warn = -1, digits = 17)\n"
                         "say <- function(name, value) { v <- suppressWarnings(as.numeric(value)[1]); "
                         "cat(name, if (is.na(v)) \"nan\" else sprintf(\"%.17g\", v), \"\\n\") }\n"
                      << script << "\ncat(\"end 1\\n\")\n";
  const std::string command = "Rscript --vanilla '" + file.string() + "' > '" + out.string() + "' 2> '" +
                              (folder / "errors.txt").string() + "'";
  const int status = std::system(command.c_str());
  std::map<std::string, double> values;
  std::ifstream said(out);
  std::string name, value;
  while (said >> name >> value) values[name] = value == "nan" ? std::nan("") : std::strtod(value.c_str(), nullptr);
  std::ostringstream errors;
  errors << std::ifstream(folder / "errors.txt").rdbuf();
  EXPECT_EQ(status, 0) << errors.str();
  EXPECT_TRUE(values.contains("end")) << "the script ended early: " << errors.str();
  if (status == 0) std::filesystem::remove_all(folder);
  return values;
}

// The largest difference between us and R that each test saw, of numbers above 1 as a share; told at the program's
// end where SELDINGER_R_WORST asks for it: docs/statistics-held.md is made of that.
class WorstDifferences {
 public:
  void note(double got, double want) {
    if (!std::isfinite(want)) return;
    double& worst = worst_[testing::UnitTest::GetInstance()->current_test_info()->test_suite_name() +
                           std::string(".") + testing::UnitTest::GetInstance()->current_test_info()->name()];
    worst = std::max(worst, std::abs(got - want) / std::max(1.0, std::abs(want)));
  }
  ~WorstDifferences() {
    if (std::getenv("SELDINGER_R_WORST") == nullptr) return;
    for (const auto& [test, worst] : worst_) std::printf("%-56s %.1e\n", test.c_str(), worst);
  }
  WorstDifferences() = default;
  WorstDifferences(const WorstDifferences&) = delete;
  WorstDifferences& operator=(const WorstDifferences&) = delete;

 private:
  std::map<std::string, double> worst_;
};
inline void note_difference(double got, double want) {
  static WorstDifferences worst;
  worst.note(got, want);
}

}  // namespace seldinger::fixtures
