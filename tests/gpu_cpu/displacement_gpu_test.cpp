// Displacement on the GPU (float) against the CPU's doubles from the same formulas, and the block's offsets.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "sim/base/embedded.h"
#include "sim/base/rng.h"
#include "sim/imaging/displacement/points_gpu.h"
#include "tests/gpu_cpu/shader_offsets.h"

namespace seldinger::embedded {
std::span<const base::EmbeddedFile> displacement_shaders();
}

namespace seldinger::imaging {
namespace {

using tissue::Causes;
using tissue::Displacement;
using tissue::displacement_of;

constexpr std::size_t kPoints = 100000;

// A trunk around (−20, 60, 700): not near the origin, where float keeps more digits than it does in a patient.
const glm::dvec3 kMiddle(-20.0, 60.0, 700.0);

struct Scene {
  std::array<tissue::SkinPress, 2> presses;
  std::array<tissue::SqueezedVein, 11> veins;
  tissue::NeedleDrag needle;
  tissue::Breath breath, sliding;
};

// A wall that is nowhere round and nowhere upright.
const tissue::CavityWall& wall() {
  static const tissue::CavityWall made = [] {
    tissue::CavityWall wall;
    wall.axis_lps_mm = kMiddle - glm::dvec3(0, 10, 240);
    wall.step_mm = 20.0;
    base::Rng rng(3);
    for (float& radius_mm : wall.radius_mm) radius_mm = static_cast<float>(90.0 + 8.0 * rng.uniform());
    return wall;
  }();
  return made;
}

Scene scene() {
  Scene s;
  s.presses[0] = {.at_lps_mm = kMiddle + glm::dvec3(0, -110, -60),
                  .inward = {0, 1, 0},
                  .radius_mm = 20.0,
                  .depth_mm = 8.0,
                  .per_bone_mm = 1.0 / 35.0};
  s.presses[1] = {.at_lps_mm = kMiddle + glm::dvec3(70, -90, -90),
                  .inward = {-0.6, 0.8, 0},
                  .radius_mm = 20.0,
                  .depth_mm = 12.0};
  for (std::size_t i = 0; i < s.veins.size(); ++i) {
    const double x = -60.0 + 12.0 * static_cast<double>(i);
    s.veins[i] = {kMiddle + glm::dvec3(x, 20, -40), kMiddle + glm::dvec3(x, 25, -160), 3.0, 0.5};
  }
  s.needle = {.entry_lps_mm = kMiddle + glm::dvec3(40, -105, -60),
              .direction = glm::normalize(glm::dvec3(-0.3, 1.0, 0.1)),
              .cut_mm = 60.0,
              .tip_n = 1.2,
              .tip_mm = 4.0,
              .shaft_mm = 3.0};
  s.breath = {{.middle_x_mm = kMiddle.x,
               .half_width_mm = 170.0,
               .back_y_mm = kMiddle.y + 110.0,
               .depth_mm = 220.0,
               .dome_z_mm = kMiddle.z},
              {2.0, 15.0, 16.0}};
  s.sliding = s.breath;
  s.sliding.wall = &wall();
  return s;
}

// A third anywhere in the trunk, a third where the heads press, a third along the needle.
std::vector<glm::vec4> places(const Scene& s, std::uint64_t seed) {
  base::Rng rng(seed);
  const auto spread = [&](double mm) {
    return mm * glm::dvec3(2.0 * rng.uniform() - 1.0, 2.0 * rng.uniform() - 1.0, 2.0 * rng.uniform() - 1.0);
  };
  std::vector<glm::vec4> made;
  for (std::size_t i = 0; i < kPoints; ++i) {
    glm::dvec3 at_mm = kMiddle + glm::dvec3(1, 1, 2) * spread(120.0);
    if (i % 3 == 1) at_mm = s.presses[i % 2].at_lps_mm + spread(i % 5 == 0 ? 3.0 : 30.0);
    if (i % 3 == 2)
      at_mm = s.needle.entry_lps_mm + s.needle.direction * (80.0 * rng.uniform() - 10.0) +
              spread(i % 5 == 0 ? 0.5 : 8.0);
    made.push_back(glm::vec4(glm::dvec4(at_mm, 0.0)));
  }
  return made;
}

double most_apart_mm(const std::vector<glm::vec4>& on_gpu, const std::vector<glm::dvec3>& on_cpu) {
  double most = 0.0;
  for (std::size_t i = 0; i < on_gpu.size(); ++i) {
    const double apart = glm::length(glm::dvec3(on_gpu[i]) - on_cpu[i]);
    if (!(apart <= most)) most = apart;  // NaN counts
  }
  return most;
}

class DisplacementOnGpu : public testing::Test {
 protected:
  DisplacementOnGpu() : gpu_(context_, kPoints) {}

  // x of X.
  double apart_mm(const Displacement& displacement, std::uint64_t seed) {
    const std::vector<glm::vec4> rest_mm = places(scene(), seed);
    std::vector<glm::dvec3> on_cpu;
    for (const glm::vec4& place : rest_mm) on_cpu.push_back(tissue::displaced(displacement, glm::dvec3(place)));
    return most_apart_mm(gpu_.displaced(displacement, rest_mm), on_cpu);
  }

  gpu::Context context_;
  DisplacedPointsGpu gpu_;
};

// The goal: at most 1e-3 mm on 10^5 points.
TEST_F(DisplacementOnGpu, IsTheCpusToAMicron) {
  const Scene s = scene();
  const std::array<std::pair<const char*, Displacement>, 8> each{
      {{"press over bone", displacement_of({.presses = {&s.presses[0], 1}})},
       {"press", displacement_of({.presses = {&s.presses[1], 1}})},
       {"needle", displacement_of({.needle = s.needle})},
       {"veins", displacement_of({.veins = s.veins})},
       {"breath", displacement_of({.breath = s.breath})},
       {"sliding breath", displacement_of({.breath = s.sliding})},
       {"organ", displacement_of({.needle = s.needle,
                                  .organ = tissue::PushedOrgan{kMiddle + glm::dvec3(10, -20, -50),
                                                               35.0,
                                                               kMiddle + glm::dvec3(22, -48, -54),
                                                               {-0.6, 2.0, 0.2}}})},
       {"all", displacement_of({.presses = s.presses, .needle = s.needle, .veins = s.veins, .breath = s.breath})}}};
  for (std::size_t i = 0; i < each.size(); ++i) {
    const double apart = apart_mm(each[i].second, i + 1);
    EXPECT_LE(apart, 1e-3) << each[i].first;
    RecordProperty(std::string("apart_") + std::to_string(i), std::to_string(apart));
  }
}

// Picture's samples: the inverse in float is the inverse in double, and both are that of the points they came from.
TEST_F(DisplacementOnGpu, ComesBackAsTheCpuDoes) {
  const Scene s = scene();
  const Displacement press = displacement_of({.presses = {&s.presses[1], 1}});
  const std::vector<glm::vec4> rest_mm = places(s, 9);
  for (const tissue::InverseSteps steps : {tissue::InverseSteps{4, 0}, tissue::InverseSteps{3, 1}, {3, 2}}) {
    std::vector<glm::vec4> at_mm;
    std::vector<glm::dvec3> on_cpu;
    for (const glm::vec4& place : rest_mm) {
      at_mm.push_back(glm::vec4(glm::dvec4(tissue::displaced(press, glm::dvec3(place)), 0.0)));
      on_cpu.push_back(tissue::rest_of(press, glm::dvec3(at_mm.back()), steps));
    }
    EXPECT_LE(most_apart_mm(gpu_.rest_of(press, at_mm, steps), on_cpu), 5e-3) << steps.fixed_point << steps.newton;
  }
}

TEST_F(DisplacementOnGpu, AStillPatientStaysToTheBit) {
  const std::vector<glm::vec4> at_mm = places(scene(), 10);
  EXPECT_EQ(gpu_.displaced({}, at_mm), at_mm);
  EXPECT_EQ(gpu_.rest_of({}, at_mm, {}), at_mm);
}

TEST(DisplacementParameters, HaveTheOffsetsOfTheShadersBlocks) {
  const auto files = embedded::displacement_shaders();
  ASSERT_EQ(files.size(), 1U);
  using D = shaders::Displacement;
  using P = shaders::DisplacementPoints;
  const std::map<std::string, std::size_t> counts{
      {"contact_end", offsetof(D, contact_end)}, {"tip_end", offsetof(D, tip_end)},
      {"shaft_end", offsetof(D, shaft_end)},     {"organ_end", offsetof(D, organ_end)},
      {"vein_end", offsetof(D, vein_end)},       {"breath_end", offsetof(D, breath_end)},
      {"wall_mm", offsetof(D, wall_mm)}};
  EXPECT_EQ(offsets_from_compiler(files[0], "displacement"), counts);
  // Of the first source; the array's stride is its size, a multiple of 16.
  using S = shaders::DisplacementSource;
  const std::map<std::string, std::size_t> source{{"place_mm", offsetof(D, source) + offsetof(S, place_mm)},
                                                  {"along", offsetof(D, source) + offsetof(S, along)},
                                                  {"size_mm", offsetof(D, source) + offsetof(S, size_mm)},
                                                  {"amount", offsetof(D, source) + offsetof(S, amount)}};
  EXPECT_EQ(offsets_from_compiler(files[0], "displacement.source"), source);
  EXPECT_EQ(sizeof(S) % 16, 0U);
  const std::map<std::string, std::size_t> ours{{"count", offsetof(P, count)},
                                                {"to_rest", offsetof(P, to_rest)},
                                                {"fixed_point_steps", offsetof(P, fixed_point_steps)},
                                                {"newton_steps", offsetof(P, newton_steps)}};
  EXPECT_EQ(offsets_from_compiler(files[0]), ours);
}

}  // namespace
}  // namespace seldinger::imaging
