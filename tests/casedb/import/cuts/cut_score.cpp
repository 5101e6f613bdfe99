#include "tests/casedb/import/cuts/cut_score.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "casedb/import/skin/surface.h"
#include "sim/base/rng.h"
#include "sim/volume/body/body_mask.h"

namespace seldinger::casedb {
namespace {

constexpr double kOffMm = 10.0, kOffVoxels = 4.0;  // from the field's edge, where skin may be lost

struct Facet {
  glm::dvec3 middle_lps_mm{0.0};
  double area_mm2 = 0.0;
};

Facet facet_of(const cases::Mesh& mesh, const glm::uvec3& t) {
  const glm::dvec3 a(mesh.vertices_lps_mm[t.x]), b(mesh.vertices_lps_mm[t.y]), c(mesh.vertices_lps_mm[t.z]);
  return {(a + b + c) / 3.0, 0.5 * glm::length(glm::cross(b - a, c - a))};
}

// Whether all of the neighbourhood was measured; padding is the fill through and through.
bool well_within(const volume::Volume& field, const glm::dvec3& index, std::int16_t fill) {
  const glm::dvec3 mm = field.spacing_mm;
  const glm::dvec3 off = std::max(kOffMm, kOffVoxels * std::max({mm.x, mm.y, mm.z})) / mm;
  if (!volume::inside(field, index - off) || !volume::inside(field, index + off)) return false;
  // On a ball, in 26 directions.
  for (int z = -1; z <= 1; ++z)
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x) {
        if (x == 0 && y == 0 && z == 0) continue;
        const glm::dvec3 at = index + off * glm::normalize(glm::dvec3(x, y, z));
        const glm::ivec3 voxel = glm::clamp(glm::ivec3(glm::round(at)), glm::ivec3(0), field.size_voxels - 1);
        if (field.at(voxel.x, voxel.y, voxel.z) == fill) return false;
      }
  return true;
}

// Whether a place is inside, by how often a way out of it meets the mesh, asked three ways.
bool is_inside(const cases::MeshIndex& mesh, const glm::dvec3& from) {
  int votes = 0;
  for (const glm::dvec3& way :
       {glm::dvec3(0.36, 0.48, 0.8), glm::dvec3(-0.6, 0.64, -0.48), glm::dvec3(0.8, -0.6, 0.02)}) {
    const glm::dvec3 along = glm::normalize(way);
    int met = 0;
    glm::dvec3 p = from;
    for (auto hit = mesh.first_hit(p, along, 2000.0); hit; hit = mesh.first_hit(p, along, 2000.0), ++met)
      p += (hit->distance_mm + 1e-6) * along;
    votes += met % 2;
  }
  return votes >= 2;
}

}  // namespace

// How many places of the field and around it the nearest triangle's side tells otherwise.
int wrong_sides(const cases::MeshIndex& skin, const volume::Volume& field) {
  constexpr double kAroundMm = 30.0;
  base::Rng rng(17);
  const glm::dvec3 around = kAroundMm / field.spacing_mm, size(field.size_voxels);
  int wrong = 0;
  for (int i = 0; i < kSides; ++i) {
    const glm::dvec3 share(rng.uniform(), rng.uniform(), rng.uniform());
    const glm::dvec3 p(field.lps_from_voxel * glm::dvec4(share * (size + 2.0 * around) - around, 1.0));
    wrong += (skin.closest(p).distance_mm < 0.0) != is_inside(skin, p) ? 1 : 0;
  }
  return wrong;
}

WholePatient::WholePatient(const volume::Volume& volume) : volume_(volume), body_(volume::body_mask(volume)) {
  auto skin = skin_surface(volume, {.decimate_share = 0.0});
  EXPECT_TRUE(skin);
  if (skin) skin_ = std::move(*skin);
  index_ = cases::MeshIndex(skin_);
}

CutScore WholePatient::score(const cases::Mesh& cut, const volume::Volume& field, std::int16_t fill) const {
  CutScore score;
  score.triangles = cut.triangles.size();
  const double voxel_mm = std::max({field.spacing_mm.x, field.spacing_mm.y, field.spacing_mm.z});
  std::uint32_t near = 0;
  for (std::size_t i = 0; i < cut.triangles.size(); ++i) {
    const Facet facet = facet_of(cut, cut.triangles[i]);
    (cut.cut[i] != 0 ? score.cut_mm2 : score.skin_mm2) += facet.area_mm2;
    if (cut.cut[i] != 0) continue;
    const cases::Closest closest = index_.closest_skin(facet.middle_lps_mm, near);
    near = closest.triangle;
    const double off_mm = std::abs(closest.distance_mm);
    if (!(off_mm <= score.farthest_mm)) score.farthest_mm = off_mm;
    if (!(off_mm <= voxel_mm)) score.false_skin_mm2 += facet.area_mm2;
  }
  const cases::MeshIndex cut_index(cut);
  score.wrong_sides = wrong_sides(cut_index, field);
  const glm::dmat4 voxel_from_lps = volume::voxel_from_lps(field);
  double wanted = 0.0, lost = 0.0;
  near = 0;
  for (std::size_t i = 0; i < skin_.triangles.size(); ++i) {
    const Facet facet = facet_of(skin_, skin_.triangles[i]);
    if (skin_.cut[i] != 0 ||
        !well_within(field, glm::dvec3(voxel_from_lps * glm::dvec4(facet.middle_lps_mm, 1.0)), fill))
      continue;
    wanted += facet.area_mm2;
    const cases::Closest closest = cut_index.closest(facet.middle_lps_mm, near);
    near = closest.triangle;
    if (cut_index.cut(closest.triangle) || !(std::abs(closest.distance_mm) <= voxel_mm)) lost += facet.area_mm2;
  }
  score.lost_share = wanted > 0.0 ? lost / wanted : 0.0;
  return score;
}

CutScore expect_true_skin(const WholePatient& whole, const volume::Crop& crop, double most_lost_share,
                          std::int16_t fill) {
  constexpr double kRimShare = 0.003, kRimMm2 = 1000.0;  // where skin meets a cut a triangle is no whole one's
  const volume::Volume field = volume::cropped(whole.volume(), whole.body(), crop, fill);
  const auto skin = skin_surface(field);
  EXPECT_TRUE(skin) << crop.name;
  if (!skin) return {};
  const CutScore score = whole.score(*skin, field, fill);
  EXPECT_LE(score.false_skin_mm2, std::max(kRimShare * score.skin_mm2, kRimMm2))
      << crop.name << ": " << score.farthest_mm << " mm";
  EXPECT_LE(score.lost_share, most_lost_share) << crop.name;
  EXPECT_GT(score.cut_mm2, 0.0) << crop.name;
  EXPECT_LE(score.wrong_sides, 1) << crop.name;  // thinning may leave a sliver folded (docs/decisions/0103)
  return score;
}

}  // namespace seldinger::casedb
