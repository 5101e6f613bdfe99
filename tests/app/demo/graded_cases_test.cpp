// The table of graded cases: eight of built-in patients, and which of them a CT may take over.
#include <gtest/gtest.h>

#include <set>

#include "app/demo/demo_cases.h"

namespace seldinger::app {
namespace {

TEST(GradedCases, AreEightEachOfABuiltInPatient) {
  ASSERT_EQ(demo_cases().size(), 8U);
  for (std::size_t i = 0; i < demo_cases().size(); ++i) {
    const DemoCase& one = demo_cases()[i];
    SCOPED_TRACE(one.title);
    EXPECT_EQ(one.number, static_cast<int>(i) + 1);
    EXPECT_EQ(one.title.rfind("Graded " + std::to_string(one.number) + ": ", 0), 0U);
    EXPECT_TRUE(landmarks_of(one.source).empty()) << "a CT's";
    EXPECT_EQ(one.lesions.size(), 1U);
    EXPECT_TRUE(casedb::check_setting(one.setting).has_value());
    bool critical = false;
    for (const DemoStructure& structure : one.structures)
      critical = critical || structure.row.rule == cases::StructureRule::critical;
    EXPECT_TRUE(critical);
  }
}

// Of each body the family has, somebody is a case's; so is each region.
TEST(AccessCases, AreOfTheBodiesAndTheRegionsThatTheGradedOnesLeaveOut) {
  std::set<DemoSource> sources;
  for (const DemoCase& one : access_cases()) {
    SCOPED_TRACE(one.title);
    EXPECT_EQ(one.title.rfind("Access " + std::to_string(one.number) + ": ", 0), 0U);
    EXPECT_TRUE(casedb::check_setting(one.setting).has_value());
    EXPECT_EQ(one.lesions.size(), 1U);
    sources.insert(one.source);
  }
  EXPECT_EQ(sources, (std::set{DemoSource::neck_obese, DemoSource::groin_child, DemoSource::groin_lean}));
}

// Whoever lies on the table, a case asks for the same.
TEST(GradedCases, OfACtAskForTheSameAsOfTheBuiltInPatient) {
  ASSERT_EQ(demo_cases_of_ct().size(), 5U);
  for (const DemoCase& one : demo_cases_of_ct()) {
    SCOPED_TRACE(one.title);
    const DemoCase& built_in = demo_cases().at(static_cast<std::size_t>(one.number - 1));
    EXPECT_FALSE(landmarks_of(one.source).empty());
    EXPECT_EQ(one.title, built_in.title);
    EXPECT_EQ(one.setting.modality, built_in.setting.modality);
    EXPECT_EQ(one.setting.position, built_in.setting.position);
    ASSERT_EQ(one.setting.rule.criteria.size(), built_in.setting.rule.criteria.size());
    for (std::size_t i = 0; i < one.setting.rule.criteria.size(); ++i)
      EXPECT_EQ(one.setting.rule.criteria[i].metric, built_in.setting.rule.criteria[i].metric);
  }
}

}  // namespace
}  // namespace seldinger::app
