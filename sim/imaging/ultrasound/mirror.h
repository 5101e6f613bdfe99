// Lung as a mirror: which beams meet it and how it lies there, and the picture with what it shows
// (docs/decisions/0081).
#pragma once

#include <span>
#include <vector>

#include "shaders/shared/ultrasound_passes.glsl.h"
#include "sim/imaging/ultrasound/behind_air.h"
#include "sim/imaging/ultrasound/view/fan.h"
#include "sim/imaging/ultrasound/view/motion.h"

namespace seldinger::imaging {

// Shadows of edges and what lung mirrors, in cases of a law that nothing was published by before there were these
// (docs/decisions/0081): by the earlier ones pictures stay as they were.
inline bool shows_artefacts(const UltrasoundView& view) {
  return view.sight_law >= cases::SightLaw::scatter;
}
// Layers from round bodies, by how wide they are; the law scatter takes a layer that is tilted for a ball.
inline bool tells_layers(const UltrasoundView& view) {
  return view.sight_law >= cases::SightLaw::clutter;
}

// One a beam; none at all where no beam meets lung. The surface is a straight line through where neighbouring beams
// meet it.
std::vector<shaders::UsMirror> mirrors_of(const UltrasoundView& view, std::span<const AirMet> met);
inline std::vector<shaders::UsMirror> mirrors_of(const UltrasoundView& view, const TissueAt& tissue_at,
                                                 const PictureMotion* motion,
                                                 std::span<const float> depth_below_skin_mm) {
  return mirrors_of(view, air_met(view, tissue_at, motion, depth_below_skin_mm));
}

// What a shader is told that does the same.
shaders::UsMirrorParameters mirror_parameters(const UltrasoundView& view);

// Adds to the envelope what shows behind the mirrors.
void add_mirrored(const UltrasoundView& view, std::span<const shaders::UsMirror> mirrors, PolarPicture& picture);

}  // namespace seldinger::imaging
