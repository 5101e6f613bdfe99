// Tests of app/cli/csv: numbers by named columns, and every fault told.
#include "app/cli/csv.h"

#include <gtest/gtest.h>

namespace seldinger::app {
namespace {

constexpr const char* kNames[] = {"x", "y"};

TEST(Csv, TakesColumnsByNameWhateverStandsBeside) {
  const auto rows =
      rows_in_csv("\xef\xbb\xbf\"y\",other,x,what\r\n1,?,2.5,first\r\n\r\n-3e2,,4, \"second\"\n", kNames, "what");
  ASSERT_TRUE(rows) << rows.error().text;
  ASSERT_EQ(rows->size(), 2U);
  EXPECT_EQ(rows->row(0)[0], 2.5);
  EXPECT_EQ(rows->row(0)[1], 1.0);
  EXPECT_EQ(rows->row(1)[0], 4.0);
  EXPECT_EQ(rows->row(1)[1], -300.0);
  EXPECT_EQ(rows->labels, (std::vector<std::string>{"first", "second"}));
}

TEST(Csv, TellsEveryFault) {
  const auto refused = [](const std::string& text) {
    const auto rows = rows_in_csv(text, kNames);
    std::vector<std::string> faults;
    if (rows) return faults;
    EXPECT_EQ(rows.error().code, "bad_csv");
    faults.push_back(rows.error().text);
    for (const auto& finding : rows.error().findings) faults.push_back(finding.text);
    return faults;
  };
  using Faults = std::vector<std::string>;
  EXPECT_EQ(refused("x,y\n1,2\n"), Faults{});
  EXPECT_EQ(refused("x,y\n"), Faults{"there is no row"});
  EXPECT_EQ(refused(""), (Faults{"column x is missing", "column y is missing"}));
  EXPECT_EQ(refused("y,x,y\n1,2\n"),
            (Faults{"column y is there twice", "row 1 has another number of cells than the header"}));
  EXPECT_EQ(refused("x,y\n1,nan\ninf,2\n3\nz,1e999\n"),
            (Faults{"row 1, y is not a number", "row 2, x is not a number",
                    "row 3 has another number of cells than the header", "row 4, x is not a number",
                    "row 4, y is not a number"}));
  std::string many = "x,y\n";
  for (int i = 0; i < 100; ++i) many += "?,?\n";
  EXPECT_EQ(refused(many).size(), 10U);
}

}  // namespace
}  // namespace seldinger::app
