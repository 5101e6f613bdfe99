#include "app/measure/rigs/needle_trials.h"

#include "app/measure/rigs/thesis_needle.h"

namespace seldinger::measure {
namespace {

using volume::TissueClass;

haptics::NeedleLayer layer(double start_mm, TissueClass tissue) {
  return {start_mm, haptics::needle_tissue(tissue)};
}

Trial driven(const haptics::ArmModel& device, const haptics::Hand& hand) {
  Trial trial{device, hand};
  trial.to_mm = 20.0;
  trial.push_n = 0.0;
  trial.drive_mm_s = 500.0 / 60.0;
  trial.seconds = 4.0;
  trial.watched_s = 2.0;
  return trial;
}

}  // namespace

const std::vector<NeedleSituation>& needle_situations() {
  static const std::vector<NeedleSituation> situations = {
      {"capsule half dented", {layer(0.0, TissueClass::kidney)}, 5.0},
      {"capsule before rupture", {layer(0.0, TissueClass::kidney)}, 9.5},
      {"plateau in kidney", {layer(0.0, TissueClass::kidney)}, 40.0},
      {"plateau in liver", {layer(0.0, TissueClass::liver)}, 70.0},
      {"pulled back by 3 mm", {layer(0.0, TissueClass::kidney)}, 40.0, 3.0},
      {"bone struck at 100 mm/s",
       {layer(0.0, TissueClass::muscle), layer(30.0, TissueClass::bone)},
       33.0,
       0.0,
       100.0},
  };
  return situations;
}

Settling settle_needle(const NeedleSituation& situation, const haptics::ArmModel& device, const haptics::Hand& hand,
                       double factor) {
  haptics::NeedleSettings settings = haptics::needle_settings(device);
  settings.stiffness_n_mm *= factor;
  const haptics::NeedleLaw law(settings);
  haptics::NeedleTrack track;
  Trial trial{device, hand};
  trial.to_mm = situation.to_mm;
  trial.back_mm = situation.back_mm;
  trial.speed_mm_s = situation.speed_mm_s;
  return settle(trial, [&](double depth_mm) { return law.advance(situation.path, depth_mm, track).axial_n; });
}

Settling drive_needle(const haptics::ArmModel& device, const haptics::Hand& hand) {
  const haptics::NeedleLayer kidney = layer(0.0, TissueClass::kidney);
  const haptics::NeedleLaw law(haptics::needle_settings(device));
  haptics::NeedleTrack track;
  return settle(driven(device, hand), [&](double depth_mm) {
    return law.advance({&kidney, 1}, depth_mm, track).axial_n;
  });
}

Settling drive_thesis(const haptics::ArmModel& device, const haptics::Hand& hand, int m) {
  ThesisNeedle law(haptics::needle_tissue(TissueClass::kidney).intercept_n, m);
  return settle(driven(device, hand), [&](double depth_mm) { return law.advance(depth_mm); });
}

}  // namespace seldinger::measure
