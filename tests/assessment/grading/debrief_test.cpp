// The three sentences: which, in which order, in which words.
#include "assessment/grading/debrief.h"

#include <gtest/gtest.h>

#include <set>

#include "assessment/grading/phrases.h"
#include "assessment/grading/plain_words.h"
#include "assessment/registry.h"
#include "tests/assessment/grading/graded_samples.h"

namespace seldinger::assessment {
namespace {

std::vector<std::string> texts(const std::vector<Sentence>& sentences) {
  std::vector<std::string> all;
  for (const Sentence& one : sentences) all.push_back(one.text);
  return all;
}

struct Attempt {
  std::vector<MetricValue> metrics = good_quality();
  Attempt& with(const char* id, std::optional<double> value, const char* reason = "") {
    const MetricInfo* info = find_metric(id);
    metrics.push_back({id, info->version, value, info->unit, reason});
    return *this;
  }
  std::vector<Sentence> debriefed(const PassRule& rule, const ExpertSet& experts = {}) const {
    const Gradable gradable{metrics, "", {}};
    return debrief(grade(rule, gradable), gradable, experts);
  }
};

ExpertSet experts(std::vector<MetricBand> bands) {
  ExpertSet set;
  set.id = "x";
  set.standard_id = "s";
  set.people = 8;
  set.bands = std::move(bands);
  return set;
}
MetricBand band(const char* id, double low, double high) {
  const MetricInfo* info = find_metric(id);
  return {id, info->unit, info->version, 8, low, high, (low + high) / 2.0, 1.0};
}

TEST(DebriefTest, SaysItAsTheIssueDoes) {
  const auto said = Attempt().with("blind_advance", 14.2).debriefed({}, experts({band("blind_advance", 0.0, 3.0)}));
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(said[0].text, "Advanced 14 mm with the tip out of the picture; 8 consultants: 0–3 mm.");
  EXPECT_EQ(said[0].kind, SentenceKind::shortfall);
}

TEST(DebriefTest, TellsNoNumberThatIsNoStandards) {
  // Before: "; simulated expert, not a standard: 0–3 mm", and "experts so far" of five consultants.
  ExpertSet set = experts({band("blind_advance", 0.0, 3.0)});
  set.standard_id.clear();
  const auto said = Attempt().with("blind_advance", 14.2).debriefed({}, set);
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(said[0].text, "Advanced 14 mm with the tip out of the picture.");
  EXPECT_EQ(said[0].kind, SentenceKind::fact);
  EXPECT_EQ(Attempt().with("blind_advance", 14.2).debriefed(rule_of({"blind_advance <= 5"}, {}), set)[0].text,
            "Advanced 14 mm with the tip out of the picture; to pass: at most 5 mm.");
}

TEST(DebriefTest, SaysThatVersionsAreNotComparable) {
  Attempt attempt;
  attempt.with("blind_advance", 1.0).with("hit", 1.0);
  attempt.metrics[3].version += 1;
  const auto said = attempt.debriefed(rule_of({"hit >= 1", "blind_advance <= 5"}, {}));
  ASSERT_EQ(said.size(), 1U);
  EXPECT_NE(said[0].text.find("another version of the metric"), std::string::npos) << said[0].text;
  attempt.metrics[4].value = 0.0;  // missed: it fails whatever the other would be
  EXPECT_EQ(texts(attempt.debriefed(rule_of({"hit >= 1", "blind_advance <= 5"}, {}))),
            (std::vector<std::string>{
                "Missed the target.",
                "“Blind advance” was measured by a version other than the rule's: not comparable."}));
}

TEST(DebriefTest, CriticalErrorsThenMissedCriteriaThenShortfallsThenWhatWentWell) {
  const PassRule rule = rule_of({"hit >= 1", "skin_punctures <= 1"}, {"nogo_length_critical <= 0"});
  Attempt attempt;
  attempt.with("hit", 1.0)
      .with("skin_punctures", 3.0)
      .with("nogo_length_critical", 3.25)
      .with("blind_advance", 14.0);
  const ExpertSet set = experts({band("blind_advance", 0.0, 3.0)});
  EXPECT_EQ(texts(attempt.debriefed(rule, set)),
            (std::vector<std::string>{
                "Went 3.2 mm through a structure that must never be touched; this alone fails the attempt.",
                "Punctured the skin 3 times; to pass: at most 1.",
                "Advanced 14 mm with the tip out of the picture; 8 consultants: 0–3 mm."}));
  attempt.metrics[5].value = 0.0;  // nothing critical
  EXPECT_EQ(texts(attempt.debriefed(rule, set)),
            (std::vector<std::string>{"Punctured the skin 3 times; to pass: at most 1.",
                                      "Advanced 14 mm with the tip out of the picture; 8 consultants: 0–3 mm.",
                                      "Kept out of every structure that must never be touched."}));
}

TEST(DebriefTest, MissedCriteriaComeBySeverity) {
  const auto said = Attempt()
                        .with("time_total", 400.0)
                        .with("tip_target_dist", 9.0)
                        .with("capsule_punctures", 2.0)
                        .with("advance_visible_share", 0.314)
                        .debriefed(rule_of({"time_total <= 60", "advance_visible_share >= 0.8",
                                            "tip_target_dist <= 3", "capsule_punctures <= 1"},
                                           {}));
  EXPECT_EQ(texts(said),
            (std::vector<std::string>{"Went through the organ's capsule twice; to pass: at most 1.",
                                      "Ended 9 mm from the target's centre; to pass: at most 3 mm.",
                                      "Had the tip in the picture for only 31 % of the advance; to pass: at least "
                                      "80 %."}));
}

TEST(DebriefTest, TheLargestShortfallComesFirstAndATrifleIsNotLargeBecauseExpertsDoNotDiffer) {
  const auto said = Attempt()
                        .with("vis_target", 0.94)
                        .with("probe_drift_advancing", 7.0)
                        .with("blind_advance", 6.0)
                        .debriefed({}, experts({band("vis_target", 1.0, 1.0), band("blind_advance", 0.0, 3.0),
                                                band("probe_drift_advancing", 0.0, 0.7)}));
  EXPECT_EQ(texts(said),
            (std::vector<std::string>{
                "Let the probe drift 7 mm while advancing; 8 consultants: 0–0.7 mm.",
                "Advanced 6 mm with the tip out of the picture; 8 consultants: 0–3 mm.",
                "Had the target in the picture for only 94 % of the time in tissue; 8 consultants: 100 %."}));
}

// At a case of an older law of sight the version of then is all there is; of several the newest is told.
TEST(DebriefTest, AFactIsTheNewestVersionThatIsStored) {
  Attempt attempt = Attempt().with("blind_advance", 14.2);
  ASSERT_GT(attempt.metrics.back().version, 1);
  MetricValue older = attempt.metrics.back();
  --older.version;
  older.value = 9.0;
  attempt.metrics.push_back(older);
  EXPECT_EQ(attempt.debriefed({})[0].text, "Advanced 14 mm with the tip out of the picture.");
  attempt.metrics = good_quality();
  attempt.metrics.push_back(older);
  EXPECT_EQ(attempt.debriefed({})[0].text, "Advanced 9 mm with the tip out of the picture.");
}

TEST(DebriefTest, TimeIsTheLastThatIsHeldAgainstSomebody) {
  const auto said = Attempt()
                        .with("time_total", 500.0)
                        .with("blind_advance", 5.0)
                        .debriefed({}, experts({band("time_total", 10.0, 20.0), band("blind_advance", 0.0, 3.0)}));
  EXPECT_EQ(texts(said),
            (std::vector<std::string>{"Advanced 5 mm with the tip out of the picture; 8 consultants: 0–3 mm.",
                                      "Took 500 s; 8 consultants: 10–20 s."}));
}

TEST(DebriefTest, ATrifleBesideTheBandIsNeitherShortfallNorPraise) {
  const ExpertSet set = experts({band("blind_advance", 0.0, 3.0)});
  EXPECT_EQ(Attempt().with("blind_advance", 3.7).debriefed({}, set)[0].kind, SentenceKind::fact);
  EXPECT_EQ(Attempt().with("blind_advance", 4.1).debriefed({}, set)[0].kind, SentenceKind::shortfall);
  const auto good = Attempt().with("blind_advance", 2.0).debriefed({}, set);
  EXPECT_EQ(good[0].text, "Advanced only 2 mm with the tip out of the picture; 8 consultants: 0–3 mm.");
  EXPECT_EQ(Attempt().with("blind_advance", 0.0).debriefed({}, set)[0].text,
            "Never advanced with the tip out of the picture.");
}

TEST(DebriefTest, NullIsSaidAndNeverPraised) {
  const PassRule rule =
      rule_of({"hit >= 1", "back_wall_dist >= 2", "skin_punctures <= 1"}, {"posterior_wall <= 0"});
  const auto said = Attempt()
                        .with("hit", std::nullopt, "no_endpoint")
                        .with("back_wall_dist", std::nullopt, "no_endpoint")
                        .with("skin_punctures", 1.0)
                        .with("posterior_wall", std::nullopt, "no_target_structure")
                        .debriefed(rule);
  ASSERT_EQ(said.size(), 3U);
  EXPECT_EQ(said[0].kind, SentenceKind::not_measured);
  EXPECT_EQ(said[0].text,
            "“Far wall punctures” has no value (no lumen to be reached is marked in this case), so it is not met.");
  EXPECT_EQ(said[1].text,
            "The needle was neither fired nor declared to be on target, so the endpoint cannot be judged.");
  EXPECT_EQ(said[2].text, "Punctured the skin only once.");
  for (const Sentence& one : said) EXPECT_NE(one.metric_id == "hit" && one.kind == SentenceKind::well, true);
}

TEST(DebriefTest, WhatNobodyDidIsNeitherPraisedNorHeldAgainstConsultants) {
  const PassRule rule = rule_of({"hit >= 1", "nogo_contacts <= 0"}, {});
  const ExpertSet set = experts({band("nogo_contacts", 0.0, 1.0), band("time_needle", 20.0, 40.0)});
  Attempt parked;
  parked.with("procedure_performed", 0.0)
      .with("skin_punctures", 0.0)
      .with("hit", std::nullopt, "no_endpoint")
      .with("nogo_contacts", 0.0)
      .with("time_needle", 0.0);
  const std::vector<std::string> said{
      "The needle was neither fired nor declared to be on target, so the endpoint cannot be judged."};
  // Before: and "Kept out of every structure to stay out of."
  EXPECT_EQ(texts(parked.debriefed(rule, set)), said);
  Attempt deferred = parked;
  deferred.metrics[3].value = 1.0;
  EXPECT_EQ(texts(deferred.debriefed(rule, set)), said);
  deferred.metrics[4].value = 1.0;  // punctured, and drawn out again
  EXPECT_EQ(deferred.debriefed(rule, set).size(), 3U);
}

TEST(DebriefTest, NoneIsOfWhatIsNeverBelowZero) {
  // Before: "; to pass: none."
  EXPECT_EQ(texts(Attempt().with("tip_target_surface", 3.0).debriefed(rule_of({"tip_target_surface <= 0"}, {}))),
            std::vector<std::string>{"Ended 3 mm outside the target; to pass: at most 0 mm."});
  EXPECT_EQ(texts(Attempt().with("nogo_length", 3.0).debriefed(rule_of({"nogo_length <= 0"}, {}))),
            std::vector<std::string>{"Went 3 mm through structures to stay out of; to pass: none."});
}

TEST(DebriefTest, OneIsNoPlural) {
  const Phrase& views = *find_phrase("views");
  EXPECT_EQ(said(views, 1.0, "1", false), "Looked from only 1 direction");
  EXPECT_EQ(said(views, 3.0, "3", true), "Looked from 3 directions");  // before: "directions to the number of 3"
}

TEST(DebriefTest, ThreeOfOneTopicOnlyWhereNothingElseIsThere) {
  const PassRule rule = rule_of(
      {"advance_visible_share >= 0.8", "blind_advance_max <= 5", "blind_advance <= 8", "skin_punctures <= 1"}, {});
  Attempt attempt;
  attempt.with("advance_visible_share", 0.5).with("blind_advance_max", 9.0).with("blind_advance", 20.0);
  EXPECT_EQ(attempt.debriefed(rule).size(), 3U);
  std::set<std::string> kinds;
  attempt.with("skin_punctures", 1.0);
  for (const Sentence& one : attempt.debriefed(rule)) kinds.insert(std::string(name_of(one.kind)));
  EXPECT_TRUE(kinds.contains("well")) << "one topic does not take all three";
}

TEST(DebriefTest, NothingOfATopicIsPraisedBesideWhatWentWrongInIt) {
  // Both are of the target; one was missed.
  const auto said = Attempt()
                        .with("tip_target_axial", 9.0)
                        .debriefed(rule_of({"tip_target_axial <= 3", "tip_target_axial >= -3"}, {}));
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(said[0].text, "Stopped 9 mm short of the target's centre; to pass: at most 3 mm.");
  EXPECT_EQ(Attempt()
                .with("tip_target_axial", -9.0)
                .debriefed(rule_of({"tip_target_axial <= 3", "tip_target_axial >= -3"}, {}))[0]
                .text,
            "Went 9 mm beyond the target's centre; to pass: at least −3 mm.");
}

TEST(DebriefTest, WithoutRuleOrExpertsStatesFacts) {
  const auto said = Attempt().with("hit", 0.0).with("blind_advance", 4.0).with("time_total", 31.4).debriefed({});
  EXPECT_EQ(texts(said),
            (std::vector<std::string>{"Missed the target.", "Advanced 4 mm with the tip out of the picture.",
                                      "Took 31 s."}));
}

TEST(DebriefTest, OfWhatIsNotGradableOnlySaysWhy) {
  Attempt attempt;
  attempt.with("hit", 1.0).metrics[0].value = 0.2;
  for (const PassRule& rule : {rule_of({"hit >= 1"}, {}), PassRule{}}) {
    const auto said = attempt.debriefed(rule);
    ASSERT_EQ(said.size(), 1U);
    EXPECT_EQ(said[0].text, "This attempt is not graded: tracking was lost for more than 5 % of the time.");
  }
  EXPECT_EQ(not_gradable_text("interrupted"),
            "This attempt is not graded: the program ended before the attempt did.");
}

TEST(DebriefTest, NumbersThatDifferReadDifferently) {
  const auto said = Attempt().with("blind_advance_max", 5.04).debriefed(rule_of({"blind_advance_max <= 5"}, {}));
  EXPECT_EQ(said[0].text, "Advanced 5.04 mm in one go with the tip out of the picture; to pass: at most 5 mm.");
}

TEST(PhraseTest, EveryMetricHasASentenceForGoodAndForBad) {
  std::set<std::string_view> ids;
  for (const Phrase& phrase : phrases()) {
    EXPECT_NE(find_metric(std::string(phrase.id)), nullptr) << phrase.id;
    EXPECT_TRUE(ids.insert(phrase.id).second) << phrase.id << " is there twice";
  }
  for (const MetricInfo& info : registry()) {
    const Phrase* phrase = find_phrase(info.id);
    ASSERT_NE(phrase, nullptr) << info.id;
    EXPECT_FALSE(phrase->topic.empty()) << info.id;
    for (const bool good : {false, true})
      for (const double value : {-2.0, 0.0, 1.0, 12.0}) {
        const std::string text = said(*phrase, value, "12 mm", good);
        EXPECT_FALSE(text.empty()) << info.id;
        EXPECT_EQ(text.find('{'), text.npos) << info.id;
        EXPECT_NE(text.back(), '.') << info.id;
        EXPECT_EQ(text.find(';'), text.npos) << info.id;
      }
    // A number is told, except of a yes or no.
    if (std::string_view(info.unit) != "bool") {
      EXPECT_NE(phrase->bad.find('{'), std::string_view::npos) << info.id;
      EXPECT_NE(phrase->good.find('{'), std::string_view::npos) << info.id;
    } else {
      EXPECT_FALSE(phrase->zero.empty()) << info.id;
      EXPECT_NE(phrase->zero, phrase->good) << info.id;
    }
  }
}

TEST(PlainWordsTest, ReadAsPeopleSayThem) {
  EXPECT_EQ(plain_value(14.2, "mm"), "14 mm");
  EXPECT_EQ(plain_value(2.55, "mm"), "2.5 mm");
  EXPECT_EQ(plain_value(3.0, "mm"), "3 mm");
  EXPECT_EQ(plain_value(-1.25, "mm"), "−1.2 mm");
  EXPECT_EQ(plain_value(-0.01, "mm"), "0 mm");
  EXPECT_EQ(plain_value(0.8, "share"), "80 %");
  EXPECT_EQ(plain_value(7.5, "1/s"), "7.5 a second");
  EXPECT_EQ(plain_value(12.0, "deg"), "12°");
  EXPECT_EQ(plain_range(0.0, 3.0, "mm"), "0–3 mm");
  EXPECT_EQ(plain_range(-2.0, 3.0, "mm"), "−2 to 3 mm");
  EXPECT_EQ(plain_range(1.0, 1.0, "count"), "1");
  EXPECT_EQ(plain_range(9.96, 31.2, "s"), "10–31 s");
  EXPECT_EQ(said_range(9.96, 31.2, "s"), std::pair(10.0, 31.0));
  EXPECT_EQ(said_range(-2.04, 0.26, "mm"), std::pair(-2.0, 0.3));
  EXPECT_EQ(said_range(0.123, 0.987, "share"), std::pair(0.12, 0.99));
  EXPECT_EQ(plain_apart(5.0, 5.0, "mm").first, "5 mm");
  EXPECT_EQ(plain_apart(0.7996, 0.8, "share"), (std::pair<std::string, std::string>{"79.96 %", "80 %"}));
  EXPECT_EQ(plain_times(1.0), "once");
  EXPECT_EQ(plain_times(4.0), "4 times");
}

}  // namespace
}  // namespace seldinger::assessment
