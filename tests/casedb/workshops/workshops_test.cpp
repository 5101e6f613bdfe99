// A workshop's day: nobody has a number before they consent, orders are balanced however many come, what is done is
// told by attempts since then, and who goes is on no board.
#include "casedb/workshops/workshops.h"

#include <algorithm>
#include <set>

#include "casedb/database/sqlite.h"
#include "casedb/keeping/erase.h"
#include "casedb/people/consent.h"
#include "casedb/people/people.h"
#include "casedb/studies/plans.h"
#include "tests/assessment/study/sample_plan.h"
#include "tests/casedb/library_samples.h"

namespace seldinger::casedb {
namespace {

class WorkshopsTest : public testing::Test {
 protected:
  Library library_ = open_library(fresh_folder() / "library");
  std::string case_id_ = add_case(library_, sample_case());
  std::string lesion_id_ = add_lesion(library_, case_id_, sample_lesion()).value();
  std::string study_ = add_study(library_, "Day").value();

  std::string person(const std::string& name) {
    return add_user(library_, name, Role::trainee, "a password").value();
  }
  Workshop open() {
    return open_workshop(library_, {study_, "Autumn", {{"Kidney", case_id_}, {"Talk"}, {"Film"}}, {"new", "old"}})
        .value();
  }
  void ask() { ASSERT_TRUE(add_consent_text(library_, study_, "May we?")); }
  void attempt_by(const std::string& person_id, std::int64_t started_us) {
    NewAttempt made = sample_attempt(case_id_, lesion_id_);
    made.person_id = person_id;
    made.operator_name = kPersonOperator;
    made.started_us = started_us;
    made.recording = sample_recording(100, static_cast<std::uint64_t>(started_us));
    ASSERT_TRUE(add_attempt(library_, made));
  }
  template <typename T>
  static std::string code_of(const base::Result<T>& result) {
    return result ? "none" : result.error().code;
  }
};

TEST_F(WorkshopsTest, WhatIsOpenedIsFoundAndWhatCannotBeIsRefused) {
  const Workshop day = open();
  std::string typed = day.code.substr(0, 3) + "-" + day.code.substr(3);
  for (char& c : typed) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const Workshop found = find_workshop(library_, typed).value();
  EXPECT_EQ(found.workshop_id, day.workshop_id);
  EXPECT_EQ(found.groups, (std::vector<std::string>{"new", "old"}));
  ASSERT_EQ(found.stations.size(), 3U);
  EXPECT_EQ(found.stations[0].case_id, case_id_);
  EXPECT_FALSE(found.stations[1].case_id);
  EXPECT_EQ(code_of(find_workshop(library_, "XXXXXX")), "no_workshop");
  EXPECT_EQ(code_of(open_workshop(library_, {study_, "", {{"a"}, {"b"}}})), "bad_title");
  EXPECT_EQ(code_of(open_workshop(library_, {study_, "Day", {{"a"}}})), "bad_stations");
  EXPECT_EQ(code_of(open_workshop(library_, {study_, "Day", {{"a"}, {"a"}}})), "bad_stations");
  EXPECT_EQ(code_of(open_workshop(library_, {study_, "Day", {{"a"}, {"b", "none"}}})), "no_case");
  EXPECT_EQ(code_of(open_workshop(library_, {study_, "Day", {{"a"}, {"b"}}, {"one"}})), "bad_group");
  EXPECT_EQ(code_of(open_workshop(library_, {"none", "Day", {{"a"}, {"b"}}})), "no_study");
  EXPECT_EQ(list_workshops(library_).size(), 1U);
}

TEST_F(WorkshopsTest, NobodyComesInWithoutConsent) {
  const Workshop day = open();
  const std::string zoe = person("Zoe"), tim = person("Tim");
  EXPECT_EQ(code_of(admit_to_workshop(library_, day, zoe, "new", true)), "no_text") << "the study asks nothing";
  ask();
  EXPECT_EQ(code_of(admit_to_workshop(library_, day, "nobody", "new", true)), "no_person");
  EXPECT_EQ(code_of(admit_to_workshop(library_, day, zoe, "new", false)), "no_consent");
  EXPECT_EQ(code_of(admit_to_workshop(library_, day, zoe, "other", true)), "bad_group");
  EXPECT_TRUE(consenting_people(library_, study_).empty()) << "of whom is refused nothing is kept";
  EXPECT_TRUE(list_participants(library_, day).empty());

  EXPECT_EQ(admit_to_workshop(library_, day, zoe, "new", true)->number, 1);
  EXPECT_EQ(consenting_people(library_, study_), (std::set<std::string>{zoe}))
      << "kept among the people's consents";
  EXPECT_EQ(code_of(admit_to_workshop(library_, day, zoe, "new", false)), "already_admitted");
  ASSERT_TRUE(give_consent(library_, tim, list_consents(library_, tim)[0].text_id));
  EXPECT_EQ(admit_to_workshop(library_, day, tim, "old", false)->number, 2);
  ASSERT_TRUE(close_workshop(library_, day));
  EXPECT_EQ(code_of(close_workshop(library_, day)), "workshop_closed");
  EXPECT_EQ(code_of(admit_to_workshop(library_, day, person("Ann"), "new", true)), "workshop_closed");
}

TEST_F(WorkshopsTest, NobodyRealComesToAStudyOfSimulatedPeople) {
  ask();
  std::string plan = assessment::study::sample_plan_json(R"(, "people": "simulated")");
  for (std::size_t at = plan.find("case-1"); at != plan.npos; at = plan.find("case-1"))
    plan.replace(at, 6, case_id_);
  const Workshop day = open();  // before it is planned
  ASSERT_TRUE(store_plan(library_, study_, plan));
  EXPECT_EQ(code_of(admit_to_workshop(library_, day, person("Zoe"), "new", true)), "real_person");
  EXPECT_TRUE(consenting_people(library_, study_).empty()) << "of whom is refused nothing is kept";
  EXPECT_EQ(code_of(open_workshop(library_, {study_, "Winter", {{"Talk"}, {"Film"}}})), "real_person");
}

TEST_F(WorkshopsTest, WhatIsDoneIsToldFromWhenSomebodyCame) {
  ask();
  const Workshop day = open();
  const std::string zoe = person("Zoe");
  attempt_by(zoe, 1'000'000);
  const Participant came = admit_to_workshop(library_, day, zoe, "new", true).value();
  EXPECT_EQ(came.done, (std::vector<bool>{false, false, false}))
      << "what was before the consent counts for nothing";
  EXPECT_EQ(came.next(), came.order.front());
  attempt_by(zoe, came.came_us + 1);
  ASSERT_TRUE(tick_in_workshop(library_, day, 1, "Talk"));
  ASSERT_TRUE(tick_in_workshop(library_, day, 1, "Talk"));
  EXPECT_EQ(code_of(tick_in_workshop(library_, day, 1, "Kidney")), "no_station") << "an attempt tells";
  EXPECT_EQ(code_of(tick_in_workshop(library_, day, 2, "Talk")), "no_participant");
  Participant now = list_participants(library_, day).at(0);
  EXPECT_EQ(now.done, (std::vector<bool>{true, true, false}));
  EXPECT_EQ(now.next(), 2U);
  ASSERT_TRUE(tick_in_workshop(library_, day, 1, "Film"));
  EXPECT_FALSE(list_participants(library_, day).at(0).next());
}

TEST_F(WorkshopsTest, OrdersAreBalancedInEachGroupHoweverManyCome) {
  ask();
  const Workshop day = open();
  std::map<std::string, std::vector<std::vector<std::size_t>>> orders;
  for (int i = 0; i < 10; ++i) {
    const std::string group = i % 3 == 0 ? "old" : "new";
    const Participant one =
        admit_to_workshop(library_, day, person("person" + std::to_string(i)), group, true).value();
    EXPECT_EQ(one.number, i + 1);
    auto& of = orders[group];
    of.push_back(one.order);
    for (std::size_t turn = 0; turn < 3; ++turn) {
      std::vector<int> at(3);
      for (const auto& order : of) ++at[order[turn]];
      const auto [least, most] = std::minmax_element(at.begin(), at.end());
      EXPECT_LE(*most - *least, 1) << group << " after " << of.size() << ", turn " << turn;
    }
  }
  const auto all = list_participants(library_, day);
  std::map<std::string, std::size_t> nth;
  for (const Participant& one : all) EXPECT_EQ(one.order, orders[one.group][nth[one.group]++]) << "they stay";
}

TEST_F(WorkshopsTest, WhoGoesIsOnNoBoard) {
  ask();
  const Workshop day = open();
  const std::string zoe = person("Zoe"), tim = person("Tim"), ann = person("Ann");
  for (const std::string& one : {zoe, tim, ann}) ASSERT_TRUE(admit_to_workshop(library_, day, one, "new", true));
  ASSERT_TRUE(tick_in_workshop(library_, day, 1, "Talk"));
  const auto anns = list_participants(library_, day).at(2).order;
  ASSERT_TRUE(withdraw_consent(library_, tim, list_consents(library_, tim)[0].text_id));
  ASSERT_TRUE(erase_person(library_, "Zoe", {}));
  EXPECT_EQ(library_.database().integer("SELECT count(*) FROM workshop_tick"), 0);
  const auto left = list_participants(library_, day);
  ASSERT_EQ(left.size(), 1U);
  EXPECT_EQ(left[0].number, 3) << "numbers stay";
  EXPECT_EQ(left[0].order, anns);
  EXPECT_EQ(admit_to_workshop(library_, day, person("Bob"), "new", true)->number, 4);
  EXPECT_TRUE(
      refused_by_constraint([&] { library_.database().run("UPDATE workshop_participant SET number = 9"); }));
}

}  // namespace
}  // namespace seldinger::casedb
