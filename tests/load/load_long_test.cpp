// As load_test, for ten minutes.
#include <gtest/gtest.h>

#include "tests/load/clients.h"

namespace seldinger::load {
namespace {

TEST(LoadLong, FiftyPeopleAreAnsweredRightForTenMinutes) {
  serve_fifty(20'000, std::chrono::minutes(10));
}

}  // namespace
}  // namespace seldinger::load
