// Case: everything that is fixed once a scene is loaded. Built once, then only const&.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "sim/case/fluoroscope.h"
#include "sim/case/mesh.h"
#include "sim/case/mesh_index.h"
#include "sim/case/patient_position.h"
#include "sim/case/structure.h"
#include "sim/volume/classes.h"
#include "sim/volume/volume.h"

namespace seldinger::cases {

// Why the tip or the notch decides (clinical.md, Instruments).
enum class InstrumentKind { access, core };

struct Instrument {
  InstrumentKind kind = InstrumentKind::access;
  double length_mm = 200.0;
  double radius_mm = 0.36;       // 22 gauge: 0.72 mm outer diameter (ISO 9626)
  double inner_radius_mm = 0.0;  // 0 = solid
  double hu = 3000.0;
  double throw_mm = 22.0;    // core only: the way the tip goes when fired
  double notch_mm = 18.0;    // core only: length of the sample notch
  double dead_tip_mm = 4.0;  // core only: from the notch's end to the tip
};

struct Lesion {
  glm::dvec3 center_lps_mm{0.0};
  double radius_mm = 0.0;
  double hu = 0.0;
};

enum class Approach { in_plane, out_of_plane };
enum class Modality { mpr, xray, ultrasound };

// mpr: the picture under the probe: u = lateral, v = axial, the upper edge's middle at the probe's origin.
// xray: the fluoroscope's own; depth, width and rate say nothing.
// ultrasound: the probe's; its width says nothing, its rate is a physical one.
struct Picture {
  Modality modality = Modality::mpr;
  double depth_mm = 150.0;
  double width_mm = 150.0;
  double rate_hz = 30.0;
  std::string probe{};  // ultrasound: its name
};

struct Case {
  volume::Volume volume;
  // Of every voxel, in the volume's order; where something is felt or seen by ultrasound, else empty.
  std::vector<volume::TissueClass> classes;
  std::vector<std::uint8_t> echogenicity;  // as imaging makes it of volume and classes
  Mesh skin;
  MeshIndex skin_index;
  std::vector<Lesion> lesions;  // [0] is the target
  std::vector<Structure> structures;
  Instrument instrument;
  Picture picture;
  Approach approach = Approach::in_plane;  // of needle to picture; says nothing under xray
  PatientPosition position = PatientPosition::supine;
  Fluoroscope fluoroscope;  // used under xray only
};

}  // namespace seldinger::cases
