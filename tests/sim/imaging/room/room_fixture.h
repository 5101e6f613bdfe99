// A ball of a patient on the table, a needle and a probe over it.
#pragma once

#include "sim/case/case.h"
#include "sim/case/state.h"
#include "tests/fixtures/ball_case.h"

namespace seldinger::imaging {

constexpr double kBallMm = 120.0;

// The middle of the ball is the origin; supine, so that up is −y. Its ends are not cut.
inline cases::Case ball_case(cases::Modality modality = cases::Modality::ultrasound) {
  cases::Case scene = fixtures::ball_case({.voxels = 8, .voxel_mm = 32.0, .radius_mm = kBallMm, .skin_levels = 5});
  scene.picture.modality = modality;
  scene.picture.probe = "L11-5v";
  scene.planned_entry_lps_mm = glm::dvec3(0.0, -kBallMm, 0.0);
  scene.lesions.push_back({{0.0, -60.0, 0.0}, 8.0, 20.0});
  scene.fluoroscope.start.isocentre_lps_mm = glm::dvec3(0.0);
  return scene;
}

// Tools far from each other and from the ball's outline.
inline cases::State ball_state() {
  cases::State state;
  state.needle.tip_lps_mm = {0.0, -kBallMm, 0.0};
  state.needle.direction = glm::normalize(glm::dvec3(0.3, 1.0, 0.0));
  state.probe.origin_lps_mm = {40.0, -kBallMm - 60.0, 60.0};
  state.probe.axial = {0.0, 1.0, 0.0};
  state.probe.lateral = {0.0, 0.0, 1.0};
  state.fluoroscopy.arm = {};
  return state;
}

}  // namespace seldinger::imaging
