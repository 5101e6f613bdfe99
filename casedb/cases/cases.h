// Cases of a library and their lesions. One function per question, its SQL beside it in sql/. Ids are UUIDv7 text,
// times microseconds since 1970 UTC. Every write is one transaction: it is stored whole and acknowledged, or not at
// all.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "casedb/cases/case_setting.h"
#include "casedb/cases/case_state.h"
#include "casedb/cases/preparation.h"
#include "casedb/cases/privacy.h"
#include "casedb/database/library.h"
#include "sim/base/result.h"
#include "sim/case/case.h"
#include "sim/case/lesion_form.h"
#include "sim/volume/classes.h"
#include "sim/volume/volume.h"

namespace seldinger::casedb {

// As the database and the command line write them: mpr, xray, ultrasound; supine, prone, lateral_left, …
std::string name_of(cases::Modality modality);
std::optional<cases::Modality> modality_from(const std::string& name);
// All of them, as a usage tells: "mpr, xray or ultrasound".
std::string modality_names();
std::string name_of(cases::PatientPosition position);
std::optional<cases::PatientPosition> position_from(const std::string& name);

// How a case's volume and skin were made of the CT as it came.
struct PreparedFrom {
  Preparation settings;
  volume::Volume original;
};

struct NewCase : CaseSetting {
  std::string title;   // never from the source
  std::string origin;  // "import" or "phantom:<version>"
  volume::Volume volume;
  cases::Mesh skin;
  std::optional<volume::LabelMap> labels;                       // built-in case only
  std::vector<std::pair<std::string, std::string>> attributes;  // the allow-list, name → value
  std::vector<base::Problem> warnings;
  int slices_used = 0;
  FaceState face_state = FaceState::unchecked;
  // Why somebody who may (Action::overrule_face) took for none what the detector of faces found; empty: nobody did.
  // Kept as the warning `face_overruled`.
  std::string face_overruled;
  bool no_burned_in_text = false;                   // somebody looked
  std::optional<std::string> burned_in_checked_by;  // person_id, when it was a person of this library
  std::vector<Dropped> dropped;
  std::optional<PreparedFrom> prepared;  // nothing: volume and skin are as the CT came
};

struct CaseRow : CaseSetting {
  std::string case_id, title, origin;
  CaseState state = CaseState::draft;
  std::int64_t created_us = 0;
  glm::ivec3 size_voxels{0};
  glm::dvec3 spacing_mm{0.0};
  glm::dmat4 lps_from_voxel{1.0};
  int hu_min = 0, hu_max = 0, slices_used = 0;
  std::string volume_sha256, skin_sha256, labels_sha256 /* may be empty */,
      classes_sha256 /* empty: stored before schema 3 */;
  std::vector<std::pair<std::string, std::string>> attributes;
  std::vector<base::Problem> warnings;
  std::string family_id;  // the case_id of version 1
  int version = 1;
  bool own_cohort_only = false;  // published without a second person's review
  FaceState face_state = FaceState::unchecked;
  std::optional<BurnedInCheck> burned_in_checked;  // nothing: nobody has confirmed that no text is burned in
  std::vector<Dropped> dropped;
};

struct LesionRow {
  std::string lesion_id, case_id;
  cases::LesionForm form;
  cases::Lesion lesion;  // without its shape: that is made with the scene
  std::int64_t created_us = 0;
};

// Also computes the tissue classes and stores them, with those of organs that are found in a CT without labels.
std::string add_case(Library& library, const NewCase& new_case);
std::vector<CaseRow> list_cases(Library& library);  // oldest first
// The same for lists of thousands: without attributes, warnings and what was dropped.
std::vector<CaseRow> list_case_heads(Library& library);
base::Result<CaseRow> find_case(Library& library, const std::string& case_id);  // `no_case`
base::Result<volume::Volume> load_volume(Library& library, const CaseRow& row);
base::Result<cases::Mesh> load_skin(Library& library, const CaseRow& row);
base::Result<volume::LabelMap> load_labels(Library& library, const CaseRow& row);  // `no_labels`
// One class per voxel, as add_case stored them, or a label's that was added since (authoring.h). A case from before
// schema 3 has none: they are computed, in about a second for 512 x 512 x 100 voxels.
base::Result<std::vector<volume::TissueClass>> load_classes(Library& library, const CaseRow& row);

// Keeps that a person (or nobody known) looked through the slices and saw no text: `no_case`, `no_person`. The
// first confirmation stays.
base::Result<void> confirm_no_burned_in_text(Library& library, const std::string& case_id,
                                             const std::optional<std::string>& person_id);

// `no_case`, `not_a_draft`, `bad_lesion` (radius or numbers not sound, centre outside the volume, larger than the
// volume).
base::Result<std::string> add_lesion(Library& library, const std::string& case_id, const cases::LesionForm& form);
// A plain sphere.
base::Result<std::string> add_lesion(Library& library, const std::string& case_id, const cases::Lesion& lesion);
// Of one case, oldest first; of every one, case by case.
std::vector<LesionRow> list_lesions(Library& library, const std::optional<std::string>& case_id = {});

}  // namespace seldinger::casedb
