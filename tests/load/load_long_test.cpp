// As load_test, for ten minutes; and what the time of a log-in tells.
#include <gtest/gtest.h>
#include <time.h>

#include <cmath>

#include "casedb/people/people.h"
#include "tests/fixtures/folders.h"
#include "tests/load/clients.h"

namespace seldinger::load {
namespace {

TEST(LoadLong, FiftyPeopleAreAnsweredRightForTenMinutes) {
  serve_fifty(20'000, std::chrono::minutes(10));
}

double thread_ms() {
  timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

// In processor time, which other programs do not lengthen, and in pairs whose order changes, so that a processor
// that slows down does so to both.
TEST(LoadLong, AWrongPasswordAndANameThatNobodyHasTakeTheSameTime) {
  constexpr int kTries = 200;
  constexpr double kMostMs = 5.0;
  auto library = casedb::Library::open_or_create(fixtures::fresh_test_folder("load") / "library");
  ASSERT_TRUE(library);
  ASSERT_TRUE(casedb::add_user(*library, "ann", casedb::Role::trainee, "heron lamp gravel"));
  const auto took_ms = [&](const char* name) {
    const double begun = thread_ms();
    EXPECT_FALSE(casedb::log_in(*library, name, "gravel lamp heron"));
    return thread_ms() - begun;
  };
  took_ms("ann");
  took_ms("nobody");
  double difference_ms = 0.0, in_all_ms = 0.0;
  for (int i = 0; i < kTries; ++i) {
    const bool wrong_first = i % 2 == 0;
    const double first = took_ms(wrong_first ? "ann" : "nobody"), second = took_ms(wrong_first ? "nobody" : "ann");
    difference_ms += wrong_first ? first - second : second - first;
    in_all_ms += first + second;
  }
  const double mean_ms = difference_ms / kTries;
  RecordProperty("difference_of_means_ms", std::to_string(mean_ms));
  EXPECT_LT(std::abs(mean_ms), kMostMs);
  EXPECT_GT(in_all_ms / (2 * kTries), kMostMs) << "a log-in that hashes nothing would pass";
}

}  // namespace
}  // namespace seldinger::load
