// docs/routes.md is what the registry says.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "web/routes.h"

namespace seldinger::web {
namespace {

TEST(RoutesDocument, IsTheRegistrys) {
  std::ifstream file(SELDINGER_SOURCE_DIR "/docs/routes.md");
  std::stringstream text;
  text << file.rdbuf();
  const std::filesystem::path wanted = std::filesystem::path(SELDINGER_TEST_OUT_DIR) / "web" / "routes.md";
  std::filesystem::create_directories(wanted.parent_path());
  std::ofstream(wanted) << routes_markdown();
  EXPECT_EQ(text.str(), routes_markdown()) << "copy test-out/web/routes.md of the build folder to docs/";
}

TEST(RoutesRegistry, EveryRouteSaysWhatItAnswersAndOnlyPostChanges) {
  for (const Route& route : routes()) {
    EXPECT_FALSE(route.summary.empty()) << route.pattern;
    EXPECT_NE(route.handle, nullptr) << route.pattern;
    EXPECT_TRUE(route.method == "GET" || route.method == "POST") << route.pattern;
    EXPECT_EQ(route.pattern.front(), '/');
  }
}

}  // namespace
}  // namespace seldinger::web
