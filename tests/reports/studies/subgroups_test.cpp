// Who passes by hand, arm, writing hand and site: counts by hand, intervals of the statistics, and of few nothing.
#include "reports/studies/numbers/subgroups.h"

#include <gmock/gmock.h>

#include "assessment/statistics/relations/proportions.h"
#include "reports/studies/validity_sections.h"

namespace seldinger::reports {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
namespace study = assessment::study;
namespace statistics = assessment::statistics;

const PassMark kAtMost5{5.0, false, "a rule"};

struct Persons {
  study::Compared compared;
  std::map<std::string, casedb::Background> backgrounds;
  void add(int many, double value, const std::string& writing_hand) {
    for (int i = 0; i < many; ++i) {
      study::PersonValue person{"P-" + std::to_string(compared.people.size()), "a", study::Standing::value, value,
                                1};
      person.hands = {"mouse"};
      backgrounds[person.name].answers["handedness"] = writing_hand;
      compared.people.push_back(std::move(person));
    }
  }
};

TEST(Subgroups, AreCountedWithWilsonAndNewcombe) {
  Persons persons;
  persons.add(12, 4.0, "right");
  persons.add(8, 6.0, "right");
  persons.add(5, 4.0, "left");
  persons.add(6, 6.0, "left");
  persons.compared.people.back().standing = study::Standing::absent;
  const auto all = subgroups_of(persons.compared, kAtMost5, persons.backgrounds);
  ASSERT_EQ(all.size(), 1U) << "all were led by a mouse, and no site is known";
  EXPECT_EQ(all[0].by, "Writing hand");
  const auto& groups = all[0].groups;
  ASSERT_EQ(groups.size(), 2U);
  EXPECT_EQ(groups[0].name, "right");
  EXPECT_EQ(groups[0].passes(), 12);
  EXPECT_EQ(groups[0].n(), 20);
  EXPECT_EQ(groups[0].share, statistics::wilson_interval(12, 20));
  EXPECT_FALSE(groups[0].difference);
  EXPECT_EQ(groups[1].passes(), 5);
  EXPECT_EQ(groups[1].n(), 10) << "who is absent is not counted";
  EXPECT_EQ(groups[1].difference, statistics::newcombe_interval(5, 10, 12, 20));
  EXPECT_FALSE(groups[1].descriptive);
}

TEST(Subgroups, FewPersonsAreWithheldWithWhatWouldTellOfThem) {
  Persons persons;
  persons.add(20, 4.0, "right");
  persons.add(9, 4.0, "left");
  persons.add(2, 4.0, "both");
  const auto told = [&] {
    std::vector<bool> all;
    const auto subgroups = subgroups_of(persons.compared, kAtMost5, persons.backgrounds);
    for (const Subgroup& one : subgroups[0].groups) all.push_back(one.told);
    return all;
  };
  EXPECT_EQ(told(), (std::vector<bool>{true, false, false})) << "20 and 9 of 31 would tell of the 2";
  persons.compared.people.resize(29);
  EXPECT_EQ(told(), (std::vector<bool>{true, true}));
  persons.compared.people.resize(24);
  EXPECT_EQ(told(), (std::vector<bool>{false, false}));
}

TEST(Subgroups, SeveralWordsOfOnePersonAreTheirOwnSubgroup) {
  Persons persons;
  persons.add(12, 4.0, "right");
  for (std::size_t i = 0; i < 6; ++i) {
    persons.compared.people[i].hands = {"arm", "mouse"};
    persons.backgrounds["P-" + std::to_string(i)].sites = {"North", "South"};
  }
  const auto all = subgroups_of(persons.compared, kAtMost5, persons.backgrounds);
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].groups[0].name, "mouse");
  EXPECT_EQ(all[0].groups[1].name, "several");
  EXPECT_EQ(all[1].by, "Site");
  EXPECT_EQ(all[1].groups[0].name, "several");
  EXPECT_EQ(all[1].groups[1].name, "unknown");
}

TEST(SubgroupsPanel, TellsRatesAndWithholds) {
  Persons persons;
  persons.add(12, 4.0, "right");
  persons.add(6, 6.0, "left");
  ValidityReport report;
  report.plan.frozen_us = 1;
  persons.compared.outcome.name = "Distance <mm>";
  persons.compared.outcome.metric = "tip_target_dist";
  persons.compared.outcome.case_id = "case";
  report.result.primary.push_back(persons.compared);
  report.backgrounds = persons.backgrounds;
  EXPECT_THAT(subgroups_panel(report).str(), HasSubstr("None yet.")) << "there is no mark";
  report.marks.rules["case"].criteria = {{"tip_target_dist", 1, assessment::Comparison::at_most, 5.0}};
  const std::string page = subgroups_panel(report).str();
  EXPECT_THAT(page, HasSubstr("Distance &lt;mm&gt;"));
  EXPECT_THAT(page, HasSubstr("Writing hand: right</td><td>12 of 12 <span class=\"why\">76 to 100 %"));
  EXPECT_THAT(page, HasSubstr("Writing hand: left</td><td>0 of 6 <span class=\"why\">0 to 39 %"));
  EXPECT_THAT(page, HasSubstr("−100 points [−100 to −54]; descriptive"));
  report.result.primary.front().people.resize(16);
  EXPECT_THAT(subgroups_panel(report).str(), HasSubstr("Writing hand: left</td><td colspan=\"2\">withheld"));
  EXPECT_THAT(subgroups_panel(report).str(), Not(HasSubstr("12 of 12")));
}

}  // namespace
}  // namespace seldinger::reports
