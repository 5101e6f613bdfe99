// X-ray projection: how much of what each pixel's ray crosses. All methods integrate exactly the segment source →
// pixel centre; voxels reach half a voxel beyond their centres, so the volume ends at its outer faces (the lower
// face belongs to it, the upper does not). Lengths do not depend on energy: exposure, window and noise are
// post-passes over them.
//
// A voxel counts as `water_mm` = min(1, max(0, 1 + HU/1000)) and `mineral_mm` = max(0, HU)/1000 per mm (see
// attenuation.h). Below −1000 HU, which is noise and padding, attenuation would be negative: clamped to 0.
//
// Backends: xray_reference (plain double, the oracle), XrayCpu (packets of rays, SIMD, threads over tiles), XrayGpu
// (GL 4.3 compute). Instruments are laid over afterwards (instruments.h), the same for all.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "sim/base/result.h"
#include "sim/gpu/context.h"
#include "sim/volume/volume.h"

namespace seldinger::imaging {

// Where the rays run. Pixel (0,0) is at center − u·pixel·(w−1)/2 − v·pixel·(h−1)/2. With a source, rays run from it
// to each pixel's centre; without one they are parallel to `direction` and start outside the volume.
struct XrayGeometry {
  std::optional<glm::dvec3> source_lps_mm;
  glm::dvec3 direction{0.0, 1.0, 0.0};  // unit, source to detector; parallel rays only
  glm::dvec3 detector_center_lps_mm{0.0};
  glm::dvec3 u{1.0, 0.0, 0.0};  // unit, along a row
  glm::dvec3 v{0.0, 1.0, 0.0};  // unit, down a column, perpendicular to u
  double pixel_mm = 1.0;
  int width_px = 0, height_px = 0;
  bool operator==(const XrayGeometry&) const = default;
};

// Refused: `bad_geometry` (not finite, no size, axes not orthonormal, source in the detector's plane, rays along
// it, more than 2^28 pixels).
base::Result<void> check_geometry(const XrayGeometry& geometry);

enum class ProjectionMethod {
  exact,     // constant within each voxel
  slab,      // Joseph, IEEE Trans. Med. Imaging 1 (1982) 192: bilinear in each slice of the ray's main axis
  trilinear  // exact integral of the trilinear field: reference of the interpolating method
};

enum class Basis { water_and_mineral, total };  // total: one plane less; water_mm holds the sum of both

struct PathLengths {
  int width_px = 0, height_px = 0;
  std::vector<float> water_mm, mineral_mm;  // row-major; mineral_mm is empty where only the total was asked for
  std::vector<float> iron_mm;               // empty unless a needle was laid over
  std::vector<float> contrast_mm{};         // empty unless contrast medium was (contrast.h)
};

// One ray's lengths, in double.
struct RayLengths {
  double water_mm = 0.0, mineral_mm = 0.0;
  double total_mm() const noexcept { return water_mm + mineral_mm; }
};

// The oracle: all crossings sorted (exact), two-point Gauss per cell of voxel centres (trilinear), one bilinear
// sample per slice (slab). Any two points; equal points give 0.
RayLengths lengths_between(const volume::Volume& volume, const glm::dvec3& from_lps_mm, const glm::dvec3& to_lps_mm,
                           ProjectionMethod method = ProjectionMethod::exact);

// The segment of one pixel's ray; for parallel rays it starts outside the volume.
struct RaySegment {
  glm::dvec3 from_lps_mm, to_lps_mm;
};
RaySegment ray_of(const XrayGeometry& geometry, const volume::Volume& volume, int column, int row);

// Where a point of space is seen, in pixels (0 = centre of the first); nothing when it does not lie before the
// source.
std::optional<glm::dvec2> pixel_of(const XrayGeometry& geometry, const glm::dvec3& p_lps_mm) noexcept;

PathLengths xray_reference(const volume::Volume& volume, const XrayGeometry& geometry, ProjectionMethod method);

enum class Instructions { scalar, avx2, avx512 };
Instructions best_instructions() noexcept;  // of this processor

struct CpuOptions {
  Basis basis = Basis::water_and_mineral;
  Instructions instructions = best_instructions();
  int threads = 0;  // 0: as many as cores; the answer has the same bits for any number and any instructions
};

// Holds what the packets read: the part of the volume that is not air, and which blocks of it are empty.
class XrayCpu {
 public:
  explicit XrayCpu(const volume::Volume& volume);  // `volume` must outlive it
  ~XrayCpu();
  XrayCpu(XrayCpu&&) noexcept;
  // `geometry` in order (check_geometry). trilinear is the reference's, in double, on threads.
  PathLengths project(const XrayGeometry& geometry, ProjectionMethod method, const CpuOptions& options = {}) const;
  std::size_t bytes() const noexcept;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

// On the context's thread; may outlive the context. Throws base::Failure("gl") when the volume exceeds the largest
// texture (GL_MAX_ARRAY_TEXTURE_LAYERS, 2048 or more, along any axis) or memory. Holds the part that is not air,
// two bytes a voxel for each main axis along which rays have run so far.
class XrayGpu {
 public:
  XrayGpu(gpu::Context& context, const volume::Volume& volume);  // `volume` must outlive it
  ~XrayGpu();
  // exact or slab.
  PathLengths project(const XrayGeometry& geometry, ProjectionMethod method,
                      Basis basis = Basis::water_and_mineral);
  // What the projection itself took on the GPU, by a timer query after everything before had finished; 0 before
  // the first.
  double last_gpu_ms() const noexcept;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace seldinger::imaging
