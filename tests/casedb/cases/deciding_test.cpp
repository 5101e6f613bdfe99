// From draft to published: who may decide, what is kept of it, and what is published stays.
#include "casedb/cases/permissions.h"
#include "casedb/database/audit.h"
#include "casedb/people/cohorts.h"
#include "tests/casedb/cases/authoring_case.h"

namespace seldinger::casedb {
namespace {

// Was: kept only when the role was the reason.
TEST_F(AuthoringTest, EachRefusedDecisionIsKept) {
  add_users();
  const auto kept = [&] {
    const auto rows = list_audit(library_);
    return rows.back().act + " " + rows.back().object_id + " " + rows.back().result;
  };
  EXPECT_EQ(code(judge_case(library_, case_id_, "ben", true)), "bad_state");
  EXPECT_EQ(kept(), "approve_case " + case_id_ + " refused");
  EXPECT_EQ(code(retire_case(library_, case_id_, "dora")), "not_allowed");
  EXPECT_EQ(kept(), "retire_case " + case_id_ + " refused");
  static_cast<void>(add_lesion(library_, case_id_, sample_lesion()).value());
  ASSERT_TRUE(submit_case(library_, case_id_, "ann"));
  ASSERT_TRUE(judge_case(library_, case_id_, "ben", true));
  EXPECT_EQ(code(publish("dora", false)), "burned_in_unchecked");
  EXPECT_EQ(kept(), "publish_case " + case_id_ + " refused");
  // Neither of a case that there is not, nor by nobody, nor what was only typed.
  const std::size_t rows = list_audit(library_).size();
  EXPECT_EQ(code(retire_case(library_, "no such id, but typed", "dora")), "no_case");
  EXPECT_EQ(code(submit_case(library_, case_id_, "nobody")), "no_user");
  EXPECT_EQ(code(submit_case(library_, case_id_, "ann", "two\nlines")), "bad_note");
  EXPECT_EQ(list_audit(library_).size(), rows);
}

TEST_F(AuthoringTest, FromDraftToPublishedBySecondPerson) {
  add_users();
  static_cast<void>(add_structure(library_, drawn("vein", cases::Sphere{middle(), 1.0})).value());
  static_cast<void>(add_lesion(library_, case_id_, sample_lesion()).value());
  EXPECT_EQ(code(submit_case(library_, case_id_, "tim")), "not_allowed");
  EXPECT_EQ(code(submit_case(library_, case_id_, "dora")), "not_allowed");
  EXPECT_EQ(code(submit_case(library_, case_id_, "nobody")), "no_user");
  EXPECT_EQ(code(judge_case(library_, case_id_, "ben", true)), "bad_state");
  EXPECT_EQ(code(publish("ann", false)), "not_allowed") << "nobody approved it";
  ASSERT_TRUE(submit_case(library_, case_id_, "ann", "please"));
  EXPECT_EQ(state(), CaseState::review);
  EXPECT_EQ(code(set_setting(library_, case_id_, full_setting())), "not_a_draft");
  EXPECT_EQ(code(add_lesion(library_, case_id_, sample_lesion())), "not_a_draft");
  EXPECT_EQ(code(judge_case(library_, case_id_, "ann", true)), "not_allowed") << "not who submitted it";
  EXPECT_EQ(code(judge_case(library_, case_id_, "adam", true)), "not_allowed");
  ASSERT_TRUE(judge_case(library_, case_id_, "ben", false, "the vein is missing"));
  EXPECT_EQ(state(), CaseState::draft);
  ASSERT_TRUE(submit_case(library_, case_id_, "ann"));
  EXPECT_EQ(code(publish("dora", false)), "not_allowed");
  ASSERT_TRUE(judge_case(library_, case_id_, "dora", true));
  EXPECT_EQ(code(publish("tim", false)), "not_allowed");
  EXPECT_EQ(code(publish("ann", false)), "not_allowed") << "a second person publishes, not who submitted it";
  EXPECT_EQ(code(publish("ben", false)), "burned_in_unchecked");
  ASSERT_TRUE(confirm_no_burned_in_text(library_, case_id_, std::nullopt));
  ASSERT_TRUE(publish("dora", false)) << "who approved it may";
  EXPECT_EQ(state(), CaseState::published);
  EXPECT_FALSE(find_case(library_, case_id_).value().own_cohort_only);
  const auto decisions = list_decisions(library_, case_id_);
  ASSERT_EQ(decisions.size(), 5U);
  EXPECT_EQ(decisions[1].note, "the vein is missing");
  ASSERT_TRUE(review_of(decisions).has_value());
  EXPECT_EQ(review_of(decisions)->pseudonym.substr(0, 2), "P-");

  for (const char* change :
       {"UPDATE training_case SET state = 'draft'", "UPDATE training_case SET title = 'x'",
        "UPDATE training_case SET audience = 'own_cohort'", "UPDATE training_case SET inr = 3",
        "UPDATE training_case SET version = 2", "DELETE FROM training_case", "DELETE FROM lesion",
        "DELETE FROM structure", "UPDATE case_decision SET note = ''", "DELETE FROM case_decision"})
    refuse(change);
  EXPECT_EQ(code(set_title(library_, case_id_, "x")), "not_a_draft");
  EXPECT_EQ(code(retire_case(library_, case_id_, "ben")), "not_allowed");
  ASSERT_TRUE(retire_case(library_, case_id_, "adam"));
  EXPECT_EQ(state(), CaseState::retired);
  refuse("UPDATE training_case SET state = 'published'");
}

TEST_F(AuthoringTest, ALoneMentorPublishesToHisOwnCohort) {
  add_users();
  const std::string own = add_cohort(library_, "Own", "Radiology", "").value(),
                    others = add_cohort(library_, "Other", "Radiology", "").value(),
                    former = add_cohort(library_, "Former", "Radiology", "").value();
  const auto put = [&](const std::string& cohort, const std::string& name, Post post) {
    ASSERT_TRUE(enrol(library_, cohort, open_account(library_, name)->person_id, post));
  };
  for (const char* name : {"tom", "late"}) static_cast<void>(add_user(library_, name, Role::trainee, "a password"));
  ASSERT_TRUE(confirm_no_burned_in_text(library_, case_id_, std::nullopt));
  EXPECT_EQ(code(publish("ann", true)), "no_cohort");  // before: published, and it reached nobody
  EXPECT_EQ(state(), CaseState::draft);
  EXPECT_TRUE(list_decisions(library_, case_id_).empty());
  put(own, "ann", Post::mentor);
  put(own, "tim", Post::learner);
  put(others, "tom", Post::learner);
  put(others, "ben", Post::mentor);
  put(former, "ann", Post::mentor);
  put(former, "late", Post::learner);
  ASSERT_TRUE(end_enrolment(library_, former, open_account(library_, "ann")->person_id));
  EXPECT_EQ(code(publish("dora", true)), "not_allowed");
  ASSERT_TRUE(publish("ann", true));
  EXPECT_TRUE(find_case(library_, case_id_).value().own_cohort_only);
  EXPECT_FALSE(review_of(list_decisions(library_, case_id_)).has_value());
  const auto reaches = [&](const std::string& name) {
    return reaches_own_cohort(library_, case_id_, open_account(library_, name)->person_id);
  };
  EXPECT_TRUE(reaches("ann")) << "who published it";
  EXPECT_TRUE(reaches("tim"));
  EXPECT_FALSE(reaches("ben"));
  EXPECT_FALSE(reaches("tom")) << "in another cohort";
  EXPECT_FALSE(reaches("late")) << "of a cohort that ann led no longer";
  ASSERT_TRUE(end_enrolment(library_, own, open_account(library_, "tim")->person_id));
  EXPECT_FALSE(reaches("tim")) << "no longer in it";
  ASSERT_TRUE(retire_case(library_, case_id_, "ann")) << "who published it may take it back";
}

// What was looked at is what is published: a check is of one case, as it was then.
TEST_F(AuthoringTest, OnlyACheckOfTheCaseAsItIsLetsItBePublished) {
  add_users();
  ASSERT_TRUE(confirm_no_burned_in_text(library_, case_id_, std::nullopt));
  const auto publish_by = [&](const CaseCheck& check) {
    return publish_case(library_, case_id_, check, "ann", true);
  };
  EXPECT_EQ(code(publish_by({})), "checks_failed") << "nobody has looked";

  CaseCheck failed = fixtures::sound_check(library_, case_id_);
  failed.checks.push_back({"lesion_present", false, "there is no lesion"});
  const auto refused = publish_by(failed);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, "checks_failed");
  ASSERT_EQ(refused.error().findings.size(), 1U) << "what holds is no finding";
  EXPECT_EQ(refused.error().findings[0].code, "lesion_present");
  EXPECT_EQ(refused.error().findings[0].text, "there is no lesion");
  EXPECT_EQ(ready_to_publish(failed).error().text, refused.error().text) << "one text, whoever asks";

  EXPECT_EQ(code(publish_by(fixtures::sound_check(library_, add_case(library_, sample_case())))), "checks_failed")
      << "another case's, though it is made of the same volume";

  const std::string lesion_id = add_lesion(library_, case_id_, sample_lesion()).value();
  const std::pair<const char*, std::function<base::Result<void>()>> changes[] = {
      {"a lesion goes", [&] { return remove_lesion(library_, case_id_, lesion_id); }},
      {"a structure comes",
       [&]() -> base::Result<void> {
         const auto added = add_structure(library_, drawn("vein", cases::Sphere{middle(), 1.0}));
         return added ? base::Result<void>() : added.error();
       }},
      {"the setting changes", [&] { return set_setting(library_, case_id_, full_setting()); }}};
  for (const auto& [what, change] : changes) {
    const CaseCheck before = fixtures::sound_check(library_, case_id_);
    ASSERT_TRUE(change()) << what;
    EXPECT_EQ(code(publish_by(before)), "checks_failed") << what;
  }
  EXPECT_EQ(state(), CaseState::draft) << "nothing of what was refused was written";
  EXPECT_TRUE(list_decisions(library_, case_id_).empty());

  // What no check looks at: the title, a decision, an attempt.
  const std::string again = add_lesion(library_, case_id_, sample_lesion()).value();
  const CaseCheck check = fixtures::sound_check(library_, case_id_);
  ASSERT_TRUE(set_title(library_, case_id_, "Another title"));
  static_cast<void>(add_attempt(library_, sample_attempt(case_id_, again)).value());
  ASSERT_TRUE(submit_case(library_, case_id_, "ann"));
  ASSERT_TRUE(judge_case(library_, case_id_, "ben", true));
  ASSERT_TRUE(publish_case(library_, case_id_, check, "ben", true));
  EXPECT_EQ(state(), CaseState::published);
}

TEST_F(AuthoringTest, AClosedAccountDecidesNothing) {
  add_users();
  ASSERT_TRUE(set_enabled(library_, "ann", false));
  EXPECT_EQ(code(submit_case(library_, case_id_, "ann")), "no_user");
}

TEST_F(AuthoringTest, ANewVersionIsADraftOfTheSameFamily) {
  add_users();
  ASSERT_TRUE(set_setting(library_, case_id_, full_setting()));
  static_cast<void>(add_structure(library_, drawn("vein", cases::Sphere{middle(), 1.0})).value());
  const std::string lesion_id = add_lesion(library_, case_id_, sample_lesion()).value();
  static_cast<void>(add_attempt(library_, sample_attempt(case_id_, lesion_id)).value());
  ASSERT_TRUE(confirm_no_burned_in_text(library_, case_id_, std::nullopt));
  ASSERT_TRUE(enrol(library_, add_cohort(library_, "Own", "Radiology", "").value(),
                    open_account(library_, "ann")->person_id, Post::mentor));
  ASSERT_TRUE(publish("ann", true));
  EXPECT_EQ(code(new_version(library_, case_id_, "tim")), "not_allowed");
  const std::string second = new_version(library_, case_id_, "ann").value();
  const std::string third = new_version(library_, second, "ben").value();
  for (const auto& [id, version] : {std::pair{case_id_, 1}, {second, 2}, {third, 3}}) {
    const CaseRow row = find_case(library_, id).value();
    EXPECT_EQ(row.version, version);
    EXPECT_EQ(row.family_id, case_id_);
    EXPECT_EQ(row.state, version == 1 ? CaseState::published : CaseState::draft);
    EXPECT_EQ(row.title, sample_case().title);
    EXPECT_EQ(row.attempt_limit, 5);
    EXPECT_EQ(row.attributes.size(), 3U);
    EXPECT_EQ(row.warnings.size(), 2U);
    EXPECT_EQ(list_lesions(library_, id).size(), 1U);
    EXPECT_EQ(list_structures(library_, id).size(), 1U);
  }
  // A case of an older library shows by the law of then; its next version by the newest.
  EXPECT_TRUE(refused_by_constraint([&] {
    library_.database().run("UPDATE training_case SET sight_law = 'half_slice' WHERE case_id = '" + case_id_ + "'");
  }));
  library_.database().run("DROP TRIGGER training_case_keeps_its_sight_law");
  library_.database().run("UPDATE training_case SET sight_law = 'half_slice' WHERE case_id = '" + case_id_ + "'");
  EXPECT_EQ(find_case(library_, case_id_).value().sight_law, cases::SightLaw::half_slice);
  const std::string fourth = new_version(library_, case_id_, "ann").value();
  EXPECT_EQ(find_case(library_, fourth).value().sight_law, cases::kNewestSightLaw);
  // The new one changes; the old one and its attempt do not.
  CaseSetting other = full_setting();
  other.attempt_limit = 9;
  ASSERT_TRUE(set_setting(library_, second, other));
  ASSERT_TRUE(remove_structure(library_, second, "vein"));
  EXPECT_EQ(find_case(library_, case_id_).value().attempt_limit, 5);
  EXPECT_EQ(list_structures(library_, case_id_).size(), 1U);
  EXPECT_EQ(list_attempts(library_).front().case_id, case_id_);
  EXPECT_EQ(library_.database().integer("SELECT count(*) FROM pragma_foreign_key_check"), 0);
}

}  // namespace
}  // namespace seldinger::casedb
