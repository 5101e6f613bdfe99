// A plan is read whole or refused with everything that is wrong, and has one text whatever it was written like.
#include "assessment/study/plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "tests/assessment/study/sample_plan.h"

namespace seldinger::assessment::study {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string problems_in(const std::string& json) {
  const auto plan = plan_from_json(json);
  std::string all;
  if (!plan)
    for (const base::Problem& one : plan.error().findings) all += one.text + "\n";
  else
    for (const base::Problem& one : problems_of(*plan)) all += one.text + "\n";
  return all;
}

std::string with(const std::string& from, const std::string& to) {
  std::string json = sample_plan_json();
  const std::size_t at = json.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return json.replace(at, from.size(), to);
}

TEST(Plan, IsReadAsItIsWritten) {
  EXPECT_EQ(problems_in(sample_plan_json()), "");
  const Plan plan = sample_plan();
  ASSERT_EQ(plan.groups.size(), 2U);
  EXPECT_FALSE(plan.randomised);
  EXPECT_EQ(plan.groups[1].facts[0].comparison, Comparison::at_least);
  EXPECT_EQ(plan.visits[0].to_day, 10.5);
  EXPECT_EQ(plan.primary[0].test, study::Test::brunner_munzel);
  EXPECT_EQ(plan.per_group, 3);
  EXPECT_EQ(plan.alpha, 0.05);
  EXPECT_EQ(plan.people, People::real);
}

TEST(Plan, WordsOfTheTemplateAreFoundWhereverTheyStand) {
  EXPECT_TRUE(unanswered_in(sample_plan()).empty());
  const auto places = [](const std::string& from, const std::string& to) {
    std::string all;
    for (const base::Problem& one : unanswered_in(plan_from_json(with(from, to)).value())) all += one.text + "\n";
    return all;
  };
  for (const auto& [field, place] : {std::pair{"\"title\": \"", "title "},
                                     {"\"intended_use\": \"", "intended_use "},
                                     {"\"decision\": \"", "decision "},
                                     {"\"claim\": \"", "argument[0].claim "},
                                     {"\"evidence\": \"", "argument[0].evidence "},
                                     {"\"rebuttals\": [\"", "argument[0].rebuttals[0] "},
                                     {"\"rule\": \"", "stopping.rule "},
                                     {"\"why\": \"", "missing.why "}})
    EXPECT_EQ(places(field, std::string(field) + "REPLACE: ").rfind(place, 0), 0U) << place;
}

TEST(Plan, ItsCanonicalTextIsOneAndReadsBack) {
  const std::string canonical = canonical_json(sample_plan());
  EXPECT_EQ(canonical_json(plan_from_json(canonical).value()), canonical);
  EXPECT_EQ(canonical_json(
                plan_from_json(with("\"smallest_worthwhile\": 2}", "\"smallest_worthwhile\": 2.0e0}")).value()),
            canonical);
  EXPECT_EQ(canonical_json(plan_from_json(with("{\"title\": \"t\", \"intended_use\": \"u\"",
                                               "{\"alpha\": 0.05,\n \"intended_use\": \"u\", \"title\": \"t\""))
                               .value()),
            canonical)
      << "order, blanks and what is left out as it would be anyway";
  EXPECT_NE(canonical_json(plan_from_json(with("\"to_day\": 10.5", "\"to_day\": 10.6")).value()), canonical);
  EXPECT_THAT(canonical, HasSubstr("\"to_day\":10.5}"));
  EXPECT_THAT(canonical, HasSubstr("\"from_day\":-10,"));
  const std::string arms = canonical_json(sample_plan("", kArms));
  EXPECT_EQ(canonical_json(plan_from_json(arms).value()), arms);
}

TEST(Plan, EverythingThatIsWrongIsSaid) {
  const std::map<std::string, std::pair<std::string, std::string>> kWrong = {
      {"primary[0].metric is not a metric", {"tip_target_dist", "tip_dist"}},
      {"primary[0].version is not the one", {"\"version\": " + version_of("tip_target_dist"), "\"version\": 999"}},
      {"primary[0].better contradicts", {"\"better\": \"lower\"", "\"better\": \"higher\""}},
      {"primary[0].failure_value is missing", {"\"brunner_munzel\"", "\"welch\""}},
      {"primary[0].failure_value does not belong",
       {"\"smallest_worthwhile\": 2}", "\"smallest_worthwhile\": 2, \"failure_value\": 9}"}},
      {"primary[0].compare[1] is not a group", {"\"few\", \"many\"]", "\"few\", \"some\"]"}},
      {"primary[0].compare names one group twice", {"\"few\", \"many\"]", "\"few\", \"few\"]"}},
      {"primary[0].visit is not a visit", {"\"visit\": \"v\"", "\"visit\": \"w\""}},
      {"primary[0].test must be one of: welch, brunner_munzel, mann_whitney",
       {"\"brunner_munzel\"", "\"student\""}},
      {"primary[0].smallest_worthwhile must be a number",
       {"\"smallest_worthwhile\": 2}", "\"smallest_worthwhile\": 0}"}},
      {"give two outcomes the same name", {"\"no-go\"", "\"distance\""}},
      {"visits[0].to_day is not after", {"\"to_day\": 10.5", "\"to_day\": -10"}},
      {"four inferences", {"\"generalisation\"", "\"scoring\""}},
      {"argument[1].rebuttals are missing",
       {"\"generalisation\", \"claim\": \"c\", \"rebuttals\": [\"r\"]", "\"generalisation\", \"claim\": \"c\""}},
      {"groups[1].name is also another group's", {"\"name\": \"many\"", "\"name\": \"few\""}},
      {"groups[0].name holds a colon", {"\"name\": \"few\"", "\"name\": \"f:w\""}},
      {"groups[0].facts[0].comparison must be one of", {"\"<=\"", "\"<\""}},
      {"stopping.per_group must be a number", {"\"per_group\": 3", "\"per_group\": 1"}},
      {"missing.absent must be one of: left_out, failure", {"\"left_out\"", "\"ignored\""}},
      {"missing.imputations are fewer than 10", {"\"why\": \"w\"", "\"why\": \"w\", \"imputations\": 9"}},
      {"missing.imputations do not belong here: absent",
       {"\"left_out\", \"why\": \"w\"", "\"failure\", \"why\": \"w\", \"imputations\": 20"}},
      {"impute_from does not belong", {"\"welch\"", "\"welch\", \"impute_from\": \"distance\""}},
      {"impute_from must name another", {"\"welch\"", "\"welch\", \"impute_from\": \"no-go\""}},
      {"holds 1 fields that the plan does not know", {"\"decision\": \"d\"", "\"decision\": \"d\", \"p\": 1"}},
      {"decision must be text", {"\"decision\": \"d\"", "\"decision\": \"  \""}},
      {"names a field twice", {"\"decision\": \"d\"", "\"decision\": \"d\", \"decision\": \"e\""}},
  };
  for (const auto& [said, change] : kWrong)
    EXPECT_THAT(problems_in(with(change.first, change.second)), HasSubstr(said));
  std::string of_order = with("\"welch\"", "\"mann_whitney\"");
  of_order.replace(of_order.find("\"why\": \"w\""), 10, "\"why\": \"w\", \"imputations\": 20");
  EXPECT_THAT(problems_in(of_order), HasSubstr("missing.imputations do not belong here: no primary"));
  for (const char* text : {"", "[]", "7", "{", "{\"title\": \"\xff\"}", "null"})
    EXPECT_EQ(plan_from_json(text).error().code, "bad_study_plan") << text;
  EXPECT_GE(plan_from_json("{}").error().findings.size(), 8U) << "all at once";
}

// At a case of an older law of sight what is told by sight is measured by an older version.
TEST(Plan, VersionsAreThoseOfTheCasesLawOfSight) {
  const int newest = find_metric("vis_joint")->version;
  const auto of_version = [&](int version) {
    Plan plan = sample_plan();
    plan.primary[0].metric = "vis_joint";
    plan.primary[0].version = version;
    plan.primary[0].better = find_metric("vis_joint")->direction;
    return plan;
  };
  const auto is_refused = [](const Plan& plan, cases::SightLaw law) {
    const auto problems = problems_of(plan, {{plan.primary[0].case_id, law}});
    return std::any_of(problems.begin(), problems.end(), [](const base::Problem& one) {
      return one.text.find("primary[0].version is not the one that is measured now at that case") == 0;
    });
  };
  EXPECT_FALSE(is_refused(of_version(newest), cases::SightLaw::tilt));
  EXPECT_TRUE(is_refused(of_version(newest), cases::SightLaw::material));
  EXPECT_FALSE(is_refused(of_version(newest - 1), cases::SightLaw::material));
  EXPECT_TRUE(is_refused(of_version(newest - 1), cases::SightLaw::clutter));
  EXPECT_FALSE(is_refused(of_version(newest - 2), cases::SightLaw::clutter));
  EXPECT_TRUE(is_refused(of_version(newest - 2), cases::SightLaw::scatter));
  EXPECT_FALSE(is_refused(of_version(newest - 3), cases::SightLaw::scatter));
  EXPECT_TRUE(is_refused(of_version(newest - 3), cases::SightLaw::echo));
  EXPECT_FALSE(is_refused(of_version(newest - 4), cases::SightLaw::echo));
  EXPECT_FALSE(is_refused(of_version(newest - 5), cases::SightLaw::half_slice));
}

// What is not asked for is not in the canonical text: plans of before keep their hash.
TEST(Plan, ImputationStandsInItsTextWhereItIsAskedFor) {
  EXPECT_THAT(canonical_json(sample_plan()), Not(HasSubstr("imput")));
  std::string json = with("\"why\": \"w\"", "\"why\": \"w\", \"imputations\": 50");
  json.replace(json.find("\"welch\""), 7, "\"welch\", \"impute_from\": \"distance\"");
  const Plan plan = plan_from_json(json).value();
  EXPECT_EQ(plan.imputations, 50);
  EXPECT_EQ(plan.primary[1].impute_from, "distance");
  EXPECT_EQ(canonical_json(plan_from_json(canonical_json(plan)).value()), canonical_json(plan));
}

TEST(Plan, ArmsNeedASequenceAndGroupsHaveNone) {
  EXPECT_EQ(problems_in(sample_plan_json("", kArms)), "");
  EXPECT_THAT(problems_in(sample_plan_json("", R"("arms": [{"name": "few"}, {"name": "many"}])")),
              HasSubstr("randomisation is missing"));
  EXPECT_THAT(problems_in(sample_plan_json(R"(, "randomisation": {"strata": [], "block_sizes": [2]})")),
              HasSubstr("does not belong"));
  EXPECT_THAT(problems_in(sample_plan_json("", R"("arms": [{"name": "few"}, {"name": "many"}],
      "randomisation": {"strata": [], "block_sizes": [3]})")),
              HasSubstr("block_sizes[0] must be a multiple"));
}

TEST(Plan, AttemptsAreLeftOutByTheirRecordingAlone) {
  const std::string by_outcome =
      R"(, "exclusions": [{"metric": "tip_target_dist", "comparison": ">=", "value": 9, "why": "w"}])";
  EXPECT_THAT(problems_in(sample_plan_json(by_outcome)),
              HasSubstr("exclusions[0].metric is not a metric of the recording"));
}

TEST(Plan, AFactFitsAsANumberOrAsAWord) {
  EXPECT_TRUE(fits({"f", Comparison::at_most, "1"}, "1"));
  EXPECT_TRUE(fits({"f", Comparison::at_most, "10"}, "9")) << "not as text";
  EXPECT_FALSE(fits({"f", Comparison::at_least, "5"}, "4.99"));
  EXPECT_TRUE(fits({"f", Comparison::equal, "2"}, "2.0"));
  EXPECT_TRUE(fits({"f", Comparison::equal, "left"}, "left"));
  EXPECT_FALSE(fits({"f", Comparison::equal, "left"}, "right"));
  EXPECT_FALSE(fits({"f", Comparison::at_most, "5"}, "left"));
}

}  // namespace
}  // namespace seldinger::assessment::study
