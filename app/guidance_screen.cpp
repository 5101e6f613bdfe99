#include "app/guidance_screen.h"

#include "app/slice_picture.h"
#include "sim/case/recorded_tick.h"

namespace seldinger::app {

GuidanceScreen::GuidanceScreen(const cases::Case& scene, std::uint64_t seed) : scene_(scene), seed_(seed) {
  if (scene.picture.modality == cases::Modality::ultrasound) sight_.emplace(scene);
  if (scene.picture.modality == cases::Modality::xray) room_.emplace(scene);
}

void GuidanceScreen::tick(const cases::State& state, const tissue::Displacement& displacement) {
  if (room_) {
    live_ = state.fluoroscopy.live;
    if (!state.fluoroscopy.frame_due) return;
  } else {
    live_ = !state.probe.frozen;
    // As the loop that turned the attempt counted them.
    if (!live_ || !clock_.due(state.t_s, picture_rate_hz(scene_.picture, state.probe.console))) return;
  }
  shown_ = state;
  shown_displacement_ = displacement;
  drawn_ = false;
}

const GreyPicture& GuidanceScreen::picture() {
  if (drawn_) return picture_;
  drawn_ = true;
  if (room_) {
    picture_ = room_->picture(shown_, seed_, shown_displacement_);
    return picture_;
  }
  const cases::PoseSample pose = pose_of(shown_);
  const imaging::NeedlePose needle =
      imaging::needle_pose(scene_.instrument, pose.tip_lps_mm, pose.needle_direction);
  const cases::ConsoleSetting& console = shown_.probe.console;
  picture_ = sight_
                 ? sight_->picture({pose.probe_origin_lps_mm, pose.probe_axial, pose.probe_lateral}, console,
                                   needle, seed_, static_cast<std::uint64_t>(clock_.count()), shown_displacement_)
                 : slice_under_probe(scene_, pose, console, needle, shown_displacement_);
  return picture_;
}

}  // namespace seldinger::app
