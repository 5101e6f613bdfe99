// A demo that is refused leaves no folder that it made, and no other is touched.
#include <gtest/gtest.h>

#include <fstream>

#include "app/demo/demo_library.h"
#include "tests/fixtures/folders.h"

namespace seldinger::app {
namespace {

namespace fs = std::filesystem;

class MadeFolders : public testing::Test {
 protected:
  static void fill(const fs::path& folder) {
    fs::create_directories(folder / "assets");
    std::ofstream(folder / "file") << "content";
  }
  fs::path base_ = fixtures::fresh_test_folder("app_demo");
};

TEST_F(MadeFolders, WhatWasMadeGoesUpToWhatWasThere) {
  fs::create_directories(base_ / "there");
  {
    const MadeFolder made(base_ / "there/a/b/");
    fill(made.path());
  }
  EXPECT_TRUE(fs::is_empty(base_ / "there"));
  EXPECT_TRUE(fs::exists(base_ / "there"));
}

TEST_F(MadeFolders, WhatIsKeptStays) {
  {
    MadeFolder made(base_ / "a/b");
    fill(made.path());
    made.keep();
  }
  EXPECT_TRUE(fs::exists(base_ / "a/b/file"));
}

TEST_F(MadeFolders, AnEmptyFolderIsEmptyAgainAndAFullOneAsItWas) {
  fs::create_directories(base_ / "empty");
  fill(base_ / "full");
  {
    const MadeFolder empty(base_ / "empty"), full(base_ / "full");
    fill(empty.path());
    std::ofstream(full.path() / "more") << "content";
  }
  EXPECT_TRUE(fs::is_empty(base_ / "empty"));
  EXPECT_TRUE(fs::exists(base_ / "full/file"));
  EXPECT_TRUE(fs::exists(base_ / "full/more"));
}

TEST_F(MadeFolders, NothingIsMadeOfALookAlone) {
  { const MadeFolder made(base_ / "a"); }
  EXPECT_FALSE(fs::exists(base_ / "a"));
}

}  // namespace
}  // namespace seldinger::app
