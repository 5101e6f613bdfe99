// The dictionary that REDCap takes: its own columns and types, names that it allows, and the header of
// attempts.csv.
#include "reports/export/redcap.h"

#include <gtest/gtest.h>

#include "reports/export/raw_tables.h"
#include "tests/fixtures/csv_table.h"

namespace seldinger::reports {
namespace {

TEST(Redcap, HasAFieldForEachColumnOfTheImport) {
  const auto dictionary = fixtures::csv_table(redcap_dictionary());
  const auto import = fixtures::csv_table(attempts_header());
  ASSERT_EQ(dictionary.header.size(), 18U);
  ASSERT_EQ(dictionary.rows.size(), import.header.size());
  EXPECT_EQ(import.header.front(), "attempt") << "the record";
  for (std::size_t i = 0; i < dictionary.rows.size(); ++i) {
    const std::string name = dictionary.cell(i, "Variable / Field Name");
    EXPECT_EQ(name, import.header[i]);
    EXPECT_EQ(name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_"), std::string::npos) << name;
    EXPECT_TRUE(name.front() >= 'a' && name.front() <= 'z') << name;
    EXPECT_LE(name.size(), 100U) << name;
    EXPECT_EQ(dictionary.cell(i, "Form Name"), "attempts");
    EXPECT_FALSE(dictionary.cell(i, "Field Label").empty()) << name;
    const std::string type = dictionary.cell(i, "Field Type");
    const std::string valid = dictionary.cell(i, "Text Validation Type OR Show Slider Number");
    EXPECT_TRUE(type == "yesno" ? valid.empty()
                                : type == "text" && (valid.empty() || valid == "number" || valid == "integer"))
        << name << " " << type << " " << valid;
  }
}

}  // namespace
}  // namespace seldinger::reports
