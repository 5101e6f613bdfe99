#include "app/window/sound/sound_waves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

#include "sim/base/check.h"
#include "sim/base/rng.h"

namespace seldinger::app {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
using Wave = std::vector<float>;

std::size_t samples_in(double length_s) {
  return static_cast<std::size_t>(std::lround(length_s * kSoundHz));
}

double at_s(std::size_t sample) {
  return static_cast<double>(sample) / kSoundHz;
}

// Adds `of(t)` from begin_s on, for length_s.
template <typename Of>
void add(Wave& wave, double begin_s, double length_s, const Of& of) {
  const std::size_t begin = samples_in(begin_s), count = samples_in(length_s);
  if (wave.size() < begin + count) wave.resize(begin + count, 0.0F);
  for (std::size_t i = 0; i < count; ++i) wave[begin + i] += static_cast<float>(of(at_s(i)));
}

// From 0 to 1 in rise_s, and back in the last fall_s; half a cosine each.
double swell(double t_s, double length_s, double rise_s, double fall_s) {
  const double up = std::clamp(t_s / rise_s, 0.0, 1.0), down = std::clamp((length_s - t_s) / fall_s, 0.0, 1.0);
  return (0.5 - 0.5 * std::cos(std::numbers::pi * up)) * (0.5 - 0.5 * std::cos(std::numbers::pi * down));
}

// What is hit rings in a few modes that die away. Which ones is design: heard as soft, thin, hard or metal.
struct Mode {
  double hz, decay_s, amplitude;
};

void hit(Wave& wave, double begin_s, std::span<const Mode> modes, double length_s) {
  add(wave, begin_s, length_s, [&](double t_s) {
    double value = 0.0;
    for (const Mode& mode : modes)
      value += mode.amplitude * std::sin(kTurn * mode.hz * t_s) * std::exp(-t_s / mode.decay_s);
    return value * swell(t_s, length_s, 0.0005, 0.2 * length_s);
  });
}

// How a resonance of `hz`, `wide_hz` broad, carries a tone (Klatt, J Acoust Soc Am 67, 1980).
double carried(double tone_hz, double hz, double wide_hz) {
  const double r = tone_hz / hz;
  return 1.0 / std::hypot(1.0 - r * r, wide_hz * r / hz);
}

// Mean formants of 33 men, Hz (Peterson and Barney, J Acoust Soc Am 24, 1952, table II); breadths as Klatt's.
using Vowel = std::array<double, 3>;
constexpr Vowel kFather{730.0, 1090.0, 2440.0}, kUp{640.0, 1190.0, 2390.0}, kPut{440.0, 1020.0, 2240.0};
constexpr std::array<double, 3> kFormantWideHz{60.0, 90.0, 150.0};

// A voice that goes from one vowel and pitch to another. Harmonics fall by 1/h at the mouth (a glottis' 12 dB an
// octave, of which radiation gives 6 back).
void voice(Wave& wave, double begin_s, double length_s, const Vowel& from, const Vowel& to, double from_hz,
           double to_hz) {
  constexpr double kHighestHz = 4000.0;
  double turns = 0.0;
  add(wave, begin_s, length_s, [&](double t_s) {
    const double share = t_s / length_s, pitch_hz = from_hz + share * (to_hz - from_hz);
    turns += pitch_hz / kSoundHz;
    double value = 0.0;
    for (int h = 1; h * pitch_hz < kHighestHz; ++h) {
      double strength = 1.0 / h;
      for (std::size_t f = 0; f < from.size(); ++f)
        strength *= carried(h * pitch_hz, from[f] + share * (to[f] - from[f]), kFormantWideHz[f]);
      value += strength * std::sin(kTurn * h * turns);
    }
    return value * swell(t_s, length_s, 0.03, 0.5 * length_s);
  });
}

// Breath: noise through a resonance. `loud` of t.
template <typename Loud>
void breath(Wave& wave, double begin_s, double length_s, double hz, double wide_hz, std::uint64_t seed,
            const Loud& loud) {
  const std::complex<double> pole =
      std::polar(std::exp(-std::numbers::pi * wide_hz / kSoundHz), kTurn * hz / kSoundHz);
  base::Rng noise(seed);
  std::complex<double> rings = 0.0;
  add(wave, begin_s, length_s, [&](double t_s) {
    rings = pole * rings + (2.0 * noise.uniform() - 1.0);
    return loud(t_s) * rings.imag();
  });
}

// Of one burst that throws the glottis open, and a rest that dies away.
void cough_once(Wave& wave, double begin_s, double length_s, std::uint64_t seed) {
  const auto loud = [&](double t_s) {
    return swell(t_s, length_s, 0.01, 0.5 * length_s) * (0.3 + 0.7 * std::exp(-t_s / 0.05));
  };
  breath(wave, begin_s, length_s, 600.0, 300.0, seed, loud);
  breath(wave, begin_s, length_s, 1600.0, 600.0, seed + 1, loud);
}

// Scientific pitch, equal temperament.
constexpr double kC4 = 261.63, kE4 = 329.63, kG4 = 392.00, kC5 = 523.25;

void pulses(Wave& wave, Sound alarm) {
  constexpr double kRise = 0.2;       // of its length (10 to 40 %)
  constexpr int kHarmonics = 6;       // besides the fundamental at least 4 from 300 to 4000 Hz,
  constexpr double kOvertone = 0.75;  // none more than 15 dB from it
  for (const AlarmPulse& pulse : alarm_pulses(alarm))
    add(wave, pulse.begin_s, pulse.length_s, [&](double t_s) {
      double value = 0.0, strength = 1.0;
      for (int h = 1; h <= kHarmonics; ++h, strength *= kOvertone)
        value += strength * std::sin(kTurn * h * pulse.tone_hz * t_s);
      return value * swell(t_s, pulse.length_s, kRise * pulse.length_s, kRise * pulse.length_s);
    });
}

constexpr std::array<Mode, 2> kTouch{{{90.0, 0.030, 1.0}, {210.0, 0.012, 0.3}}};
constexpr std::array<Mode, 2> kPrick{{{1300.0, 0.004, 1.0}, {2900.0, 0.002, 0.4}}};
constexpr std::array<Mode, 2> kPop{{{240.0, 0.020, 1.0}, {950.0, 0.005, 0.6}}};
constexpr std::array<Mode, 3> kBone{{{720.0, 0.018, 1.0}, {1850.0, 0.009, 0.7}, {3300.0, 0.004, 0.4}}};
constexpr std::array<Mode, 4> kSteel{
    {{900.0, 0.030, 0.5}, {2150.0, 0.010, 1.0}, {3480.0, 0.008, 0.8}, {5200.0, 0.005, 0.6}}};
constexpr double kCannulaLaterS = 0.035;  // than the stylet (design; both are out within 0.1 s)

Wave raw_wave_of(Sound sound) {
  Wave wave;
  switch (sound) {
    case Sound::touch:
      hit(wave, 0.0, kTouch, 0.15);
      break;
    case Sound::prick:
      hit(wave, 0.0, kPrick, 0.03);
      break;
    case Sound::pop:
      hit(wave, 0.0, kPop, 0.10);
      break;
    case Sound::bone:
      hit(wave, 0.0, kBone, 0.10);
      break;
    case Sound::shot:
      hit(wave, 0.0, kSteel, 0.15);
      hit(wave, kCannulaLaterS, kSteel, 0.15);
      break;
    case Sound::ow:  // higher than the 132 Hz of men who read (Peterson and Barney)
      voice(wave, 0.0, 0.45, kFather, kPut, 210.0, 140.0);
      break;
    case Sound::groan:
      voice(wave, 0.0, 0.80, kUp, kUp, 165.0, 105.0);
      break;
    case Sound::cough:
      cough_once(wave, 0.0, 0.25, 1);
      cough_once(wave, 0.40, 0.30, 3);
      break;
    case Sound::breath_in:
      breath(wave, 0.0, 0.9, 1500.0, 900.0, 5, [](double t_s) { return swell(t_s, 0.9, 0.7, 0.1); });
      break;
    case Sound::breath_out:
      breath(wave, 0.0, 1.1, 800.0, 600.0, 6, [](double t_s) { return swell(t_s, 1.1, 0.05, 1.0); });
      break;
    case Sound::alarm_high:
    case Sound::alarm_medium:
      pulses(wave, sound);
      break;
    case Sound::beam_timer:  // "for at least 2 second" (21 CFR 1020.32 (h)(2)(ii)); the tone is design
      add(wave, 0.0, 2.1, [](double t_s) { return std::sin(kTurn * 700.0 * t_s) * swell(t_s, 2.1, 0.02, 0.02); });
      break;
  }
  return wave;
}

}  // namespace

std::vector<AlarmPulse> alarm_pulses(Sound alarm) {
  CHECK(alarm == Sound::alarm_high || alarm == Sound::alarm_medium);
  // Melodies as IEC 60601-1-8:2006, annex F: cardiovascular "c e g – g C", twice; general "c c c".
  if (alarm == Sound::alarm_medium) {
    constexpr double kLengthS = 0.20, kGapS = 0.20;  // 125 to 250 ms each
    std::vector<AlarmPulse> all;
    for (int i = 0; i < 3; ++i) all.push_back({i * (kLengthS + kGapS), kLengthS, kC4});
    return all;
  }
  constexpr double kLengthS = 0.15, kGapS = 0.10;  // 75 to 200 ms; x: 50 to 125 ms
  constexpr double kThirdGapS = 2.0 * kGapS + kLengthS;
  constexpr double kBurstGapS = 0.60;  // 0.35 to 1.3 s
  constexpr std::array<double, 5> kTones{kC4, kE4, kG4, kG4, kC5};
  std::vector<AlarmPulse> all;
  double begin_s = 0.0;
  for (int burst = 0; burst < 2; ++burst) {
    for (std::size_t i = 0; i < kTones.size(); ++i) {
      all.push_back({begin_s, kLengthS, kTones[i]});
      begin_s += kLengthS + (i == 2 ? kThirdGapS : kGapS);
    }
    begin_s += kBurstGapS - kGapS;
  }
  return all;
}

std::vector<float> wave_of(Sound sound) {
  Wave wave = raw_wave_of(sound);
  float highest = 0.0F;
  for (const float value : wave) highest = std::max(highest, std::abs(value));
  for (float& value : wave) value /= highest;
  return wave;
}

}  // namespace seldinger::app
