// The compiler cache that a build was configured with (CMakeLists.txt), tried on a header of our own.
#include <gtest/gtest.h>

#include <fstream>

#include "tests/fixtures/process.h"

namespace seldinger {
namespace {

namespace fs = std::filesystem;

void write(const fs::path& file, const std::string& text) {
  std::ofstream(file) << text;
}

// What stands before the options where a header is precompiled: the cache with its settings, and the compiler.
std::string precompiling_command(const fs::path& scratch) {
  const auto build = fs::path(fixtures::built_target("seldinger")).parent_path();
  const auto ran =
      fixtures::run("ninja -C '" + build.string() + "' -t commands seldinger_hurried_headers", scratch);
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  const std::size_t header = ran.out.find(" -x c++-header "), line = ran.out.rfind('\n', header) + 1;
  if (header == std::string::npos) return "";
  return ran.out.substr(line, ran.out.find(" -D", line) - line);
}

// g++ takes two texts under #pragma once for one header where their bytes are the same. A precompiled header from
// the cache that has another comment, or another space, than the header on the disk makes each name in it a double.
TEST(CompilerCache, KeepsPrecompiledHeadersByTheirBytes) {
  const auto scratch = fixtures::fresh_folder("compiler_cache");
  const std::string command = precompiling_command(scratch);
  if (command.find("ccache") == std::string::npos) GTEST_SKIP() << "built without ccache: " << command;
  const std::string there = "cd '" + scratch.string() + "' && CCACHE_DIR=cache ";
  write(scratch / "all.h", "#include \"one.h\"\n");
  write(scratch / "use.cpp", "#include \"one.h\"\nOne one;\n");
  const auto precompile = [&](const std::string& text) {
    write(scratch / "one.h", std::string("#pragma once\n") + text);
    fs::remove(scratch / "all.h.gch");  // as in a checkout of its own
    const auto made =
        fixtures::run(there + command + " -x c++-header -MD -MF all.d -o all.h.gch -c all.h", scratch);
    EXPECT_EQ(made.exit_code, 0) << made.err;
    const auto used =
        fixtures::run(there + "c++ -Werror -Winvalid-pch -include all.h -o use.o -c use.cpp", scratch);
    EXPECT_EQ(used.exit_code, 0) << text << used.err;
  };
  for (const char* text : {"struct One {};  // a\n", "struct One {};  // b\n", "struct  One {}; // b\n"})
    precompile(text);
  precompile("struct One {};  // a\n");
  const auto told = fixtures::run(there + "ccache --print-stats", scratch);
  EXPECT_NE(told.out.find("direct_cache_hit\t1\n"), std::string::npos) << "the same bytes again: " << told.out;
  EXPECT_NE(told.out.find("cache_miss\t3\n"), std::string::npos) << told.out;
}

}  // namespace
}  // namespace seldinger
