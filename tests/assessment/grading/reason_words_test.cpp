// Every reason that a metric can give for having no value is told in words: none reads as a code.
#include "assessment/grading/reason_words.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>

#include "assessment/registry.h"
#include "tests/fixtures/places.h"

namespace seldinger::assessment {
namespace {

TEST(ReasonWordsTest, EachReadsOnAfterNoValueAndNoneStandsTwice) {
  std::set<std::string_view> codes;
  for (const ReasonWords& one : all_reason_words()) {
    EXPECT_TRUE(codes.insert(one.code).second) << one.code << " is there twice";
    ASSERT_FALSE(one.words.empty()) << one.code;
    EXPECT_TRUE(std::islower(static_cast<unsigned char>(one.words.front()))) << one.words;
    EXPECT_NE(one.words.back(), '.') << one.words;
    EXPECT_EQ(one.words.find('_'), one.words.npos) << one.words;
    EXPECT_EQ(reason_words(one.code), one.words);
  }
  EXPECT_EQ(reason_words("of_another_program"), "of another program");
}

TEST(ReasonWordsTest, EveryNeedHasThem) {
  for (const NeedInfo& need : needs()) EXPECT_NE(find_reason_words(need.reason), nullptr) << need.reason;
}

// What a definition names after "Null:" in snake_case is another metric or a reason.
TEST(ReasonWordsTest, EveryReasonThatADefinitionNamesHasThem) {
  const std::regex code("[a-z0-9]+(_[a-z0-9]+)+");
  int told = 0;
  for (const MetricInfo& info : registry()) {
    const std::string text = info.definition;
    const std::size_t at = text.find("Null: ");
    if (at == text.npos) continue;
    const std::string nulls = text.substr(at);
    for (std::sregex_iterator one(nulls.begin(), nulls.end(), code), end; one != end; ++one, ++told)
      EXPECT_TRUE(find_reason_words(one->str()) != nullptr || find_metric(one->str()) != nullptr)
          << info.id << ": " << one->str();
  }
  EXPECT_GE(told, 20);
}

// And what the sources give: a metric may have a reason that its definition keeps to itself.
TEST(ReasonWordsTest, EveryReasonInTheSourcesHasThem) {
  const std::regex given("none\\(\"([a-z0-9_]+)\"\\)");
  int told = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(fixtures::source_dir() / "assessment")) {
    if (entry.path().extension() != ".cpp") continue;
    std::ifstream file(entry.path());
    const std::string text(std::istreambuf_iterator<char>(file), {});
    for (std::sregex_iterator one(text.begin(), text.end(), given), end; one != end; ++one, ++told)
      EXPECT_NE(find_reason_words((*one)[1].str()), nullptr) << entry.path() << ": " << (*one)[1].str();
  }
  EXPECT_GE(told, 15);
}

// What grading adds to them (grade.cpp, builds.cpp).
TEST(ReasonWordsTest, EveryReasonOfAGradeHasThem) {
  for (const char* code : {"other_version", "not_stored", "no_reason_stored", "not_finite", "interrupted",
                           "device_lost", "tracking_gaps", "tracking_slow", "tracking_jumps", "tracking_repaired",
                           "way_impossible", "too_short", "quality_not_measured"})
    EXPECT_NE(find_reason_words(code), nullptr) << code;
}

}  // namespace
}  // namespace seldinger::assessment
