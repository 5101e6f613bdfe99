// What an attempt was made at: a draft's needle, picture or approach may be changed between two attempts at it.
#pragma once

#include <string>
#include <tuple>

#include "sim/case/case.h"

namespace seldinger::casedb {

// Of two attempts the same where both were made at the same.
inline auto made_at(const std::string& case_id, const std::string& lesion_id, const cases::Instrument& tool,
                    const cases::Picture& picture, cases::Approach approach) {
  return std::tuple(case_id, lesion_id, tool.kind, tool.length_mm, tool.radius_mm, tool.inner_radius_mm, tool.hu,
                    tool.throw_mm, tool.notch_mm, tool.dead_tip_mm, picture.modality, picture.depth_mm,
                    picture.width_mm, picture.rate_hz, picture.probe, approach);
}

}  // namespace seldinger::casedb
