// Rounds of ratings in a library: who gets what is the seed's alone, what is sent stays, and with an attempt goes
// what was seen and said of it.
#include "casedb/ratings/rating_rounds.h"

#include <algorithm>
#include <set>

#include "assessment/questionnaire/shipped_forms.h"
#include "casedb/database/sqlite.h"
#include "casedb/database/tables.h"
#include "casedb/keeping/check.h"
#include "casedb/keeping/erase.h"
#include "casedb/people/consent.h"
#include "casedb/people/people.h"
#include "casedb/ratings/rated_people.h"
#include "tests/casedb/library_samples.h"

namespace seldinger::casedb {
namespace {

namespace questionnaire = assessment::questionnaire;
using assessment::rating::Part;

class RatingRoundsTest : public testing::Test {
 protected:
  std::filesystem::path folder_ = fresh_folder() / "library";
  std::optional<Library> library_ = open_library(folder_);
  std::string case_id_ = add_case(*library_, sample_case());
  std::string lesion_id_ = add_lesion(*library_, case_id_, sample_lesion()).value();
  std::string zoe_ = add_user(*library_, "Zoe", Role::trainee, "a password").value();
  std::string tim_ = add_user(*library_, "Tim", Role::trainee, "a password").value();
  std::vector<std::string> zoes_, tims_;

  void SetUp() override {
    for (const char* form : {"osats-grs", "needle-checklist", "workshop-2007"})
      ASSERT_TRUE(store_form(*library_, std::string(questionnaire::find_shipped_form(form)->json)));
    for (std::size_t i = 0; i < 6; ++i) {
      NewAttempt made = sample_attempt(case_id_, lesion_id_);
      made.person_id = i % 2 == 0 ? zoe_ : tim_;
      made.operator_name = kPersonOperator;
      made.recording = sample_recording(500, i);
      (i % 2 == 0 ? zoes_ : tims_).push_back(add_attempt(*library_, made).value());
    }
  }
  static std::string sheet_of(std::size_t i) { return "<section>replay " + std::to_string(i) + "</section>"; }
  NewRatingRound six(std::uint64_t seed = 1) const {
    NewRatingRound made;
    made.round = {"Replays", "osats-grs", 0, {}, {}};
    for (std::size_t i = 0; i < 3; ++i) {
      made.replays.push_back({zoes_[i], sheet_of(2 * i)});
      made.replays.push_back({tims_[i], sheet_of(2 * i + 1)});
    }
    made.raters = 3;
    made.seed = seed;
    return made;
  }
  static std::map<std::string, std::string> all_of(const std::string& point) {
    std::map<std::string, std::string> typed;
    for (const char* item : {"tissue", "time", "handling", "knowledge", "flow", "procedure"}) typed[item] = point;
    return typed;
  }
  std::string code_of_opening(const NewRatingRound& made) {
    const auto opened = open_rating_round(*library_, made);
    return opened ? "none" : opened.error().code;
  }
  std::int64_t count(const char* table) {
    return library_->database().integer(std::string("SELECT count(*) FROM ") + table);
  }
};

TEST_F(RatingRoundsTest, ARaterGetsABenchOfNumbersAndNothingElse) {
  const auto opened = open_rating_round(*library_, six());
  ASSERT_TRUE(opened.has_value());
  EXPECT_TRUE(opened->round.rated);
  ASSERT_EQ(opened->keys.size(), 3U);
  std::map<std::string, int> seen;
  for (const std::string& key : opened->keys) {
    ASSERT_EQ(key.size(), 14U) << key;
    std::string typed = " " + key;
    for (char& c : typed) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    const std::string secret = rater_secret(typed);
    const auto bench = find_rating_bench(*library_, secret);
    ASSERT_TRUE(bench.has_value());
    ASSERT_EQ(bench->tasks.size(), 4U) << "six replays by two each, three raters";
    for (std::size_t i = 0; i < bench->tasks.size(); ++i) {
      EXPECT_EQ(bench->tasks[i].number, i + 1);
      ++seen[find_rating(*library_, secret, i + 1)->sheet];
    }
    EXPECT_EQ(find_rating(*library_, secret, 5).error().code, "no_rating");
  }
  ASSERT_EQ(seen.size(), 6U);
  for (const auto& [sheet, times] : seen) EXPECT_EQ(times, 2) << sheet;
  EXPECT_EQ(find_rating_bench(*library_, rater_secret("abcd-efgh-jkmn")).error().code, "no_rater");
  EXPECT_EQ(find_rating_bench(*library_, opened->keys[0]).error().code, "no_rater") << "a key is not kept as it is";
}

TEST_F(RatingRoundsTest, WhatIsSentStaysAndIsHeldAgainstTheOthers) {
  const auto opened = open_rating_round(*library_, six());
  ASSERT_TRUE(opened.has_value());
  const std::string secret = rater_secret(opened->keys[0]);
  ASSERT_TRUE(keep_rating(*library_, secret, 1, {{"tissue", "4"}}, false));
  EXPECT_EQ(find_rating(*library_, secret, 1)->answers.at("tissue").value, 4.0) << "a draft";
  const auto bad = keep_rating(*library_, secret, 1, {{"tissue", "9"}}, true);
  EXPECT_EQ(bad.error().code, "bad_answer");
  EXPECT_FALSE(find_rating(*library_, secret, 1)->task.sent) << "nothing is sent that does not fit";
  ASSERT_TRUE(keep_rating(*library_, secret, 1, all_of("3"), true));
  EXPECT_EQ(keep_rating(*library_, secret, 1, all_of("5"), false).error().code, "rating_sent");
  auto half = all_of("2");
  half.erase("flow");
  half["time"] = "n/a";
  ASSERT_TRUE(keep_rating(*library_, secret, 2, half, true));
  half["flow"] = "4";
  ASSERT_TRUE(keep_rating(*library_, secret, 3, half, true));

  const auto ratings = list_ratings(*library_, opened->round.code);
  ASSERT_TRUE(ratings.has_value());
  EXPECT_EQ(ratings->asked, 12U);
  ASSERT_EQ(ratings->ratings.size(), 3U);
  const auto means = scores_of(*ratings, "");
  ASSERT_EQ(means.size(), 2U) << "a missing item leaves no mean";
  EXPECT_EQ(means[0].score, 3.0);
  EXPECT_DOUBLE_EQ(means[1].score, (4 * 2 + 4) / 5.0) << "what is not applicable is left out";
  EXPECT_EQ(scores_of(*ratings, "time").size(), 1U);
  EXPECT_TRUE(scores_of(*ratings, "nothing").empty());
  EXPECT_EQ(list_ratings(*library_, open_round(*library_, {"Day", "workshop-2007", 0, {}, {}})->code).error().code,
            "not_rated");
  ASSERT_TRUE(close_round(*library_, opened->round.round_id));
  EXPECT_EQ(keep_rating(*library_, secret, 4, all_of("5"), true).error().code, "round_closed");
}

TEST_F(RatingRoundsTest, NobodyElseAnswersUnderTheRoundsCode) {
  const auto opened = open_rating_round(*library_, six());
  EXPECT_EQ(begin_response(*library_, opened->round.code, {"A1"}).error().code, "rated_round");
  EXPECT_EQ(add_paper_forms(*library_, opened->round.code, {{{"A1"}, {}}}).error().code, "rated_round");
}

TEST_F(RatingRoundsTest, TheCalibrationSetComesFirstAndTellsItsScoresOnceSent) {
  NewRatingRound made = six();
  made.replays.resize(2);
  made.calibration = {{zoes_[2], sheet_of(8), all_of("4")}, {tims_[2], sheet_of(9), {{"tissue", "1"}}}};
  const auto opened = open_rating_round(*library_, made);
  ASSERT_TRUE(opened.has_value());
  const std::string secret = rater_secret(opened->keys[1]);
  const auto bench = find_rating_bench(*library_, secret);
  EXPECT_EQ(bench->tasks[0].part, Part::calibration);
  EXPECT_EQ(bench->tasks[1].part, Part::calibration);
  EXPECT_TRUE(find_rating(*library_, secret, 1)->known.empty()) << "not before they have said theirs";
  for (const std::size_t number : {1U, 2U}) ASSERT_TRUE(keep_rating(*library_, secret, number, all_of("5"), true));
  const auto page = find_rating(*library_, secret, 1), other = find_rating(*library_, secret, 2);
  const auto& full = page->sheet == sheet_of(8) ? page : other;
  EXPECT_EQ(full->known.size(), 6U);
  EXPECT_EQ(full->known.at("flow"), 4.0);
  const auto means = scores_of(*list_ratings(*library_, opened->round.code), "");
  EXPECT_EQ(std::count_if(means.begin(), means.end(), [](const auto& one) { return one.known == 4.0; }), 1);

  made.calibration[1].known = {{"tissue", "7"}, {"comment", "good"}};
  const auto refused = open_rating_round(*library_, made);
  EXPECT_EQ(refused.error().code, "bad_answers");
  EXPECT_EQ(refused.error().findings.size(), 3U) << "off the scale, no scale, no known score";
}

TEST_F(RatingRoundsTest, WhatCannotBeIsRefusedAndChangesNothing) {
  const auto assets = assets_named(library_->database()).size();
  NewRatingRound made = six();
  made.each = 4;
  EXPECT_EQ(code_of_opening(made), "bad_design");
  made = six();
  made.raters = 13;
  EXPECT_EQ(code_of_opening(made), "bad_design");
  made = six();
  made.replays.clear();
  EXPECT_EQ(code_of_opening(made), "bad_design");
  made = six();
  made.round.form_id = "workshop-2007";
  EXPECT_EQ(code_of_opening(made), "bad_rating_form") << "its scales have different lengths";
  made.round.form_id = "none";
  EXPECT_EQ(code_of_opening(made), "no_form");
  EXPECT_EQ(count("rating_round") + count("rating_view") + count("questionnaire_round"), 0);
  EXPECT_EQ(assets_named(library_->database()).size(), assets);
  library_.reset();
  EXPECT_TRUE(check_library(folder_, false, {}).value().holds()) << "no file is left behind";
}

// Relabelled people: the same replays under other names give every rater the same numbers, order and bytes.
TEST_F(RatingRoundsTest, WhoMadeAnAttemptHasNoPartInWhatARaterGets) {
  const auto told = [&](const NewRatingRound& made) {
    const auto opened = open_rating_round(*library_, made);
    std::vector<std::string> all;
    for (const std::string& key : opened->keys) {
      const std::string secret = rater_secret(key);
      const auto bench = find_rating_bench(*library_, secret);
      for (const RatingTask& task : bench->tasks)
        all.push_back(std::to_string(task.number) + find_rating(*library_, secret, task.number)->sheet);
    }
    return all;
  };
  NewRatingRound relabelled = six();
  for (std::size_t i = 0; i < 6; ++i) relabelled.replays[i].attempt_id = i % 2 == 0 ? tims_[i / 2] : zoes_[i / 2];
  EXPECT_EQ(told(six()), told(relabelled));
  EXPECT_NE(told(six()), told(six(2))) << "the seed has";
}

TEST_F(RatingRoundsTest, WithAPersonGoesWhatRatersSawAndSaidOfThem) {
  NewRatingRound made = six();
  made.calibration = {{zoes_[0], sheet_of(9), all_of("4")}};
  made.replays.erase(made.replays.begin());
  const auto opened = open_rating_round(*library_, made);
  for (const std::string& key : opened->keys) {
    const auto bench = find_rating_bench(*library_, rater_secret(key));
    for (const RatingTask& task : bench->tasks) {
      auto typed = all_of("2");
      typed["comment"] = "seen by " + key;
      ASSERT_TRUE(keep_rating(*library_, rater_secret(key), task.number, typed, true));
    }
  }
  ASSERT_EQ(count("rating_view"), 6);
  const std::size_t assets = assets_named(library_->database()).size();
  const auto erased = erase_person(*library_, "Zoe", std::nullopt);
  ASSERT_TRUE(erased.has_value());
  EXPECT_EQ(count("rating_view"), 3);
  EXPECT_EQ(count("rating_known"), 0);
  EXPECT_EQ(count("rating"), 6);
  EXPECT_EQ(count("response_set"), 6);
  EXPECT_EQ(count("response"), 6 * 7);
  EXPECT_EQ(assets_named(library_->database()).size(), assets - 3) << "the sheets; the picture is also Tim's";
  const auto left = list_ratings(*library_, opened->round.code);
  for (const SentRating& one : left->ratings)
    EXPECT_NE(std::find(tims_.begin(), tims_.end(), one.attempt_id), tims_.end());
  library_.reset();
  const CheckReport report = check_library(folder_, false, {}).value();
  EXPECT_TRUE(report.holds()) << report.findings.front().text;
}

TEST_F(RatingRoundsTest, WhoWithdrawsFromTheStudyIsRatedNoMore) {
  const std::string study = add_study(*library_, "Needles").value();
  ASSERT_TRUE(add_consent_text(*library_, study, "May your attempts be rated?"));
  const auto text_of = [&](const std::string& person) {
    for (const Consent& one : list_consents(*library_, person))
      if (one.study_id == study) return one.text_id;
    return std::string();
  };
  ASSERT_TRUE(give_consent(*library_, zoe_, text_of(zoe_)));
  ASSERT_TRUE(give_consent(*library_, tim_, text_of(tim_)));
  NewRatingRound made = six();
  made.round.study_id = study;
  const auto opened = open_rating_round(*library_, made);
  // A rating tells its replay by the sheet's number: Zoe's are even and get 2, Tim's odd and get 4 and 5.
  for (std::size_t r = 0; r < opened->keys.size(); ++r) {
    const std::string secret = rater_secret(opened->keys[r]);
    const auto bench = find_rating_bench(*library_, secret);
    for (const RatingTask& task : bench->tasks) {
      const int sheet = find_rating(*library_, secret, task.number)->sheet.at(16) - '0';
      ASSERT_TRUE(keep_rating(*library_, secret, task.number,
                              all_of(sheet % 2 == 0 ? "2"
                                     : sheet == 1   ? "5"
                                                    : "4"),
                              true));
    }
  }
  const auto rated = rated_people(*library_, study);
  ASSERT_EQ(rated.size(), 1U);
  EXPECT_EQ(rated[0].case_id, case_id_);
  EXPECT_EQ(rated[0].ratings, 12U);
  EXPECT_EQ(rated[0].scores.size(), 12U);
  EXPECT_EQ(rated[0].each, made.each);
  std::vector<double> means;
  for (const auto& [pseudonym, mean] : rated[0].mean) means.push_back(mean);
  std::sort(means.begin(), means.end());
  ASSERT_EQ(means.size(), 2U);
  EXPECT_DOUBLE_EQ(means[0], 2.0);
  EXPECT_DOUBLE_EQ(means[1], (5.0 + 4.0 + 4.0) / 3.0);
  ASSERT_TRUE(withdraw_consent(*library_, zoe_, text_of(zoe_)));
  EXPECT_EQ(rated_people(*library_, study)[0].mean.size(), 1U);
  std::size_t tasks = 0;
  for (const std::string& key : opened->keys)
    tasks += find_rating_bench(*library_, rater_secret(key))->tasks.size();
  EXPECT_EQ(tasks, 6U);
  EXPECT_EQ(list_ratings(*library_, opened->round.code)->asked, 6U);
}

}  // namespace
}  // namespace seldinger::casedb
