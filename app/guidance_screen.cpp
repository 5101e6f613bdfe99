#include "app/guidance_screen.h"

#include <cmath>

#include "app/attempt_loop.h"
#include "app/attempt_ticks.h"

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
    const auto due = static_cast<long long>(std::floor(state.t_s * scene_.picture.rate_hz));
    if (!live_ || due < pictures_) return;
    pictures_ = due + 1;
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
  const cases::Instrument& tool = scene_.instrument;
  const imaging::NeedlePose needle{pose.tip_lps_mm, pose.needle_direction, tool.length_mm,
                                   tool.radius_mm,  tool.inner_radius_mm,  tool.hu};
  picture_ = sight_ ? sight_->picture({pose.probe_origin_lps_mm, pose.probe_axial, pose.probe_lateral}, needle,
                                      seed_, static_cast<std::uint64_t>(pictures_), shown_displacement_)
                    : slice_under_probe(scene_, pose, needle, shown_displacement_);
  return picture_;
}

}  // namespace seldinger::app
