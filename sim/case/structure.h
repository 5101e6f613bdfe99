// A structure: what lies in the patient beside the target, and what touching it means (clinical.md, "Body and
// patient" and "Metrics that need care").
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/case/shape.h"
#include "sim/volume/classes.h"

namespace seldinger::cases {

// What a needle inside it means. An organ carries the target: each way in is a puncture of its capsule. Must_cross
// is the tissue through which the right way leads (renal parenchyma before a calyx). Target: the lumen to be
// reached, whose far wall must stay whole.
enum class StructureRule { advisory, major, critical, must_cross, organ, target };
constexpr std::array<std::string_view, 6> kStructureRuleNames = {"advisory",   "major", "critical",
                                                                 "must_cross", "organ", "target"};

struct Structure {
  std::string name;              // as a mentor calls it: "gallbladder"
  volume::TissueClass tissue{};  // overrides what the CT says where it is drawn
  StructureRule rule = StructureRule::major;
  Shape shape;
};

inline std::string_view name_of(StructureRule rule) noexcept {
  return kStructureRuleNames[static_cast<std::size_t>(rule)];
}
inline std::optional<StructureRule> structure_rule_from(std::string_view name) noexcept {
  for (std::size_t at = 0; at < kStructureRuleNames.size(); ++at)
    if (kStructureRuleNames[at] == name) return static_cast<StructureRule>(at);
  return std::nullopt;
}

}  // namespace seldinger::cases
