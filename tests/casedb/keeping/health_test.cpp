// Was: /healthz said "ok" while the library was moved away, full or read-only.
#include "casedb/keeping/health.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <limits>

#include "casedb/database/library.h"
#include "tests/fixtures/folders.h"

namespace seldinger::casedb {
namespace {

namespace fs = std::filesystem;

class HealthTest : public ::testing::Test {
 protected:
  fs::path folder_ = fixtures::fresh_test_folder("health") / "library";
  Library library_ = std::move(Library::open_or_create(folder_).value());
  static std::size_t files_in(const fs::path& folder) {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
  }
};

TEST_F(HealthTest, ALibraryInItsPlaceIsWellAndTheProbeLeavesNothing) {
  const HealthWatch watch(folder_, 0);
  const std::size_t before = files_in(folder_);
  EXPECT_EQ(watch.look(), Health::ok);
  EXPECT_EQ(files_in(folder_), before);
}

TEST_F(HealthTest, OneThatWasMovedIsToldAlsoWhenAnotherTakesItsPlace) {
  const HealthWatch watch(folder_, 0);
  fs::rename(folder_, folder_.parent_path() / "elsewhere");
  EXPECT_EQ(watch.look(), Health::moved);
  const auto another = Library::open_or_create(folder_);
  ASSERT_TRUE(another.has_value());
  EXPECT_EQ(watch.look(), Health::moved);
  fs::rename(folder_, folder_.parent_path() / "another");
  fs::rename(folder_.parent_path() / "elsewhere", folder_);
  EXPECT_EQ(watch.look(), Health::ok);
}

TEST_F(HealthTest, TooLittleRoomIsFull) {
  EXPECT_EQ(HealthWatch(folder_, std::numeric_limits<std::uint64_t>::max()).look(), Health::full);
}

// A process that may write no file stands in for a file system that takes none: for root, no mode of a folder does.
TEST_F(HealthTest, WhereNothingCanBeWrittenIsReadOnly) {
  const HealthWatch watch(folder_, 0);
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit none{0, 0};
    ::setrlimit(RLIMIT_FSIZE, &none);
    ::_exit(watch.look() == Health::read_only ? 0 : 1);
  }
  int status = -1;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_EQ(status, 0);
}

}  // namespace
}  // namespace seldinger::casedb
