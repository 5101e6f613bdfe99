#include "tests/casedb/import/cuts/cut_score.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace seldinger::casedb {
namespace {

struct Facet {
  glm::dvec3 middle_lps_mm{0.0};
  double area_mm2 = 0.0;
};

Facet facet_of(const cases::Mesh& mesh, const glm::uvec3& t) {
  const glm::dvec3 a(mesh.vertices_lps_mm[t.x]), b(mesh.vertices_lps_mm[t.y]), c(mesh.vertices_lps_mm[t.z]);
  return {(a + b + c) / 3.0, 0.5 * glm::length(glm::cross(b - a, c - a))};
}

// Whether all of the neighbourhood was measured; padding is kAirHu through and through.
bool well_within(const volume::Volume& field, const glm::dvec3& index) {
  constexpr double kOffMm = 10.0;
  const glm::dvec3 off = kOffMm / field.spacing_mm;
  if (!volume::inside(field, index - off) || !volume::inside(field, index + off)) return false;
  int measured = 0, all = 0;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      glm::dvec3 at = index;
      at[axis] += side * off[axis];
      const glm::ivec3 voxel = glm::clamp(glm::ivec3(glm::round(at)), glm::ivec3(0), field.size_voxels - 1);
      measured += field.at(voxel.x, voxel.y, voxel.z) != volume::kAirHu ? 1 : 0;
      ++all;
    }
  return measured == all;
}

}  // namespace

CutScore score_cut(const cases::Mesh& whole, const cases::MeshIndex& whole_index, const cases::Mesh& cut,
                   const volume::Volume& field) {
  CutScore score;
  score.triangles = cut.triangles.size();
  const double voxel_mm = std::max({field.spacing_mm.x, field.spacing_mm.y, field.spacing_mm.z});
  std::uint32_t near = 0;
  for (std::size_t i = 0; i < cut.triangles.size(); ++i) {
    const Facet facet = facet_of(cut, cut.triangles[i]);
    (cut.cut[i] != 0 ? score.cut_mm2 : score.skin_mm2) += facet.area_mm2;
    if (cut.cut[i] != 0) continue;
    const cases::Closest closest = whole_index.closest_skin(facet.middle_lps_mm, near);
    near = closest.triangle;
    const double off_mm = std::abs(closest.distance_mm);
    if (!(off_mm <= score.farthest_mm)) score.farthest_mm = off_mm;
    if (getenv("DBG") && off_mm > 8 * voxel_mm) std::printf("  %.0f %.0f %.0f off %.1f\n", facet.middle_lps_mm.x, facet.middle_lps_mm.y, facet.middle_lps_mm.z, off_mm);
    if (!(off_mm <= voxel_mm)) score.false_skin_mm2 += facet.area_mm2;
  }
  const cases::MeshIndex cut_index(cut);
  const glm::dmat4 voxel_from_lps = volume::voxel_from_lps(field);
  double wanted = 0.0, lost = 0.0;
  near = 0;
  for (std::size_t i = 0; i < whole.triangles.size(); ++i) {
    const Facet facet = facet_of(whole, whole.triangles[i]);
    if (whole.cut[i] != 0 || !well_within(field, glm::dvec3(voxel_from_lps * glm::dvec4(facet.middle_lps_mm, 1.0))))
      continue;
    wanted += facet.area_mm2;
    const cases::Closest closest = cut_index.closest(facet.middle_lps_mm, near);
    near = closest.triangle;
    if (cut_index.cut(closest.triangle) || !(std::abs(closest.distance_mm) <= voxel_mm)) lost += facet.area_mm2;
  }
  score.lost_share = wanted > 0.0 ? lost / wanted : 0.0;
  return score;
}

}  // namespace seldinger::casedb
