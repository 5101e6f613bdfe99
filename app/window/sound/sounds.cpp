#include "app/window/sound/sounds.h"

#include <algorithm>
#include <cmath>

namespace seldinger::app {
namespace {

using cases::EventKind;

constexpr std::array<SoundInfo, kSounds> kInfos = {{
    {Sound::touch, "touch", Voice::hands, 0.20},
    {Sound::prick, "prick", Voice::hands, 0.15},
    {Sound::pop, "pop", Voice::hands, 0.30},
    {Sound::bone, "bone", Voice::hands, 0.35},
    {Sound::shot, "shot", Voice::hands, 0.45},
    {Sound::ow, "ow", Voice::patient, 0.35},
    {Sound::groan, "groan", Voice::patient, 0.35},
    {Sound::cough, "cough", Voice::patient, 0.35},
    {Sound::breath_in, "breath_in", Voice::patient, 0.12},
    {Sound::breath_out, "breath_out", Voice::patient, 0.15},
    {Sound::alarm_high, "alarm_high", Voice::alarm, 0.20},
    {Sound::alarm_medium, "alarm_medium", Voice::alarm, 0.15},
    {Sound::beam_timer, "beam_timer", Voice::alarm, 0.15},
}};

// What is said or happens, and what of it is heard. What is not in here is silent: the trainee's own words, too.
struct Row {
  EventKind kind;
  Sound sound;
};
constexpr std::array<Row, 8> kHeard = {{
    {EventKind::pain_skin, Sound::ow},
    {EventKind::pain_bone, Sound::groan},
    {EventKind::pain_bone, Sound::bone},
    {EventKind::breath_held, Sound::breath_in},
    {EventKind::breath_lost, Sound::breath_out},
    {EventKind::cough, Sound::cough},
    {EventKind::bleeding, Sound::alarm_high},
    {EventKind::pressure_drop, Sound::alarm_high},
}};

double probe_n(const engine::Moment& moment) noexcept {
  return moment.force ? moment.force->probe_n : 0.0;
}

}  // namespace

std::span<const SoundInfo, kSounds> sound_infos() noexcept {
  return kInfos;
}

const SoundInfo& info_of(Sound sound) noexcept {
  return kInfos[static_cast<std::size_t>(sound)];
}

std::vector<Sounding> sounds_of(const Seen& before, const Seen& now, cases::InstrumentKind instrument) {
  std::vector<Sounding> heard;
  const engine::Moment &then = before.moment, &moment = now.moment;
  if (moment.state.t_s <= then.state.t_s) return heard;

  if (probe_n(moment) > kHeardTouchN && probe_n(then) <= kHeardTouchN) heard.push_back({Sound::touch});
  if (moment.state.needle.skin.in_body && !then.state.needle.skin.in_body) heard.push_back({Sound::prick});
  if (moment.capsules > then.capsules)
    heard.push_back({Sound::pop, std::clamp(moment.capsule_n / kLoudCapsuleN, 0.1, 1.0)});
  if (instrument == cases::InstrumentKind::core && moment.state.fire.fired && !then.state.fire.fired)
    heard.push_back({Sound::shot});

  const auto happened = [&](EventKind kind, double t_s) {
    for (const Row& row : kHeard)
      if (row.kind == kind && t_s > then.state.t_s) heard.push_back({row.sound});
  };
  happened(moment.reaction, moment.reaction_t_s);
  happened(moment.event, moment.event_t_s);

  for (std::size_t side = 0; before.arms.used && side < 2; ++side)
    if (now.arms.lost[side] && !before.arms.lost[side]) {
      heard.push_back({Sound::alarm_medium});
      break;
    }
  const auto signals = [](const engine::Moment& at) {
    return std::floor(at.state.fluoroscopy.fluoroscopy_time_s / kBeamTimerS);
  };
  if (signals(moment) > signals(then)) heard.push_back({Sound::beam_timer});
  return heard;
}

}  // namespace seldinger::app
