// What a workstation offers to each role: what the table of permissions allows, and nothing else.
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "casedb/attempts/attempts.h"
#include "casedb/database/sqlite.h"
#include "tests/app/window/trainer/trainer_case.h"

namespace seldinger::app {
namespace {

using casedb::Action;
using casedb::CaseState;
using casedb::Role;

class TrainerRolesTest : public TrainerTest {
 protected:
  static constexpr std::pair<const char*, Role> kPeople[] = {{"tina", Role::trainee},
                                                             {"mona", Role::mentor},
                                                             {"rita", Role::researcher},
                                                             {"dora", Role::director},
                                                             {"adam", Role::admin}};
  void SetUp() override {
    TrainerTest::SetUp();
    casedb::Library library = open();
    for (const auto& [name, role] : kPeople)
      if (role != Role::trainee && role != Role::mentor) {
        ASSERT_TRUE(casedb::add_user(library, name, role, kPassword));
      }
    ASSERT_TRUE(casedb::add_user(library, "tom", Role::trainee, kPassword));  // in nobody's cohort
  }
  void put_into(const std::string& state) {
    casedb::Library library = open();
    casedb::Transaction transaction(library.database());
    library.database().run("UPDATE training_case SET state = '" + state + "'");
    transaction.commit();
  }
  bool is_offered(const Trainer& trainer) const {
    return std::ranges::any_of(trainer.choices(), [&](const Choice& one) { return one.case_id == case_id_; });
  }
  bool is_draft_of(const Trainer& trainer) const {
    return std::ranges::any_of(trainer.drafts(), [&](const CaseDraft& one) { return one.case_id == case_id_; });
  }
};

TEST_F(TrainerRolesTest, OffersWhatTheTableAllows) {
  int practised = 0, worked_on = 0;
  for (const auto& [name, state] : {std::pair("draft", CaseState::draft),
                                    {"review", CaseState::review},
                                    {"published", CaseState::published},
                                    {"retired", CaseState::retired}}) {
    if (state != CaseState::draft) put_into(name);
    for (const auto& [who, role] : kPeople) {
      SCOPED_TRACE(std::string(who) + ", " + name);
      Trainer trainer(open());
      trainer.log_in(who, kPassword);
      ASSERT_EQ(trainer.screen(), TrainerScreen::choose);
      casedb::Subject subject = state;
      subject.reached = true;
      // A draft that nobody has practised is tried in the case editor, and not practised.
      const bool practises = state != CaseState::draft && casedb::may(role, Action::practise_case, subject);
      const bool works_on = casedb::may(role, Action::work_on_case, state);
      EXPECT_EQ(is_offered(trainer), practises);
      EXPECT_EQ(is_draft_of(trainer), works_on);
      trainer.open_editor(case_id_);
      EXPECT_EQ(trainer.screen() == TrainerScreen::editor, works_on);
      trainer.leave_editor();
      trainer.choose(case_id_);
      EXPECT_EQ(trainer.screen() == TrainerScreen::briefing, practises);
      practised += practises;
      worked_on += works_on;
    }
  }
  EXPECT_GT(practised, 0);
  EXPECT_GT(worked_on, 0);
}

TEST_F(TrainerRolesTest, MakesVersionsForWhoMayOnly) {
  put_into("published");
  for (const auto& [who, role] : kPeople) {
    if (casedb::may(role, Action::make_case_version) && role != Role::mentor) continue;  // one draft is enough
    Trainer trainer(open());
    trainer.log_in(who, kPassword);
    casedb::Library library = open();
    const std::size_t before = casedb::list_case_heads(library).size();
    trainer.new_version(case_id_);
    EXPECT_EQ(casedb::list_case_heads(library).size() > before, casedb::may(role, Action::make_case_version))
        << who;
  }
}

TEST_F(TrainerRolesTest, ACaseForACohortIsOfferedToThatCohort) {
  publish();
  for (const auto& [who, reaches] : {std::pair("tina", true), {"tom", false}}) {
    Trainer trainer(open());
    trainer.log_in(who, kPassword);
    EXPECT_EQ(is_offered(trainer), reaches) << who;
  }
}

// Was: whichever attempt was asked for was watched, if only a screen had named it.
TEST_F(TrainerRolesTest, NobodyWatchesWhatIsSomebodyElses) {
  publish();
  std::string of_tina;
  {
    Trainer trainer(open());
    begin(trainer, "tina", false);
    fire_at_the_target(*trainer.attempt());
    trainer.attempt()->end();
    ASSERT_TRUE(looks_until(trainer, TrainerScreen::debrief)) << trainer.refusal();
    of_tina = trainer.debrief()->attempt.attempt_id;
    trainer.watch(of_tina);
    EXPECT_EQ(trainer.screen(), TrainerScreen::watch) << "one's own";
  }
  Trainer trainer(open());
  trainer.log_in("mona", kPassword);
  trainer.choose(case_id_);
  ASSERT_EQ(trainer.screen(), TrainerScreen::briefing);
  trainer.watch(of_tina);
  EXPECT_EQ(trainer.screen(), TrainerScreen::briefing);
  EXPECT_EQ(trainer.watched(), nullptr);
}

// Followed while it is made, by whom the table lets see it by name; to its end, where it is an attempt like any
// other.
TEST_F(TrainerRolesTest, AMentorFollowsWhoIsInTheRoom) {
  publish();
  Trainer room(open());
  begin(room, "tina", false);
  const auto sees = [&](Trainer& trainer) {
    trainer.look();
    return !trainer.in_room().empty();
  };
  for (const char* who : {"tom", "rita", "adam", "tina"}) {
    Trainer trainer(open());
    trainer.log_in(who, kPassword);
    EXPECT_FALSE(sees(trainer)) << who;
  }
  Trainer trainer(open());
  trainer.log_in("mona", kPassword);
  ASSERT_TRUE(until([&] { return sees(trainer); }));
  EXPECT_EQ(trainer.in_room().front().who, "tina");
  EXPECT_EQ(trainer.in_room().front().case_title, "Ball");
  trainer.look_in("another");
  EXPECT_EQ(trainer.screen(), TrainerScreen::choose);
  trainer.look_in(trainer.in_room().front().attempt_id);
  ASSERT_EQ(trainer.screen(), TrainerScreen::watch);
  const auto at_s = [&] {
    room.look();
    trainer.look();
    const auto moment = trainer.watched()->moment();
    return moment ? moment->state.t_s : 0.0;
  };
  ASSERT_TRUE(until([&] { return at_s() > 2.5; })) << "more than what was stored when it was first looked at";
  EXPECT_TRUE(trainer.watched()->live());
  ASSERT_TRUE(trainer.may_cause());
  trainer.cause(cases::EventKind::sign_in);
  EXPECT_NE(trainer.refusal(), "") << "no mentor's";
  trainer.cause(cases::EventKind::cough);
  EXPECT_EQ(trainer.refusal(), "");
  EXPECT_TRUE(until([&] {
    const auto seen = room.attempt()->seen();
    return seen && seen->moment.event == cases::EventKind::cough;
  })) << "it happens in the room";
  room.attempt()->end();
  EXPECT_TRUE(until([&] {
    at_s();
    return trainer.watched()->phase() == session::WatchedAttempt::Phase::over;
  }));
  EXPECT_FALSE(trainer.watched()->live());
  trainer.stop_watching();
  EXPECT_EQ(trainer.screen(), TrainerScreen::choose);
}

}  // namespace
}  // namespace seldinger::app
