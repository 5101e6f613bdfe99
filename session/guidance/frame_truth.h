// What a picture showed, as recordings keep it: told by imaging, written down here.
#pragma once

#include <optional>

#include "sim/case/record/recording.h"
#include "sim/imaging/mpr/visibility.h"
#include "sim/imaging/ultrasound/visible.h"

namespace seldinger::session {

cases::FrameTruth frame_truth(double t_s, const imaging::Visible& visible) noexcept;
cases::FrameTruth frame_truth(double t_s, const imaging::UltrasoundVisible& visible) noexcept;

cases::FrameTruth frame_truth(double t_s, const imaging::MprView& view, const imaging::NeedlePose& needle,
                              const std::vector<cases::Lesion>& lesions) noexcept;

// The lesion that counts: the first.
std::optional<glm::dvec3> target_of(const std::vector<cases::Lesion>& lesions) noexcept;

}  // namespace seldinger::session
