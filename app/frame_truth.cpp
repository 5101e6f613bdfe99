#include "app/frame_truth.h"

namespace seldinger::app {

std::optional<glm::dvec3> target_of(const std::vector<cases::Lesion>& lesions) noexcept {
  return lesions.empty() ? std::nullopt : std::optional(lesions[0].center_lps_mm);
}

cases::FrameTruth frame_truth(double t_s, const imaging::MprView& view, const imaging::NeedlePose& needle,
                              const std::vector<cases::Lesion>& lesions) noexcept {
  const imaging::Visible visible = imaging::mpr_visible(view, needle, target_of(lesions));
  cases::FrameTruth truth;
  truth.t_s = t_s;
  truth.needle_tip = visible.needle_tip;
  truth.target = visible.target;
  truth.needle_length_mm = visible.needle_length_mm;
  return truth;
}

}  // namespace seldinger::app
