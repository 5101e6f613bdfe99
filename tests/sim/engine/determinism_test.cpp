// Tests that step, device, operator and the forces on two hands give the same bits at every tick in Debug and -O2,
// with and without FMA.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <string>

#include "tests/fixtures/places.h"

namespace seldinger {
namespace {

std::string output_of(const std::string& program) {
  std::string text;
  std::FILE* pipe = ::popen(program.c_str(), "r");
  if (pipe == nullptr) return text;
  std::array<char, 65536> buffer{};
  for (std::size_t got = 0; (got = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
    text.append(buffer.data(), got);
  return ::pclose(pipe) == 0 ? text : "failed: " + text;
}

// Line 0 is tick 1.
std::size_t first_difference(const std::string& a, const std::string& b) {
  std::size_t line = 1;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    if (a[i] != b[i]) return line;
    if (a[i] == '\n') ++line;
  }
  return line;
}

// A line of hash for each tick.
std::string told_by_debug() {
  const std::string debug = output_of(fixtures::built_target("determinism_debug"));
  EXPECT_GT(debug.size(), 17U * 10'000U) << debug.substr(0, 200);
  return debug;
}

TEST(Determinism, TheSameHashAtEveryTickInDebugAndAsReleased) {
  const std::string debug = told_by_debug();
  const std::string released = output_of(fixtures::built_target("determinism_released"));
  EXPECT_TRUE(released == debug) << "what is released differs from Debug at tick "
                                 << first_difference(debug, released);
}

TEST(Determinism, TheSameHashAtEveryTickWithFma) {
  if (!__builtin_cpu_supports("fma") || !__builtin_cpu_supports("avx2"))
    GTEST_SKIP() << "the build with FMA cannot run: this processor lacks FMA or AVX2";
  const std::string debug = told_by_debug();
  const std::string fused = output_of(fixtures::built_target("determinism_fma"));
  EXPECT_TRUE(fused == debug) << "-O3 with FMA differs from Debug at tick " << first_difference(debug, fused);
}

}  // namespace
}  // namespace seldinger
