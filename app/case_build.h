// Builds the Case of a simulation from the library, or of a scoring from a scene.
#pragma once

#include "casedb/store.h"
#include "sim/base/result.h"
#include "sim/case/case.h"

namespace seldinger::app {

// Loads volume and skin of a stored case; the lesion becomes the target.
// The fluoroscope is the built-in machine, its isocentre at the volume's middle; how the patient lies is the
// case's.
base::Result<cases::Case> build_case(casedb::Library& library, const casedb::CaseRow& row,
                                     const std::optional<cases::Lesion>& target,
                                     const cases::Instrument& instrument, const cases::Picture& picture,
                                     cases::Approach approach);

// What touch asks, a class per voxel: attempts and their replay. Scoring does without.
base::Result<void> add_tissue(casedb::Library& library, const casedb::CaseRow& row, cases::Case& scene);
// That, and what ultrasound of the case is made of.
base::Result<void> add_ultrasound_tissue(casedb::Library& library, const casedb::CaseRow& row, cases::Case& scene);

}  // namespace seldinger::app
