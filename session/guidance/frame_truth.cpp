#include "session/guidance/frame_truth.h"

namespace seldinger::session {

std::optional<glm::dvec3> target_of(const std::vector<cases::Lesion>& lesions) noexcept {
  return lesions.empty() ? std::nullopt : std::optional(lesions[0].center_lps_mm);
}

cases::FrameTruth frame_truth(double t_s, const imaging::MprView& view, const imaging::NeedlePose& needle,
                              const std::vector<cases::Lesion>& lesions) noexcept {
  return frame_truth(t_s, imaging::mpr_visible(view, needle, target_of(lesions)));
}

cases::FrameTruth frame_truth(double t_s, const imaging::Visible& visible) noexcept {
  cases::FrameTruth truth;
  truth.t_s = t_s;
  truth.needle_tip = visible.needle_tip;
  truth.target = visible.target;
  truth.needle_length_mm = visible.needle_length_mm;
  return truth;
}

cases::FrameTruth frame_truth(double t_s, const imaging::UltrasoundVisible& visible) noexcept {
  cases::FrameTruth truth = frame_truth(t_s, visible.visible);
  truth.near_plane = visible.near_plane;
  return truth;
}

}  // namespace seldinger::session
