// Bodies with known layers, and hands that hold tools against them.
#pragma once

#include <array>
#include <functional>

#include "sim/haptics/two_hands.h"
#include "tests/fixtures/meshes.h"

namespace seldinger::haptics {

using volume::TissueClass;

inline const glm::dvec3 kDown(0.0, 0.0, -1.0);

inline TissueClass of_depth(double deep_mm) {
  return deep_mm < 0.0    ? TissueClass::air
         : deep_mm < 14.0 ? TissueClass::fat
         : deep_mm < 30.0 ? TissueClass::muscle
         : deep_mm < 70.0 ? TissueClass::kidney
         : deep_mm < 90.0 ? TissueClass::fat
                          : TissueClass::bone;
}

// Voxels of 2 mm around what `tissue` says; a needle of 22 gauge.
inline cases::Case scene_of(cases::Mesh skin, const std::function<TissueClass(const glm::dvec3&)>& tissue) {
  cases::Case scene;
  scene.volume = volume::make_volume({60, 60, 70}, glm::dvec3(2.0), glm::dmat3(1.0), {-59.0, -59.0, -119.0});
  for (int k = 0; k < 70; ++k)
    for (int j = 0; j < 60; ++j)
      for (int i = 0; i < 60; ++i) {
        const glm::dvec3 p(-59.0 + 2.0 * i, -59.0 + 2.0 * j, -119.0 + 2.0 * k);
        scene.classes.push_back(tissue(p));
        scene.volume.hu[scene.volume.index(i, j, k)] = scene.classes.back() == TissueClass::bone  ? 900
                                                       : scene.classes.back() == TissueClass::air ? -1000
                                                                                                  : 40;
      }
  scene.skin = std::move(skin);
  scene.skin_index = cases::MeshIndex(scene.skin);
  const cases::Gauge gauge = *cases::gauge(kTableGauge);
  scene.instrument.radius_mm = 0.5 * gauge.outer_mm;
  scene.instrument.inner_radius_mm = 0.5 * gauge.inner_mm;
  return scene;
}

// A body below z = 0, layered along z; a rib 6 mm deep beyond x = 20 mm.
inline const cases::Case& flat_body() {
  static const cases::Case scene =
      scene_of(fixtures::box_mesh({-60.0, -60.0, -120.0}, {60.0, 60.0, 0.0}), [](const glm::dvec3& p) {
        return p.x > 20.0 && p.z < -6.0 && p.z > -16.0 ? TissueClass::bone : of_depth(-p.z);
      });
  return scene;
}

inline std::array<HandSettings, 2> two_omnis() {
  return {HandSettings{*find_arm_model("omni")}, HandSettings{*find_arm_model("omni")}};
}

inline HandInput holding(Tool tool, const glm::dvec3& at_lps_mm, const glm::dvec3& axis = kDown) {
  HandInput input;
  input.tool = tool;
  input.pose.position_lps_mm = at_lps_mm;
  input.pose.axis = axis;
  return input;
}

// A body without symmetry, and its mirror image across x = 0.
inline cases::Case bumpy_body(bool mirrored) {
  cases::Mesh skin = fixtures::sphere_mesh({4.0, -2.0, -50.0}, 45.0, 5, 2.0);
  if (mirrored) {
    for (glm::vec3& vertex : skin.vertices_lps_mm) vertex.x = -vertex.x;
    for (glm::uvec3& triangle : skin.triangles) std::swap(triangle.y, triangle.z);
  }
  return scene_of(std::move(skin), [mirrored](const glm::dvec3& p) {
    const double x = mirrored ? -p.x : p.x;
    return x > 25.0 && p.z > -40.0 ? TissueClass::bone : of_depth(-4.0 - p.z - 0.2 * x);
  });
}

}  // namespace seldinger::haptics
