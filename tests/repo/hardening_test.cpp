// What cmake/hardening.cmake asks for, read back from the built programs. Before it: no BIND_NOW, no stack
// protector, no _FORTIFY_SOURCE.
#include <gtest/gtest.h>

#include <regex>

#include "tests/fixtures/process.h"

namespace seldinger {
namespace {

class Hardening : public testing::TestWithParam<const char*> {
 protected:
  // What readelf tells of the program.
  std::string told(const std::string& options) {
    const auto build = std::filesystem::path(fixtures::built_target("seldinger")).parent_path();
    const auto ran = fixtures::run("readelf -W " + options + " '" + (build / GetParam()).string() + "'",
                                   fixtures::fresh_folder(std::string("hardening_") + GetParam()));
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    return ran.out;
  }
};

TEST_P(Hardening, LoadsAnywhereAndFixesItsAddresses) {
  const std::string dynamic = told("-d"), header = told("-h"), segments = told("-l");
  EXPECT_TRUE(std::regex_search(dynamic, std::regex(R"(\(FLAGS\)\s+BIND_NOW)"))) << dynamic;
  EXPECT_TRUE(std::regex_search(dynamic, std::regex(R"(\(FLAGS_1\)\s+Flags:.* NOW\b)"))) << dynamic;
  EXPECT_TRUE(std::regex_search(dynamic, std::regex(R"(\(FLAGS_1\)\s+Flags:.* PIE\b)"))) << dynamic;
  EXPECT_EQ(dynamic.find("TEXTREL"), std::string::npos);
  EXPECT_EQ(dynamic.find("RPATH"), std::string::npos);
  EXPECT_EQ(dynamic.find("RUNPATH"), std::string::npos) << "looks for libraries where it was built";
  EXPECT_TRUE(std::regex_search(header, std::regex(R"(Type:\s+DYN)"))) << header;
  EXPECT_NE(segments.find("GNU_RELRO"), std::string::npos);
  EXPECT_TRUE(std::regex_search(segments, std::regex(R"(GNU_STACK .* RW  0x)"))) << "no code on the stack";
}

TEST_P(Hardening, ChecksItsStackAndItsCopies) {
  const std::string symbols = told("--dyn-syms");
  EXPECT_NE(symbols.find(" __stack_chk_fail@"), std::string::npos);
  EXPECT_NE(symbols.find(" __memcpy_chk@"), std::string::npos);
  EXPECT_NE(symbols.find(" __snprintf_chk@"), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(Programs, Hardening, testing::Values("seldinger", "seldinger-measure"));

}  // namespace
}  // namespace seldinger
