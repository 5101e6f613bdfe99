// Displacement on the GPU for points alone, without a picture: the formulas of shaders/shared/displacement.glsl.h
// in float. To be compared with sim/tissue's doubles and timed; pictures call the formulas in their own shaders.
#pragma once

#include <glm/vec4.hpp>
#include <memory>
#include <span>
#include <vector>

#include "sim/gpu/context.h"
#include "sim/tissue/displacement.h"

namespace seldinger::imaging {

class DisplacedPointsGpu {
 public:
  // Throws base::Failure("gl"). May outlive the context.
  DisplacedPointsGpu(gpu::Context& context, std::size_t most_points);
  ~DisplacedPointsGpu();

  // xyz in LPS mm, w unused; at most `most_points` (CHECKed). On the context's thread.
  std::vector<glm::vec4> displaced(const tissue::Displacement& displacement,
                                   std::span<const glm::vec4> rest_lps_mm);
  std::vector<glm::vec4> rest_of(const tissue::Displacement& displacement, std::span<const glm::vec4> at_lps_mm,
                                 tissue::InverseSteps steps);

  // GPU's own time of the last call's dispatch, again, without copying: ms.
  double again_ms();

 private:
  struct Parts;
  std::vector<glm::vec4> run(const tissue::Displacement& displacement, std::span<const glm::vec4> points_mm,
                             bool to_rest, tissue::InverseSteps steps);
  std::unique_ptr<Parts> parts_;
};

}  // namespace seldinger::imaging
