// The sounds by what they are made of: pulses, tones, formants, rings.
#include "app/window/sound/sound_waves.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <span>

namespace seldinger::app {
namespace {

// Amplitude at one frequency (Goertzel's sum, as it stands).
double strength(std::span<const float> wave, double hz) {
  std::complex<double> sum = 0.0;
  for (std::size_t i = 0; i < wave.size(); ++i)
    sum += static_cast<double>(wave[i]) *
           std::polar(1.0, -2.0 * std::numbers::pi * hz * static_cast<double>(i) / kSoundHz);
  return 2.0 * std::abs(sum) / static_cast<double>(wave.size());
}

double loudness(std::span<const float> wave) {
  double sum = 0.0;
  for (const float value : wave) sum += static_cast<double>(value) * value;
  return wave.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(wave.size()));
}

std::span<const float> part(const std::vector<float>& wave, double begin_s, double length_s) {
  return std::span(wave).subspan(static_cast<std::size_t>(begin_s * kSoundHz),
                                 static_cast<std::size_t>(length_s * kSoundHz));
}

TEST(SoundWaves, EachBeginsAndEndsInSilenceAndIsTheSameAgain) {
  for (const SoundInfo& info : sound_infos()) {
    const std::vector<float> wave = wave_of(info.sound);
    ASSERT_GT(wave.size(), kSoundHz / 50) << info.name;
    EXPECT_LT(wave.size(), 4 * kSoundHz) << info.name;
    float highest = 0.0F;
    for (const float value : wave) highest = std::max(highest, std::abs(value));
    EXPECT_FLOAT_EQ(highest, 1.0F) << info.name;
    EXPECT_LT(std::abs(wave.front()), 0.01F) << info.name << ": no crack";
    EXPECT_LT(std::abs(wave.back()), 0.01F) << info.name << ": no crack";
    EXPECT_EQ(wave, wave_of(info.sound)) << info.name;
  }
}

// IEC 60601-1-8: lengths, gaps, tones and overtones of its pulses.
TEST(SoundWaves, AlarmsAreWhatTheStandardAsks) {
  for (const Sound alarm : {Sound::alarm_high, Sound::alarm_medium}) {
    const bool high = alarm == Sound::alarm_high;
    const std::vector<float> wave = wave_of(alarm);
    const std::vector<AlarmPulse> pulses = alarm_pulses(alarm);
    ASSERT_EQ(pulses.size(), high ? 10U : 3U);
    for (std::size_t i = 0; i < pulses.size(); ++i) {
      const AlarmPulse& pulse = pulses[i];
      EXPECT_GE(pulse.length_s, high ? 0.075 : 0.125);
      EXPECT_LE(pulse.length_s, high ? 0.200 : 0.250);
      EXPECT_GE(pulse.tone_hz, 150.0);
      EXPECT_LE(pulse.tone_hz, 1000.0);
      const auto sounding = part(wave, pulse.begin_s, pulse.length_s);
      const double fundamental = strength(sounding, pulse.tone_hz);
      int overtones = 0;
      for (int h = 2; h * pulse.tone_hz <= 4000.0; ++h) {
        const double db = 20.0 * std::log10(strength(sounding, h * pulse.tone_hz) / fundamental);
        if (h * pulse.tone_hz >= 300.0 && std::abs(db) <= 15.0) ++overtones;
      }
      EXPECT_GE(overtones, 4) << i;
      if (i + 1 == pulses.size()) continue;
      const double gap_s = pulses[i + 1].begin_s - pulse.begin_s - pulse.length_s;
      EXPECT_LT(loudness(part(wave, pulse.begin_s + pulse.length_s + 0.002, gap_s - 0.004)), 1e-3) << i;
      if (!high) {
        EXPECT_TRUE(gap_s >= 0.125 && gap_s <= 0.250) << gap_s;
      } else if (i == 4) {
        EXPECT_TRUE(gap_s >= 0.35 && gap_s <= 1.3) << gap_s;
      } else if (i % 5 == 2) {
        EXPECT_NEAR(gap_s, 2.0 * 0.10 + pulse.length_s, 1e-9);
      } else {
        EXPECT_TRUE(gap_s >= 0.05 && gap_s <= 0.125) << gap_s;
      }
    }
  }
}

TEST(SoundWaves, TheBeamsTimerIsHeardForTwoSecondsAtLeast) {
  const std::vector<float> wave = wave_of(Sound::beam_timer);
  for (double t_s = 0.05; t_s < 2.0; t_s += 0.1) EXPECT_GT(loudness(part(wave, t_s, 0.05)), 0.5) << t_s;
}

// A pitch that falls, and more of the voice below 1.4 kHz, where an open vowel's two formants are, than above.
TEST(SoundWaves, PainIsAVoice) {
  for (const Sound sound : {Sound::ow, Sound::groan}) {
    const std::vector<float> wave = wave_of(sound);
    const auto pitch_hz = [&](double begin_s) {
      const auto of = part(wave, begin_s, 0.06);
      double best = 0.0, most = 0.0;
      for (double hz = 80.0; hz < 260.0; hz += 1.0) {
        const auto lag = static_cast<std::size_t>(std::lround(kSoundHz / hz));
        double likeness = 0.0;
        for (std::size_t i = 0; i + lag < of.size(); ++i)
          likeness += static_cast<double>(of[i]) * of[i + lag] / static_cast<double>(of.size() - lag);
        if (likeness > most) {
          most = likeness;
          best = hz;
        }
      }
      return best;
    };
    const double length_s = static_cast<double>(wave.size()) / kSoundHz;
    const double first_hz = pitch_hz(0.05), last_hz = pitch_hz(length_s - 0.15);
    EXPECT_GT(first_hz, 140.0);
    EXPECT_LT(last_hz, 0.85 * first_hz);
    double low = 0.0, above = 0.0;
    for (double hz = 100.0; hz < 1400.0; hz += 5.0) low += std::pow(strength(wave, hz), 2.0);
    for (double hz = 1400.0; hz < 4000.0; hz += 5.0) above += std::pow(strength(wave, hz), 2.0);
    EXPECT_GT(low, 10.0 * above);
  }
}

TEST(SoundWaves, HarderIsHigher) {
  const auto middle_hz = [](Sound sound) {
    const std::vector<float> wave = wave_of(sound);
    double sum = 0.0, weighted = 0.0;
    for (double hz = 50.0; hz < 8000.0; hz += 25.0) {
      const double power = std::pow(strength(wave, hz), 2.0);
      sum += power;
      weighted += hz * power;
    }
    return weighted / sum;
  };
  EXPECT_LT(middle_hz(Sound::touch), middle_hz(Sound::pop));
  EXPECT_LT(middle_hz(Sound::pop), middle_hz(Sound::bone));
  EXPECT_LT(middle_hz(Sound::bone), middle_hz(Sound::shot));
}

}  // namespace
}  // namespace seldinger::app
