#include "session/guidance/slice_picture.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "sim/imaging/mpr/visibility.h"

namespace seldinger::session {

imaging::MprView slice_view(const cases::Picture& picture, const cases::PoseSample& pose,
                            const cases::ConsoleSetting& console) {
  const glm::dvec3 aside = glm::cross(pose.probe_axial, pose.probe_lateral);
  const double aside_mm = std::clamp(console.slice_mm, -kMostSliceMm, kMostSliceMm);
  imaging::MprView view =
      imaging::view_under_probe(pose.probe_origin_lps_mm + aside_mm * aside, pose.probe_axial, pose.probe_lateral,
                                picture.width_mm, picture.depth_mm, kSlicePixelMm);
  view.needle_slab_mm = 2.0 * imaging::kMprSlabHalfMm;  // drawn where it counts as seen
  return view;
}

GreyPicture slice_under_probe(const cases::Case& scene, const cases::PoseSample& pose,
                              const cases::ConsoleSetting& console, const imaging::NeedlePose& needle,
                              const tissue::Displacement& displacement, const HuWindow& window) {
  const imaging::MprView view = slice_view(scene.picture, pose, console);
  return {imaging::grey_from_hu(imaging::mpr_cpu(scene.volume, view, {needle, scene.lesions}, displacement),
                                window.center_hu, window.width_hu),
          view.width_px, view.height_px};
}

}  // namespace seldinger::session
