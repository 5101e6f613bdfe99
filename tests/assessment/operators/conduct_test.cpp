// Tests of assessment/operators/conduct: the steps around the puncture.
#include "assessment/operators/conduct.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace seldinger::assessment {
namespace {

using cases::EventKind;
using Part = Conduct::Part;

std::vector<EventKind> all_of(Conduct& conduct, std::initializer_list<Part> parts) {
  std::vector<EventKind> said;
  for (const Part part : parts) {
    conduct.begin(part);
    for (int tick = 0; tick < 100'000 && !conduct.over(); ++tick)
      if (const EventKind kind = conduct.advance(0.001); kind != EventKind::none) said.push_back(kind);
    EXPECT_TRUE(conduct.over());
    if (conduct.deferred()) break;
  }
  return said;
}

TEST(Conduct, TheExpertDoesEveryStepInOrder) {
  const std::vector<EventKind> under_probe = {
      EventKind::sign_in,       EventKind::proceed,     EventKind::probe_checked, EventKind::note_plan,
      EventKind::aspirate,      EventKind::anaesthetic, EventKind::nick,          EventKind::breath_hold_request,
      EventKind::breathe_again, EventKind::sign_out};
  for (const bool with_probe : {true, false}) {
    std::vector<EventKind> wanted = under_probe;
    if (!with_probe) std::erase(wanted, EventKind::probe_checked);
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      Conduct conduct(*named_profile("expert"), {1.1, 190.0}, with_probe, seed);
      EXPECT_EQ(all_of(conduct, {Part::sign_in, Part::prepare, Part::hold_breath, Part::finish}), wanted);
    }
  }
}

TEST(Conduct, AroundAPhantomThereIsNobodyToSpeakTo) {
  for (const char* who : {"expert", "novice"})
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      Conduct conduct(*named_profile(who), {{}, {}, cases::Subject::phantom}, true, seed);
      for (const EventKind kind :
           all_of(conduct, {Part::sign_in, Part::prepare, Part::hold_breath, Part::ask_breath, Part::finish}))
        EXPECT_TRUE(kind == EventKind::probe_checked || kind == EventKind::note_plan) << static_cast<int>(kind);
      EXPECT_FALSE(conduct.deferred());
    }
}

TEST(Conduct, EachStepTakesItsTimeAndAHeldBreathMore) {
  Skills skills = *named_profile("expert");
  skills.step_s = 0.5;
  Conduct conduct(skills, {}, true, 1);
  const auto seconds = [&](Part part) {
    conduct.begin(part);
    int ticks = 0;
    for (; !conduct.over(); ++ticks) conduct.advance(0.001);
    return ticks * 0.001;
  };
  EXPECT_NEAR(seconds(Part::sign_in), 1.0, 0.01);
  EXPECT_NEAR(seconds(Part::prepare), 2.5, 0.01);
  EXPECT_NEAR(seconds(Part::hold_breath), 2.0, 0.01);
}

TEST(Conduct, TheThresholdsAreThoseOfTheGuideline) {
  EXPECT_FALSE(forbids({}));
  EXPECT_FALSE(forbids({1.8, 50.0}));
  EXPECT_TRUE(forbids({1.81, 200.0}));
  EXPECT_TRUE(forbids({1.0, 49.9}));
  EXPECT_TRUE(forbids({2.4, 38.0}));
}

TEST(Conduct, TheExpertDefersAndANoviceMissesItAsOftenAsPlanted) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Conduct conduct(*named_profile("expert"), {2.4, 38.0}, true, seed);
    EXPECT_EQ(all_of(conduct, {Part::sign_in, Part::finish}), (std::vector{EventKind::sign_in, EventKind::defer}));
    EXPECT_TRUE(conduct.deferred());
  }
  const OperatorProfile novice = *named_profile("novice");
  constexpr int kTries = 2000;
  int deferred = 0;
  for (std::uint64_t seed = 0; seed < kTries; ++seed) {
    Conduct conduct(novice, {2.4, 38.0}, true, seed);
    all_of(conduct, {Part::sign_in});
    deferred += conduct.deferred() ? 1 : 0;
  }
  // Who looks and does not miss it. Five standard deviations of a binomial.
  const double share = (1.0 - novice.skip_step_share) * (1.0 - novice.misses_contraindication_share);
  EXPECT_NEAR(deferred / double{kTries}, share, 5.0 * std::sqrt(share * (1.0 - share) / kTries));
}

TEST(Conduct, StepsAreSkippedAsOftenAsPlanted) {
  Skills skills = *named_profile("expert");
  skills.skip_step_share = 0.3;
  constexpr int kTries = 2000;
  int said = 0;
  for (std::uint64_t seed = 0; seed < kTries; ++seed) {
    Conduct conduct(skills, {}, true, seed);
    said += static_cast<int>(all_of(conduct, {Part::prepare}).size());
  }
  EXPECT_NEAR(said / (5.0 * kTries), 0.7, 5.0 * std::sqrt(0.21 / (5.0 * kTries)));
}

TEST(Conduct, StopsForAMentorsEventOnly) {
  Conduct conduct(*named_profile("expert"), {}, true, 1);
  conduct.hear(EventKind::sign_in);
  conduct.hear(EventKind::pain_skin);
  conduct.hear(EventKind::none);
  EXPECT_FALSE(conduct.stopped());
  conduct.hear(EventKind::cough);
  EXPECT_TRUE(conduct.stopped());
  for (int tick = 0; tick < 4000; ++tick) conduct.advance(0.001);
  EXPECT_TRUE(conduct.stopped());
  for (int tick = 0; tick < 2000; ++tick) conduct.advance(0.001);
  EXPECT_FALSE(conduct.stopped());
}

}  // namespace
}  // namespace seldinger::assessment
