// What comes out of OpenAL, rendered into memory (ALC_SOFT_loopback), and what happens where there is no device.
#include "app/window/sound/speaker.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <thread>

#include "app/window/sound/sound_waves.h"
#include "tests/fixtures/until.h"

namespace seldinger::app {
namespace {

constexpr int kTenthS = kSoundHz / 10;

float highest(const std::vector<float>& samples) {
  float most = 0.0F;
  for (const float value : samples) most = std::max(most, std::abs(value));
  return most;
}

Speaker::Settings in_memory() {
  Speaker::Settings settings;
  settings.output = Speaker::Output::memory;
  settings.volume = 1.0;
  return settings;
}

void play(Speaker& speaker, Sound sound, double loudness = 1.0) {
  const Sounding one[] = {{sound, loudness}};
  speaker.play(one);
}

TEST(Speaker, EverySoundIsHeardAsLoudAsItsLevelAndThenItIsStill) {
  for (const SoundInfo& info : sound_infos()) {
    Speaker speaker(in_memory());
    ASSERT_EQ(speaker.state(), Speaker::State::open);
    EXPECT_EQ(highest(speaker.render(kTenthS)), 0.0F);
    play(speaker, info.sound);
    const auto samples = static_cast<int>(wave_of(info.sound).size()) + kTenthS;
    EXPECT_NEAR(highest(speaker.render(samples)), info.level, 0.15 * info.level) << info.name;
    EXPECT_LT(highest(speaker.render(kTenthS)), 1e-3F) << info.name;
    EXPECT_EQ(speaker.take_played(), std::vector{info.sound});
    EXPECT_TRUE(speaker.take_played().empty());
  }
}

TEST(Speaker, VolumeAndLoudnessScaleAndMuteIsSilent) {
  Speaker speaker(in_memory());
  const auto heard = [&](double loudness) {
    play(speaker, Sound::bone, loudness);
    return highest(speaker.render(kSoundHz));
  };
  const float full = heard(1.0);
  EXPECT_NEAR(heard(0.5), 0.5F * full, 0.02F * full);
  speaker.set_volume(0.25);
  EXPECT_NEAR(heard(1.0), 0.25F * full, 0.02F * full);
  speaker.set_volume(7.0);
  EXPECT_EQ(speaker.volume(), 1.0);
  EXPECT_NEAR(heard(1.0), full, 0.02F * full);
  speaker.set_muted(true);
  EXPECT_EQ(heard(1.0), 0.0F);
  EXPECT_FALSE(speaker.take_played().empty()) << "told, though it is not heard";
  speaker.set_muted(false);
  EXPECT_NEAR(heard(1.0), full, 0.02F * full) << "and nothing of before";
}

TEST(Speaker, AnAlarmInTheMiddleOfOneIsCutOff) {
  Speaker speaker(in_memory());
  play(speaker, Sound::alarm_high);
  EXPECT_GT(highest(speaker.render(2 * kTenthS)), 0.1F);
  speaker.set_muted(true);
  speaker.render(kTenthS);  // OpenAL fades for some ms
  EXPECT_EQ(highest(speaker.render(2 * kTenthS)), 0.0F);
}

TEST(Speaker, APatientHasOneVoiceAndHandsHaveSeveral) {
  Speaker speaker(in_memory());
  play(speaker, Sound::groan);
  speaker.render(2 * kTenthS);
  play(speaker, Sound::breath_in);
  speaker.render(kTenthS / 2);
  EXPECT_LT(highest(speaker.render(kTenthS)), 0.1F) << "the groan is over";
  speaker.render(kSoundHz);
  play(speaker, Sound::shot);
  play(speaker, Sound::bone);
  play(speaker, Sound::ow);
  const float together = highest(speaker.render(kTenthS));
  EXPECT_GT(together, info_of(Sound::shot).level);
  EXPECT_LE(together, 1.0F);
}

TEST(Speaker, TheSameSoundTwiceInAMomentIsOne) {
  std::vector<float> wanted;
  {
    Speaker once(in_memory());
    play(once, Sound::touch);
    wanted = once.render(2 * kTenthS);
  }
  Speaker twice(in_memory());
  play(twice, Sound::touch);
  play(twice, Sound::touch);
  auto first = twice.render(kTenthS / 2);
  play(twice, Sound::touch);
  const auto rest = twice.render(2 * kTenthS - kTenthS / 2);
  first.insert(first.end(), rest.begin(), rest.end());
  EXPECT_EQ(first, wanted);
}

// No driver is allowed: as a workstation without a sound card.
TEST(Speaker, WithoutADeviceItIsSilentAndSaysSo) {
  Speaker::Settings settings;
  settings.muted = true;
  Speaker speaker(settings);
  fixtures::let_pass(0.02);  // nothing can be waited for: it must not ask
  EXPECT_EQ(speaker.state(), Speaker::State::unasked) << "who is muted asks for nothing";
  speaker.set_muted(false);
  fixtures::until([&] { return speaker.state() != Speaker::State::unasked; });
  EXPECT_EQ(speaker.state(), Speaker::State::none);
  play(speaker, Sound::ow);
  EXPECT_EQ(speaker.take_played().size(), 1U);
}

}  // namespace
}  // namespace seldinger::app
