// What is heard, and when: the table from what happens in the room to sounds.
#include "app/window/sound/sounds.h"

#include <gmock/gmock.h>

#include <set>

namespace seldinger::app {
namespace {

using cases::EventKind;
using cases::InstrumentKind;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr double kThenS = 4.0, kNowS = 4.05;

Seen at(double t_s) {
  Seen seen;
  seen.moment.state.t_s = t_s;
  return seen;
}

std::vector<Sound> heard(const Seen& before, const Seen& now, InstrumentKind kind = InstrumentKind::core) {
  std::vector<Sound> sounds;
  for (const Sounding& sounding : sounds_of(before, now, kind)) sounds.push_back(sounding.sound);
  return sounds;
}

TEST(Sounds, NothingIsHeardWhileNothingHappens) {
  EXPECT_THAT(heard(at(kThenS), at(kNowS)), IsEmpty());
  EXPECT_THAT(heard(Seen{}, at(kNowS)), IsEmpty()) << "an attempt that begins";
}

TEST(Sounds, AProbeIsHeardWhenItTouchesNotWhileItLiesThere) {
  Seen before = at(kThenS), now = at(kNowS);
  before.moment.force = cases::ForceSample{};
  now.moment.force = cases::ForceSample{};
  now.moment.force->probe_n = kHeardTouchN + 0.1;
  EXPECT_THAT(heard(before, now), ElementsAre(Sound::touch));
  before.moment.force->probe_n = kHeardTouchN + 2.0;
  EXPECT_THAT(heard(before, now), IsEmpty()) << "it lies there";
  EXPECT_THAT(heard(now, before), IsEmpty());
  now.moment.force->probe_n = kHeardTouchN - 0.1;
  EXPECT_THAT(heard(at(kThenS), now), IsEmpty()) << "too light";
}

TEST(Sounds, ANeedleIsHeardInSkinAndCapsulesAsHardAsTheyAre) {
  Seen before = at(kThenS), now = at(kNowS);
  now.moment.state.needle.skin.in_body = true;
  EXPECT_THAT(heard(before, now), ElementsAre(Sound::prick));
  before.moment.state.needle.skin.in_body = true;
  now.moment.capsules = 3;
  before.moment.capsules = 2;
  now.moment.capsule_n = 0.5 * kLoudCapsuleN;
  EXPECT_THAT(sounds_of(before, now, InstrumentKind::access), ElementsAre(Sounding{Sound::pop, 0.5}));
  now.moment.capsule_n = 10.0 * kLoudCapsuleN;
  EXPECT_THAT(sounds_of(before, now, InstrumentKind::access), ElementsAre(Sounding{Sound::pop, 1.0}));
  before.moment.capsules = 3;
  EXPECT_THAT(heard(before, now), IsEmpty());
}

TEST(Sounds, OnlyACoreNeedleHasASpring) {
  Seen now = at(kNowS);
  now.moment.state.fire.fired = true;
  EXPECT_THAT(heard(at(kThenS), now, InstrumentKind::core), ElementsAre(Sound::shot));
  EXPECT_THAT(heard(at(kThenS), now, InstrumentKind::access), IsEmpty());
  Seen before = now;
  before.moment.state.t_s = kThenS;
  EXPECT_THAT(heard(before, now), IsEmpty()) << "once";
}

TEST(Sounds, ThePatientIsHeardOnceForEachReaction) {
  const std::pair<EventKind, std::vector<Sound>> rows[] = {
      {EventKind::pain_skin, {Sound::ow}},
      {EventKind::pain_bone, {Sound::groan, Sound::bone}},
      {EventKind::breath_held, {Sound::breath_in}},
      {EventKind::breath_lost, {Sound::breath_out}},
  };
  for (const auto& [kind, sounds] : rows) {
    Seen now = at(kNowS);
    now.moment.reaction = kind;
    now.moment.reaction_t_s = 0.5 * (kThenS + kNowS);
    EXPECT_EQ(heard(at(kThenS), now), sounds);
    EXPECT_THAT(heard(now, at(kNowS + 0.05)), IsEmpty());
    now.moment.reaction_t_s = kThenS;
    EXPECT_THAT(heard(at(kThenS), now), IsEmpty()) << "that was before";
  }
}

// What comes back through the needle is seen, not heard.
TEST(Sounds, WhatAMentorLetsHappenIsHeardAndWhatTheTraineeSaysIsNot) {
  for (const cases::EventInfo& info : cases::event_kinds()) {
    Seen now = at(kNowS);
    now.moment.event = info.kind;
    now.moment.event_t_s = kNowS;
    const auto sounds = heard(at(kThenS), now);
    const bool returns = info.kind >= EventKind::urine_returns && info.kind <= EventKind::fluid_returns;
    if (info.source == cases::EventSource::trainee || info.source == cases::EventSource::workstation || returns)
      EXPECT_THAT(sounds, IsEmpty()) << info.name;
    else
      EXPECT_FALSE(sounds.empty()) << info.name;
    if (info.kind == EventKind::bleeding || info.kind == EventKind::pressure_drop) {
      EXPECT_THAT(sounds, ElementsAre(Sound::alarm_high));
    }
  }
}

TEST(Sounds, ALostArmAlarmsOnceAndOneThatWasNeverThereDoesNot) {
  Seen before = at(kThenS), now = at(kNowS);
  now.arms.used = true;  // not connected yet
  EXPECT_THAT(heard(before, now), IsEmpty());
  before.arms.used = true;
  before.arms.lost = {false, false};
  now.arms.lost = {true, true};
  EXPECT_THAT(heard(before, now), ElementsAre(Sound::alarm_medium));
  before.arms.lost = {true, true};
  EXPECT_THAT(heard(before, now), IsEmpty());
}

TEST(Sounds, EachFiveMinutesOfBeamAreSaid) {
  Seen before = at(kThenS), now = at(kNowS);
  before.moment.state.fluoroscopy.fluoroscopy_time_s = 299.9;
  now.moment.state.fluoroscopy.fluoroscopy_time_s = 300.1;
  EXPECT_THAT(heard(before, now), ElementsAre(Sound::beam_timer));
  before.moment.state.fluoroscopy.fluoroscopy_time_s = 300.05;
  EXPECT_THAT(heard(before, now), IsEmpty());
  now.moment.state.fluoroscopy.fluoroscopy_time_s = 600.0;
  EXPECT_THAT(heard(before, now), ElementsAre(Sound::beam_timer));
}

TEST(Sounds, AnAttemptThatBeganAgainIsSilent) {
  Seen now = at(0.1);
  now.moment.state.needle.skin.in_body = true;
  EXPECT_THAT(heard(at(kThenS), now), IsEmpty());
}

TEST(Sounds, TheTableIsInOrderAndNamesEachOnce) {
  std::set<std::string_view> names;
  double together = 0.0, highest[3] = {};
  for (int i = 0; i < kSounds; ++i) {
    const SoundInfo& info = sound_infos()[static_cast<std::size_t>(i)];
    EXPECT_EQ(static_cast<int>(info.sound), i);
    EXPECT_TRUE(names.insert(info.name).second) << info.name;
    double& most = highest[static_cast<int>(info.voice)];
    most = std::max(most, info.level);
  }
  for (const double most : highest) together += most;
  EXPECT_LE(together, 1.0) << "hand, patient and alarm at once are not clipped";
}

}  // namespace
}  // namespace seldinger::app
