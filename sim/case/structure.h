// A structure: what lies in the patient beside the target, and what touching it means (docs/clinical.md, "Body and
// patient" and "Metrics that need care").
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/base/names.h"
#include "sim/case/form/shape.h"
#include "sim/volume/classes.h"

namespace seldinger::cases {

// What a needle inside it means. An organ carries the target: each way in is a puncture of its capsule. Must_cross
// is the tissue through which the right way leads (renal parenchyma before a calyx). Target: the lumen to be
// reached, whose far wall must stay whole.
enum class StructureRule { advisory, major, critical, must_cross, organ, target };
inline constexpr auto kStructureRuleNames = base::names<StructureRule>({{StructureRule::advisory, "advisory"},
                                                                        {StructureRule::major, "major"},
                                                                        {StructureRule::critical, "critical"},
                                                                        {StructureRule::must_cross, "must_cross"},
                                                                        {StructureRule::organ, "organ"},
                                                                        {StructureRule::target, "target"}});

struct Structure {
  std::string name;              // as a mentor calls it: "gallbladder"
  volume::TissueClass tissue{};  // overrides what the CT says where it is drawn
  StructureRule rule = StructureRule::major;
  Shape shape;
};

inline std::string_view name_of(StructureRule rule) noexcept {
  return base::name_of(kStructureRuleNames, rule);
}
inline std::optional<StructureRule> structure_rule_from(std::string_view name) noexcept {
  return base::from_name(kStructureRuleNames, name);
}

}  // namespace seldinger::cases
