// Case: everything that is fixed once a scene is loaded. Built once, then only const&.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/base/names.h"
#include "sim/case/breathing.h"
#include "sim/case/fluoroscope.h"
#include "sim/case/form/mesh.h"
#include "sim/case/form/mesh_index.h"
#include "sim/case/lesion_kind.h"
#include "sim/case/patient_position.h"
#include "sim/case/structure.h"
#include "sim/case/subject.h"
#include "sim/case/touch.h"
#include "sim/volume/classes.h"
#include "sim/volume/volume.h"

namespace seldinger::cases {

// Why the tip or the notch decides (docs/clinical.md, Instruments).
enum class InstrumentKind { access, core };
inline constexpr auto kInstrumentKindNames =
    base::names<InstrumentKind>({{InstrumentKind::access, "access"}, {InstrumentKind::core, "core"}});

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

// A lesion to sound, once it is known what lies about it (sim/imaging/ultrasound/view/lesion_echo.h). dB: mean
// square echo above liver's speckle.
struct LesionEcho {
  volume::TissueClass inside = volume::TissueClass::soft_tissue, rim = volume::TissueClass::soft_tissue;
  double inside_db = 0.0, rim_db = 0.0;
  double rim_mm = 0.0;      // of its own outside
  LesionTexture texture{};  // of the inside
  double texture_db = 0.0;  // by which the inside's is raised, so that its own mean square is that of inside_db
  double margin_mm = 0.0;   // of its own outside: from there it passes into what lies about it, by mean square
  double about_db = 0.0;    // of that
};

// A sphere of one HU is drawn by the pictures. Any other (sim/case/lesion_form.h) has a shape and lies in the
// volume: pictures do not draw it, and for what they show it counts as the ball of its volume.
struct Lesion {
  glm::dvec3 center_lps_mm{0.0};
  double radius_mm = 0.0;                // of the sphere, or of the ball of the shape's volume
  double hu = 0.0;                       // of one in the volume: its mean, once it lies there
  std::shared_ptr<const Shape> shape{};  // null: the sphere
  double around_hu = 0.0;                // of one in the volume: mean of what was there
  LesionKind kind = LesionKind::by_hu;
  std::optional<LesionEcho> echo{};  // nothing: what its HU say
  bool in_volume() const noexcept { return shape != nullptr; }
};

inline Shape shape_of(const Lesion& lesion) {
  return lesion.shape ? *lesion.shape : Shape{Sphere{lesion.center_lps_mm, lesion.radius_mm}};
}

enum class Approach { in_plane, out_of_plane };
inline constexpr auto kApproachNames =
    base::names<Approach>({{Approach::in_plane, "in_plane"}, {Approach::out_of_plane, "out_of_plane"}});
enum class Modality { mpr, xray, ultrasound };
inline constexpr auto kModalityNames =
    base::names<Modality>({{Modality::mpr, "mpr"}, {Modality::xray, "xray"}, {Modality::ultrasound, "ultrasound"}});

// By which law a picture is said to show tip and target (docs/decisions/0057): a case's for good. Each as the one
// before, but for:
enum class SightLaw {
  half_slice,  // the tip within half the slice's width at any tilt, a target of any size by its contrast
  echo,        // the tip by its echo alone, a target by contrast and size
  scatter,     // with scatter on the panel (docs/decisions/0082) and artefacts of ultrasound (0081)
  clutter,     // with clutter in ultrasound (docs/decisions/0090)
  material,    // with the CT's contrast medium as iodine under X-rays (docs/decisions/0098), portal walls (0100),
               // and lesions' texture (0102)
  tilt  // with a tip that fades with its tilt as the shaft does, lines that overlap (docs/decisions/0106), and
        // lesions' margins (0107)
};
inline constexpr auto kSightLawNames = base::names<SightLaw>({{SightLaw::half_slice, "half_slice"},
                                                              {SightLaw::echo, "echo"},
                                                              {SightLaw::scatter, "scatter"},
                                                              {SightLaw::clutter, "clutter"},
                                                              {SightLaw::material, "material"},
                                                              {SightLaw::tilt, "tilt"}});
inline constexpr SightLaw kNewestSightLaw = SightLaw::tilt;

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
  std::optional<double> ct_tube_kv{};  // of the scanner; nothing: not known
  // Of every voxel, in the volume's order; where something is felt or seen by ultrasound, else empty.
  std::vector<volume::TissueClass> classes;
  std::vector<std::uint8_t> echogenicity;  // as imaging makes it of volume and classes
  Mesh skin;
  MeshIndex skin_index;
  std::vector<Lesion> lesions;  // [0] is the target
  std::vector<Structure> structures;
  Instrument instrument;
  Touch touch;
  Picture picture;
  SightLaw sight_law = kNewestSightLaw;
  Approach approach = Approach::in_plane;  // of needle to picture; says nothing under xray
  Subject subject = Subject::patient;
  PatientPosition position = PatientPosition::supine;
  std::optional<glm::dvec3> planned_entry_lps_mm{};  // on the skin
  // What moves its tissue; neither: it lies as still as the CT.
  std::optional<Breathing> breathing{};
  bool yields = false;           // to probe and needle
  bool probe_is_chosen = false;  // ultrasound: by whoever attempts it
  std::optional<bool>
      defer_is_right{};     // what has to be decided at the sign-in; nothing: nobody said, or nobody is asked
  Fluoroscope fluoroscope;  // used under xray only
};

}  // namespace seldinger::cases
