// MPR: the CT in an oblique plane, in HU, with needle and lesion inserted analytically (needle over lesion over
// volume). Three backends behind one signature: `reference` (plain double, own formulas), `cpu` (the formulas of
// shaders/shared/mpr.glsl.h compiled as C++, threads over rows) and `gpu` (the same formulas as a GL 4.3 compute
// shader).
#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "sim/case/case.h"
#include "sim/gpu/context.h"
#include "sim/tissue/displacement.h"
#include "sim/volume/volume.h"

namespace seldinger::imaging {

enum class Interpolation { nearest, linear };

// The plane. Pixel (0,0) is at center − u·pixel·(w−1)/2 − v·pixel·(h−1)/2.
struct MprView {
  glm::dvec3 center_lps_mm{0.0};
  glm::dvec3 u{1.0, 0.0, 0.0};  // unit, along a row
  glm::dvec3 v{0.0, 1.0, 0.0};  // unit, down a column
  double pixel_mm = 0.5;
  int width_px = 0, height_px = 0;
  Interpolation interpolation = Interpolation::linear;
  double needle_slab_mm =
      0.0;  // the needle is shown where it passes within half of this from the plane; 0 = its cut
};

// The finite cylinder tip − t·direction, 0 ≤ t ≤ length. Its lumen (inner_radius_mm > 0) is empty and shows as air,
// −1000 HU, over whatever lies there; with a slab the needle shows solid. A pose that is not finite is not shown.
struct NeedlePose {
  glm::dvec3 tip_lps_mm{0.0};
  glm::dvec3 direction{0.0, 0.0, 1.0};  // unit, hub → tip
  double length_mm = 200.0, radius_mm = 0.36, inner_radius_mm = 0.0, hu = 3000.0;
};

// What is inserted into the volume.
struct Inserted {
  std::optional<NeedlePose> needle;
  std::vector<cases::Lesion> lesions;  // at most kMaxLesions; the first that contains a point wins
};
constexpr int kMaxLesions = 16;

// HU, row-major, width_px · height_px. Outside the volume: −1024.
using HuImage = std::vector<float>;

HuImage mpr_reference(const volume::Volume& volume, const MprView& view, const Inserted& inserted);
HuImage mpr_cpu(const volume::Volume& volume, const MprView& view, const Inserted& inserted);

// Of a patient who moves: a pixel shows what of volume and lesions was at rest where its tissue was. The needle is
// where it is. Without sources the picture is the one above, by the same code.
HuImage mpr_reference(const volume::Volume& volume, const MprView& view, const Inserted& inserted,
                      const tissue::Displacement& displacement);
HuImage mpr_cpu(const volume::Volume& volume, const MprView& view, const Inserted& inserted,
                const tissue::Displacement& displacement);
// What the GPU spends on a pixel's way back; the CPU asks on a grid of 2 mm (sim/tissue/rest_plane.h).
constexpr tissue::InverseSteps kPictureSteps{.fixed_point = 4, .newton = 1};

// Holds the volume as a stack of integer 2-D textures; render() as often as wanted, on the context's thread. May
// outlive the context. Throws base::Failure("gl") when the volume exceeds the largest texture or memory.
class MprGpu {
 public:
  // What a moving patient's pictures need besides is made only where the patient moves.
  MprGpu(gpu::Context& context, const volume::Volume& volume, bool patient_moves = false);
  ~MprGpu();
  HuImage render(const MprView& view, const Inserted& inserted);
  // As the CPU's. Without sources it is the picture above; with some the patient must move (CHECKed).
  HuImage render(const MprView& view, const Inserted& inserted, const tissue::Displacement& displacement);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

// The view that stands under a probe: upper edge's middle at the origin, u = lateral, v = axial.
MprView view_under_probe(const glm::dvec3& origin_lps_mm, const glm::dvec3& axial, const glm::dvec3& lateral,
                         double width_mm, double depth_mm, double pixel_mm);

// Grey picture for a person: HU window (centre, width) to 0..255. NaN becomes 255 so that it is seen.
std::vector<unsigned char> grey_from_hu(const HuImage& hu, double window_center_hu, double window_width_hu);

}  // namespace seldinger::imaging
