// Which attempt is shown to a trainee as the expert's.
#include "casedb/grading/expert_replay.h"

#include "casedb/grading/grading.h"
#include "casedb/people/consent.h"
#include "tests/casedb/graded_library.h"

namespace seldinger::casedb {
namespace {

class ExpertReplay : public GradedLibrary {
 protected:
  void SetUp() override {
    rule({"hit >= 1"});
    CaseSetting setting = find_case(library_, case_id_).value();
    setting.modality = cases::Modality::ultrasound;
    setting.approach = cases::Approach::in_plane;
    setting.instrument.kind = cases::InstrumentKind::access;
    ASSERT_TRUE(set_setting(library_, case_id_, setting).has_value());
  }
  NewAttempt made(const std::string& operator_name, bool passes, std::int64_t started_us) {
    NewAttempt one = new_attempt(std::nullopt, passes ? 1.0 : 0.0, 12.0);
    one.operator_name = operator_name;
    one.started_us = started_us;
    one.picture.modality = cases::Modality::ultrasound;
    one.approach = cases::Approach::in_plane;
    one.instrument.kind = cases::InstrumentKind::access;
    return one;
  }
  std::string stored(const NewAttempt& one) { return add_attempt(library_, one).value(); }
  const std::string trainee_ = user("T", Role::trainee);
  std::optional<std::string> shown() { return expert_replay_of(library_, case_id_, trainee_, Role::trainee); }
  const std::int64_t now_ = now_us();
};

TEST_F(ExpertReplay, IsTheNewestThatTheSimulatedExpertPassed) {
  EXPECT_EQ(shown(), std::nullopt);
  stored(made("novice", true, now_ + 9));
  stored(made("intermediate", true, now_ + 9));
  stored(made("expert", false, now_ + 9));
  EXPECT_EQ(shown(), std::nullopt) << "nobody who is an expert has passed";
  const std::string later = stored(made("expert", true, now_ + 2));
  EXPECT_EQ(shown(), later);
  stored(made("expert", true, now_ + 1));
  EXPECT_EQ(shown(), later) << "stored later, made earlier";
  const std::string newest = stored(made("expert", true, now_ + 3));
  EXPECT_EQ(shown(), newest);
}

TEST_F(ExpertReplay, IsAConsultantsWhereThatIsNewer) {
  const std::string person = user("C", Role::trainee);
  NewAttempt own = made("person", true, now_us());
  own.person_id = person;
  stored(own);
  EXPECT_EQ(shown(), std::nullopt) << "a trainee's";
  ASSERT_TRUE(set_level(library_, "C", Level::consultant).has_value());
  const std::int64_t then = now_us();
  own.started_us = then;
  const std::string consultants = stored(own);
  EXPECT_EQ(shown(), std::nullopt) << "before: shown to every trainee, and the consultant was not asked";
  EXPECT_EQ(expert_replay_of(library_, case_id_, person, Role::trainee), consultants) << "their own";
  ASSERT_TRUE(add_consent_text(library_, std::nullopt, "May your attempts be used?"));
  const std::string text = list_consents(library_, person).at(0).text_id;
  ASSERT_TRUE(give_consent(library_, person, text));
  EXPECT_EQ(shown(), consultants);
  stored(made("expert", true, then - 1));
  EXPECT_EQ(shown(), consultants);
  const std::string simulated = stored(made("expert", true, then + 1));
  EXPECT_EQ(shown(), simulated);
  own.started_us = then + 2;
  own.metrics[3].value = 0.0;  // hit
  stored(own);
  EXPECT_EQ(shown(), simulated) << "a consultant who missed";
  own.metrics[3].value = 1.0;
  own.started_us = then + 3;
  const std::string newest = stored(own);
  EXPECT_EQ(shown(), newest);
  ASSERT_TRUE(withdraw_consent(library_, person, text));
  EXPECT_EQ(shown(), simulated) << "no longer agreed";
}

TEST_F(ExpertReplay, IsOfTheCaseAsItIsPractised) {
  NewAttempt other = made("expert", true, now_);
  other.picture.modality = cases::Modality::mpr;
  stored(other);
  other = made("expert", true, now_);
  other.approach = cases::Approach::out_of_plane;
  stored(other);
  other = made("expert", true, now_);
  other.instrument.kind = cases::InstrumentKind::core;
  stored(other);
  other = made("expert", true, now_);
  other.end = AttemptEnd::interrupted;
  stored(other);
  EXPECT_EQ(shown(), std::nullopt);
  EXPECT_EQ(expert_replay_of(library_, "no such case", trainee_, Role::trainee), std::nullopt);
}

}  // namespace
}  // namespace seldinger::casedb
