// What a mentor makes of a case: structures, label maps, the setting. One transaction a write; only a draft without
// attempts is changed (`not_a_draft`, `has_attempts`): of any other case a new version is made
// (casedb/cases/versions.h).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "casedb/cases/cases.h"
#include "sim/case/structure.h"

namespace seldinger::casedb {

// Where a structure is: all voxels of its class, a label of one of the case's maps, or drawn.
enum class StructureKind { tissue_class, label, drawn };

struct StructureRow {
  std::string structure_id, case_id, name;
  cases::StructureRule rule = cases::StructureRule::major;
  volume::TissueClass tissue{};  // of a drawn one or a label: overrides what the CT says
  StructureKind kind = StructureKind::drawn;
  cases::Shape drawn;         // kind drawn
  std::optional<double> hu;   // drawn: what is painted; nothing: what the CT says stays
  std::string labels_sha256;  // kind label
  int label = 0;              // kind label, 1 to 255
  int position = 0;           // among the case's: later ones are painted over earlier ones
};

std::string name_of(StructureKind kind);

// Ids and positions are made here. `no_case`, `not_a_draft`, `has_attempts`, `bad_structure` (name empty, over 100
// bytes or with control characters, HU not a voxel's, geometry not sound or not touching the volume, no such class
// or label in the case), `name_taken`.
base::Result<std::string> add_structure(Library& library, const StructureRow& structure);
base::Result<void> remove_structure(Library& library, const std::string& case_id,
                                    const std::string& name);  // +
                                                               // `no_structure`
// In place of the structure of that id, or of one that was removed, at its position while that is free. Refuses as
// add_structure.
base::Result<void> put_structure(Library& library, const StructureRow& structure);
std::vector<StructureRow> list_structures(Library& library, const std::string& case_id);  // in their order

// A label map beside the case's volume: voxels as many. A label whose name is that of a tissue
// (volume::tissue_of_name) is the class of its voxels from then on, of maps with a label there the last one's; and
// a structure may be one of its labels. Answers its SHA-256. Refused: `no_case`, `not_a_draft`, `has_attempts`,
// `bad_labels` (size, names).
base::Result<std::string> add_label_map(Library& library, const std::string& case_id,
                                        const volume::LabelMap& labels);
struct StoredLabels {
  std::string sha256;
  volume::LabelMap labels;
  bool wins = true;  // not in a map that was added before schema 48: it counts for structures alone
};
// The case's own first, then those added, in order.
base::Result<std::vector<StoredLabels>> load_label_maps(Library& library, const CaseRow& row);

// `no_case`, `not_a_draft`, `has_attempts`, `bad_setting`; with a title, also as set_title. Both are set, or
// neither.
base::Result<void> set_setting(Library& library, const std::string& case_id, const CaseSetting& setting,
                               const std::optional<std::string>& title = std::nullopt);
base::Result<void> check_case_title(const std::string& title);  // `bad_title`: not 1 to 100 bytes on one line
base::Result<void> set_title(Library& library, const std::string& case_id,
                             const std::string& title);  // `bad_title`

// In place of the lesion of that id, or of one that was removed: with its age, and so in its order. Refuses as
// add_lesion, and `has_attempts`.
base::Result<void> put_lesion(Library& library, const LesionRow& lesion);
// `no_lesion`, `not_a_draft`, `has_attempts`.
base::Result<void> remove_lesion(Library& library, const std::string& case_id, const std::string& lesion_id);

}  // namespace seldinger::casedb
