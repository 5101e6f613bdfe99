// Tests that a recording has the same score whatever built the program: within 1e-9, Debug against -O3 with FMA.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <sstream>
#include <string>

#include "tests/fixtures/places.h"

namespace seldinger {
namespace {

std::map<std::string, std::string> told_by(const std::string& program) {
  std::string text;
  std::FILE* pipe = ::popen(program.c_str(), "r");
  EXPECT_NE(pipe, nullptr);
  std::array<char, 65536> buffer{};
  for (std::size_t got = 0; (got = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
    text.append(buffer.data(), got);
  EXPECT_EQ(::pclose(pipe), 0) << program;
  std::map<std::string, std::string> values;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t at = line.rfind(' ');
    values[line.substr(0, at)] = line.substr(at + 1);
  }
  return values;
}

TEST(Builds, ScoreTheSame) {
  if (!__builtin_cpu_supports("fma") || !__builtin_cpu_supports("avx2"))
    GTEST_SKIP() << "the build with FMA cannot run: this processor lacks FMA or AVX2";
  const auto debug = told_by(fixtures::built_target("metrics_debug")),
             fused = told_by(fixtures::built_target("metrics_fma"));
  ASSERT_GT(debug.size(), 1000U);
  ASSERT_EQ(debug.size(), fused.size());
  int numbers = 0, other_bits = 0;
  for (const auto& [name, value] : debug) {
    const std::string& other = fused.at(name);
    ASSERT_EQ(value == "null", other == "null") << name;
    if (value == "null") continue;
    const double a = std::strtod(value.c_str(), nullptr), b = std::strtod(other.c_str(), nullptr);
    EXPECT_TRUE(std::abs(a - b) <= 1e-9 * std::max(1.0, std::abs(a))) << name << ": " << a << ", " << b;
    ++numbers;
    other_bits += value == other ? 0 : 1;
  }
  EXPECT_GT(numbers, 500);
  std::printf("%d of %d values have other bits\n", other_bits, numbers);
}

}  // namespace
}  // namespace seldinger
