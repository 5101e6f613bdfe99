// The window's size is kept from one time to the next, and what is no size is no reason to fail.
#include "app/window/surface/window_size_json.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "tests/fixtures/folders.h"

namespace seldinger::app {
namespace {

class WindowSizeTest : public testing::Test {
 protected:
  void put(const std::string& text) const { std::ofstream(file_) << text; }
  std::filesystem::path folder_ = fixtures::fresh_folder("window_size");
  std::filesystem::path file_ = folder_ / "window.json";
};

TEST_F(WindowSizeTest, IsReadAsItWasKept) {
  EXPECT_EQ(read_window_size(file_), std::nullopt) << "none was kept yet";
  const std::filesystem::path below = folder_ / "made" / "window.json";
  const WindowSize first{800, 600, false}, second{2560, 1440, true};
  EXPECT_TRUE(keep_window_size(below, first));
  EXPECT_EQ(read_window_size(below), first);
  EXPECT_TRUE(keep_window_size(below, second));
  EXPECT_EQ(read_window_size(below), second);
}

TEST_F(WindowSizeTest, WhatIsNoSizeIsNone) {
  for (const char* text :
       {"", "{", "[]", "null", "{}", R"({"width":1280,"height":800})",
        R"({"width":1280,"height":"800","whole_screen":false})",
        R"({"width":799,"height":800,"whole_screen":false})", R"({"width":1280,"height":599,"whole_screen":false})",
        R"({"width":1e9,"height":800,"whole_screen":false})",
        R"({"width":99999999999999999999,"height":800,"whole_screen":false})",
        R"({"width":1280,"height":800.5,"whole_screen":false})",
        R"({"width":1280,"height":800,"whole_screen":1})"}) {
    put(text);
    EXPECT_EQ(read_window_size(file_), std::nullopt) << text;
  }
  put(std::string(10000, ' ') + R"({"width":1280,"height":800,"whole_screen":false})");
  EXPECT_EQ(read_window_size(file_), std::nullopt) << "too long to be ours";
}

TEST_F(WindowSizeTest, WhereNothingCanBeKeptIsNoFailure) {
  put("a file");
  EXPECT_FALSE(keep_window_size(file_ / "window.json", {1280, 800, false}));
}

}  // namespace
}  // namespace seldinger::app
