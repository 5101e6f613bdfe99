// MPR: the CT in an oblique plane, in HU, with needle and lesion inserted analytically (needle over lesion over
// volume). Three backends behind one signature: `reference` (plain double, own formulas), `cpu` (the formulas of
// shaders/shared/mpr.glsl.h compiled as C++, threads over rows) and `gpu` (the same formulas as a GL 4.3 compute
// shader).
#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "sim/gpu/context.h"
#include "sim/imaging/inserted.h"
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

// How the GPU finds where a pixel's tissue was: by itself for each, or on the CPU's grid of 2 mm
// (sim/tissue/rest_plane.h), as mpr_cpu does. The first is hardware's; software GL takes 30 times as long for it.
enum class WayBack { none, each_pixel, grid };
inline WayBack way_back_for(const gpu::Context& context) noexcept {
  return context.software() ? WayBack::grid : WayBack::each_pixel;
}

// Holds the volume as a stack of integer 2-D textures; render() as often as wanted, on the context's thread. May
// outlive the context. Throws base::Failure("gl") when the volume exceeds the largest texture or memory.
class MprGpu {
 public:
  // What a moving patient's pictures need besides is made only where the patient moves (way_back_for).
  MprGpu(gpu::Context& context, const volume::Volume& volume, WayBack way_back = WayBack::none);
  ~MprGpu();
  HuImage render(const MprView& view, const Inserted& inserted);
  // As the CPU's. Without sources it is the picture above; with some there must be a way back (CHECKed).
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
