// Builds the Case of a simulation from the library, or of a scoring from a scene.
#pragma once

#include "casedb/attempts/attempts.h"
#include "casedb/cases/cases.h"
#include "session/guidance/guidance_needs.h"
#include "sim/base/result.h"
#include "sim/case/case.h"

namespace seldinger::session {

// What of a stored case stays as it is, loaded once by who builds the case again and again. Without classes where
// they are not needed.
struct CaseAssets {
  volume::Volume volume;
  cases::Mesh skin;
  cases::MeshIndex skin_index;
  std::optional<std::vector<volume::TissueClass>> classes;
};
// Refused: damaged or missing assets.
base::Result<CaseAssets> load_assets(casedb::Library& library, const casedb::CaseRow& row, Needs needs);

// Volume, skin and structures of a stored case; the lesion becomes the target. What is drawn is painted into the
// volume and, where they are needed, into the classes: structures in their order, then the lesion. Instrument and
// approach are the case's own unless an attempt had others; patient's position the case's. The fluoroscope is the
// built-in machine, its isocentre at the volume's middle. Refused: damaged or missing assets.
base::Result<cases::Case> build_case(casedb::Library& library, const casedb::CaseRow& row,
                                     const std::optional<cases::LesionForm>& target, const cases::Picture& picture,
                                     Needs needs);

// Of what was loaded before.
base::Result<cases::Case> build_case(casedb::Library& library, const casedb::CaseRow& row, CaseAssets assets,
                                     const std::optional<cases::LesionForm>& target, const cases::Picture& picture,
                                     Needs needs);

// Of a case that is not stored yet, without lesions and structures: what a place for one is looked for in.
cases::Case build_case(const casedb::NewCase& made, const cases::Picture& picture, Needs needs);

// One more lesion of the scene, painted where pictures do not draw it themselves.
void add_lesion(const cases::LesionForm& form, cases::Case& scene);

// As an attempt was made: its lesion, instrument, picture and approach.
base::Result<cases::Case> build_case_of(casedb::Library& library, const casedb::AttemptRow& attempt, Needs needs);

}  // namespace seldinger::session
