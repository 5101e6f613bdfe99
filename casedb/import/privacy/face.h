// Whether a face could be made of a volume, told from its geometry, and the two ways to be rid of it. Decision 0017
// says what this rests on, what it was measured with and what it does not see.
#pragma once

#include <glm/vec3.hpp>

#include "casedb/cases/privacy.h"
#include "sim/base/result.h"
#include "sim/volume/volume.h"

namespace seldinger::casedb {

// What stands for a face, each with the patient's feet-head axis (LPS z) of where it begins and ends.
struct FaceFinding {
  bool found = false;
  double chin_lps_mm = 0.0;  // nothing of the face lies below
  double top_lps_mm = 0.0;   // of the facial skeleton
  glm::dvec3 front{0.0};     // where it looks, a unit vector in LPS with z = 0
  double front_mm = 0.0;     // how far along `front` the foremost skin lies
};

// Axes are trusted as the source tells them: anterior is −y, head is +z, the head turned by up to 70°.
// `said_to_be_head` (a hint of the source) makes it look more closely; it neither finds nor clears a face by
// itself.
FaceFinding find_face(const volume::Volume& volume, bool said_to_be_head = false);

enum class FaceChoice { refuse, crop, deface, overrule };

// Leaves the volume as it is where there is no face. Crop: the part of the volume that is wholly below the chin
// stays. Deface: from the chin to the forehead, all that lies in front of a plane 60 mm behind the foremost skin
// becomes air, bone too. Overrule: it stays as it is, and somebody who may answers for it: FaceState::none.
// Refused: `face` (with FaceChoice::refuse), `face_only` (nothing is left below the chin).
base::Result<FaceState> settle_face(volume::Volume& volume, FaceChoice choice, bool said_to_be_head = false);

}  // namespace seldinger::casedb
