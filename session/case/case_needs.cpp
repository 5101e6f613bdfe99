#include "session/case/case_needs.h"

#include <algorithm>
#include <chrono>
#include <glm/geometric.hpp>

#include "sim/base/check.h"
#include "sim/base/rng.h"
#include "sim/engine/moving_tissue.h"
#include "sim/tissue/blood_flow.h"

namespace seldinger::session {
namespace {

constexpr int kPoints = 20000, kTimes = 5;
constexpr double kAboutMm = 60.0;

// Every source at work: the probe pressed 8 mm in at the skin nearest the target, the needle 40 mm in.
tissue::Displacement all_at_work(const cases::Case& scene, const engine::MovingTissue& moving,
                                 const glm::dvec3& middle) {
  haptics::HandStates hands{};
  if (!scene.skin_index.empty()) {
    const glm::dvec3 at = scene.skin_index.closest_skin(middle).point_lps_mm;
    const glm::dvec3 way = middle - at;
    const glm::dvec3 inward = glm::length(way) > 0.0 ? glm::normalize(way) : glm::dvec3(0.0, 1.0, 0.0);
    hands[0].tool = haptics::Tool::probe;
    hands[0].probe.press = {.at_lps_mm = at, .inward = inward, .radius_mm = 20.0, .depth_mm = 8.0};
    hands[1].tool = haptics::Tool::needle;
    hands[1].needle.drag = {
        .entry_lps_mm = at, .direction = inward, .cut_mm = 40.0, .tip_n = 0.5, .tip_mm = 1.0, .shaft_mm = 0.5};
  }
  if (!moving.organs().empty()) {
    hands[1].needle.drag.organ = moving.organs()[0].tissue;
    hands[1].needle.drag.organ_n = 0.5;
  }
  cases::State state;
  state.breath.level = scene.breathing ? 1.0 - scene.breathing->ct_level : 1.0;
  return moving.seen(state, hands);
}

template <typename Ask>
double ns_of(const std::vector<glm::dvec3>& points, const Ask& ask) {
  double least_ns = 1e300, sum = 0.0;
  for (int i = 0; i < kTimes; ++i) {
    const auto start = std::chrono::steady_clock::now();
    for (const glm::dvec3& point : points) sum += ask(point).x;
    const auto ns = std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count();
    least_ns = std::min(least_ns, ns / static_cast<double>(points.size()));
  }
  CHECK(sum == sum);  // so that nothing is left out
  return least_ns;
}

}  // namespace

CaseNeeds needs_of_case(const cases::Case& scene) {
  CaseNeeds needs;
  const auto hold = [&](const char* what, std::size_t bytes) {
    if (bytes > 0) needs.held.push_back({what, bytes});
  };
  hold("volume", scene.volume.hu.size() * sizeof scene.volume.hu[0]);
  hold("tissue classes", scene.classes.size() * sizeof(volume::TissueClass));
  hold("echogenicity", scene.echogenicity.size());
  hold("skin",
       scene.skin.vertices_lps_mm.size() * sizeof(glm::vec3) + scene.skin.triangles.size() * sizeof(glm::uvec3));

  if (scene.picture.modality == cases::Modality::ultrasound) {
    const tissue::BloodFlow flow(scene.structures);
    needs.flowing = flow.names();
    needs.unknown_flow.assign(flow.unknown().begin(), flow.unknown().end());
  }

  const engine::MovingTissue moving(scene);
  const auto add = [&](const char* kind, const std::string& name = {}) {
    needs.sources.push_back({kind, name, sizeof(shaders::DisplacementSource)});
  };
  if (scene.yields)
    for (const char* kind : {"press", "needle tip", "needle shaft"}) add(kind);
  if (!moving.organs().empty()) add("organ", "liver, kidney or spleen, as a whole");
  for (const tissue::CompressibleVein& vein : moving.veins()) add("vein", vein.name);
  if (moving.breathes()) add("breath");
  static_assert(kMostMotionSources == shaders::kMostDisplacementSources);
  CHECK(needs.sources.size() <= static_cast<std::size_t>(kMostMotionSources));
  if (!moving.moves()) return needs;

  needs.displacement_bytes = sizeof(tissue::Displacement);
  const glm::dvec3 middle =
      scene.lesions.empty()
          ? glm::dvec3(scene.volume.lps_from_voxel * glm::dvec4(glm::dvec3(scene.volume.size_voxels) / 2.0, 1.0))
          : scene.lesions[0].center_lps_mm;
  const tissue::Displacement displacement = all_at_work(scene, moving, middle);
  base::Rng rng(1);
  std::vector<glm::dvec3> points(kPoints);
  for (glm::dvec3& point : points)
    for (int axis = 0; axis < 3; ++axis) point[axis] = middle[axis] + kAboutMm * (2.0 * rng.uniform() - 1.0);
  needs.there_ns = ns_of(points, [&](const glm::dvec3& point) { return tissue::displaced(displacement, point); });
  needs.back_ns = ns_of(points, [&](const glm::dvec3& point) { return tissue::rest_of(displacement, point); });
  return needs;
}

}  // namespace seldinger::session
