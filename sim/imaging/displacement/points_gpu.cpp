#include "sim/imaging/displacement/points_gpu.h"

#include <cstddef>
#include <string_view>

#include "sim/base/check.h"
#include "sim/base/embedded.h"
#include "sim/gpu/buffer.h"
#include "sim/gpu/program.h"
#include "sim/gpu/timer.h"

namespace seldinger::embedded {
std::span<const base::EmbeddedFile> displacement_shaders();
}

namespace seldinger::imaging {
namespace {

using shaders::Displacement;
using shaders::DisplacementPoints;
using shaders::DisplacementSource;
static_assert(offsetof(Displacement, breath_end) == 16);
static_assert(offsetof(Displacement, source) == 32);
static_assert(sizeof(DisplacementSource) == 64);
static_assert(sizeof(Displacement) == 4128);

constexpr int kGroup = 64;  // local_size_x of the shader
constexpr int kSourcesBinding = 0, kParametersBinding = 1, kGivenBinding = 2, kFoundBinding = 3;

}  // namespace

struct DisplacedPointsGpu::Parts {
  Parts(gpu::Context& context, std::size_t most_points)
      : points(context, embedded::displacement_shaders().front().content),
        sources(context, gpu::BufferUse::uniform, sizeof(Displacement)),
        parameters(context, gpu::BufferUse::uniform, sizeof(DisplacementPoints)),
        given(context, gpu::BufferUse::storage, most_points * sizeof(glm::vec4)),
        found(context, gpu::BufferUse::storage, most_points * sizeof(glm::vec4)),
        timer(context) {}

  gpu::Program points;
  gpu::Buffer sources, parameters, given, found;
  gpu::Timer timer;
  int groups = 0;
};

DisplacedPointsGpu::DisplacedPointsGpu(gpu::Context& context, std::size_t most_points)
    : parts_(std::make_unique<Parts>(context, most_points)) {}

DisplacedPointsGpu::~DisplacedPointsGpu() = default;

std::vector<glm::vec4> DisplacedPointsGpu::displaced(const Displacement& displacement,
                                                     std::span<const glm::vec4> rest_lps_mm) {
  return run(displacement, rest_lps_mm, false, {});
}

std::vector<glm::vec4> DisplacedPointsGpu::rest_of(const Displacement& displacement,
                                                   std::span<const glm::vec4> at_lps_mm,
                                                   tissue::InverseSteps steps) {
  return run(displacement, at_lps_mm, true, steps);
}

double DisplacedPointsGpu::again_ms() {
  parts_->timer.start();
  parts_->points.dispatch(parts_->groups, 1, 1);
  return parts_->timer.stop_ms();
}

std::vector<glm::vec4> DisplacedPointsGpu::run(const Displacement& displacement,
                                               std::span<const glm::vec4> points_mm, bool to_rest,
                                               tissue::InverseSteps steps) {
  CHECK(points_mm.size_bytes() <= parts_->given.size());
  const DisplacementPoints parameters{static_cast<int>(points_mm.size()), to_rest ? 1 : 0, steps.fixed_point,
                                      steps.newton};
  parts_->sources.write(std::as_bytes(std::span(&displacement, 1)));
  parts_->parameters.write(std::as_bytes(std::span(&parameters, 1)));
  parts_->given.write(std::as_bytes(points_mm));
  parts_->sources.bind(kSourcesBinding);
  parts_->parameters.bind(kParametersBinding);
  parts_->given.bind(kGivenBinding);
  parts_->found.bind(kFoundBinding);
  parts_->groups = (parameters.count + kGroup - 1) / kGroup;
  parts_->points.dispatch(parts_->groups, 1, 1);
  std::vector<glm::vec4> found(points_mm.size());
  parts_->found.read(std::as_writable_bytes(std::span(found)));
  return found;
}

}  // namespace seldinger::imaging
