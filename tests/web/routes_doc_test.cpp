// What every route says of itself; that docs/routes.md says the same is a matter of docs_test.
#include <gtest/gtest.h>

#include "web/routes/routes.h"

namespace seldinger::web {
namespace {

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
