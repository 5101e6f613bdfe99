// Tests that step, device, operator and the forces on two hands give the same bits at every tick in Debug and -O2,
// with and without FMA.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <string>

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

TEST(Determinism, TheSameHashAtEveryTickInEveryBuild) {
  const std::string debug = output_of(DETERMINISM_PROBE_DEBUG);
  ASSERT_GT(debug.size(), 17U * 10'000U) << debug.substr(0, 200);
  const std::string optimised = output_of(DETERMINISM_PROBE_O2);
  EXPECT_TRUE(optimised == debug) << "-O2 differs from Debug at tick " << first_difference(debug, optimised);
  ASSERT_TRUE(__builtin_cpu_supports("fma") && __builtin_cpu_supports("avx2"))
      << "this processor cannot run the build with FMA; run this test on one that can";
  const std::string fused = output_of(DETERMINISM_PROBE_FMA);
  EXPECT_TRUE(fused == debug) << "-O3 with FMA differs from Debug at tick " << first_difference(debug, fused);
}

}  // namespace
}  // namespace seldinger
