// Tests of assessment/operators/profile: the table, JSON, people, learning.
#include "assessment/operators/profile.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <sstream>

namespace seldinger::assessment {
namespace {

TEST(SkillTable, HoldsItsOwnRangesAndEveryGroup) {
  std::set<std::string> names;
  for (const SkillField& field : skill_fields()) {
    EXPECT_TRUE(names.insert(field.name).second) << field.name;
    for (const double value : {field.novice, field.intermediate, field.expert}) {
      EXPECT_GE(value, field.min) << field.name;
      EXPECT_LE(value, field.max) << field.name;
    }
    // The intermediate is between the two, or as one of them.
    EXPECT_LE((field.intermediate - field.novice) * (field.intermediate - field.expert), 0.0) << field.name;
  }
  for (const char* name : {"novice", "intermediate", "expert", "learner"})
    EXPECT_TRUE(named_profile(name).has_value()) << name;
  EXPECT_FALSE(named_profile("surgeon").has_value());
  EXPECT_FALSE(named_profile("person").has_value());
}

TEST(ProfileJson, ReadsEveryField) {
  for (const SkillField& field : skill_fields()) {
    for (const double value : {field.min, field.max}) {
      std::ostringstream json;
      json << "{\"" << field.name << "\": " << value << "}";
      const auto profile = profile_from_json(json.str());
      ASSERT_TRUE(profile.has_value()) << json.str();
      EXPECT_EQ((*profile).*field.value, value) << field.name;
      EXPECT_EQ(profile->name, "custom");
      // The others are the expert's.
      for (const SkillField& other : skill_fields()) {
        EXPECT_TRUE(&other == &field || (*profile).*other.value == other.expert) << other.name;
      }
    }
    for (const double value : {field.min - 0.01, field.max + 0.01}) {
      std::ostringstream json;
      json << "{\"" << field.name << "\": " << value << "}";
      EXPECT_EQ(profile_from_json(json.str()).error().code, "bad_operator") << json.str();
    }
  }
}

TEST(ProfileJson, ReadsLearnersAndRefusesTheRest) {
  const auto learner = profile_from_json(
      R"({"name": "slow", "like": "novice", "learning_rate": 0.5, "learning_law": "power", "attempts_before": 2,
          "learns_towards": "intermediate", "person_spread": 0.1})");
  ASSERT_TRUE(learner.has_value());
  EXPECT_EQ(learner->name, "slow");
  EXPECT_EQ(learner->tremor_mm, named_profile("novice")->tremor_mm);
  EXPECT_EQ(learner->learning.towards.tremor_mm, named_profile("intermediate")->tremor_mm);
  EXPECT_EQ(learner->learning.law, LearningLaw::power);
  EXPECT_EQ(learner->person_spread, 0.1);
  for (const char* bad : {"", "[]", "{", R"({"tremor_mm": "x"})", R"({"tremor_mm": -1})", R"({"hands": 2})",
                          R"({"like": "surgeon"})", R"({"learning_law": "sudden"})", R"({"learning_rate": -1})",
                          R"({"person_spread": 9})", R"({"name": 3})", R"({"name": ""})"})
    EXPECT_EQ(profile_from_json(bad).error().code, "bad_operator") << bad;
}

TEST(ProfileJson, NobodySimulatedIsCalledAPerson) {
  EXPECT_EQ(profile_from_json(R"({"name": "person"})").error().code, "bad_operator");
}

TEST(Learning, FollowsItsLaw) {
  OperatorProfile profile = *named_profile("learner");
  profile.learning.rate = 0.3;
  const double novice = named_profile("novice")->tremor_mm, expert = named_profile("expert")->tremor_mm;
  for (const LearningLaw law : {LearningLaw::exponential, LearningLaw::power})
    for (const double before : {0.0, 4.0})
      for (const std::uint64_t n : {0U, 1U, 7U, 200U}) {
        profile.learning.law = law;
        profile.learning.before = before;
        const double all = before + static_cast<double>(n);
        const double left = law == LearningLaw::exponential ? std::exp(-0.3 * all) : std::pow(1.0 + all, -0.3);
        EXPECT_NEAR(at_attempt(profile, n).tremor_mm, expert + (novice - expert) * left, 1e-12);
      }
  profile.learning.rate = 0.0;
  EXPECT_EQ(at_attempt(profile, 50).tremor_mm, novice) << "who learns nothing stays";
}

TEST(People, DifferAboutTheirProfileAndAreTheSameForTheSameSeed) {
  const OperatorProfile expert = *named_profile("expert");
  EXPECT_EQ(person_of(expert, 5).tremor_mm, person_of(expert, 5).tremor_mm);
  EXPECT_NE(person_of(expert, 5).tremor_mm, person_of(expert, 6).tremor_mm);
  constexpr int kPeople = 4000;
  for (const SkillField& field : skill_fields()) {
    double sum = 0.0, sum2 = 0.0;
    bool clamped = field.expert <= 0.0;
    for (std::uint64_t seed = 0; seed < kPeople; ++seed) {
      const double value = person_of(expert, seed).*field.value;
      ASSERT_GE(value, field.min) << field.name;
      ASSERT_LE(value, field.max) << field.name;
      ASSERT_TRUE(field.personal || value == field.expert) << field.name;
      clamped = clamped || value == field.min || value == field.max;
      const double z = clamped ? 0.0 : std::log(value / field.expert) / expert.person_spread;
      sum += z;
      sum2 += z * z;
    }
    if (clamped || !field.personal) continue;
    // Standard errors of mean and variance of a normal: 1/√n and √(2/n); five of them.
    EXPECT_NEAR(sum / kPeople, 0.0, 5.0 / std::sqrt(kPeople)) << field.name;
    EXPECT_NEAR(sum2 / kPeople, 1.0, 5.0 * std::sqrt(2.0 / kPeople)) << field.name;
  }
}

TEST(People, LearnTowardsTheirOwnBest) {
  const OperatorProfile learner = *named_profile("learner");
  const OperatorProfile person = person_of(learner, 9);
  EXPECT_NEAR(person.tremor_mm / learner.tremor_mm,
              person.learning.towards.tremor_mm / learner.learning.towards.tremor_mm, 1e-9)
      << "steady as a novice, steady as an expert";
  EXPECT_NEAR(at_attempt(person, 10'000).tremor_mm, person.learning.towards.tremor_mm, 1e-12);
}

}  // namespace
}  // namespace seldinger::assessment
