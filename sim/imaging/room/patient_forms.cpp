#include "sim/imaging/room/patient_forms.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <unordered_map>
#include <utility>

#include "sim/imaging/room/drape.h"
#include "sim/imaging/room/room_model.h"

namespace seldinger::imaging {
namespace {

constexpr auto kNoClass = std::numeric_limits<std::uint32_t>::max();

struct Clusters {
  cases::Mesh mesh;
  std::vector<std::uint32_t> of;  // of each vertex before, its cluster
};

Clusters cluster(const cases::Mesh& mesh, double cube_mm) {
  const std::size_t n = mesh.vertices_lps_mm.size();
  std::vector<std::uint8_t> touches(n, 0);  // 1: skin, 2: cut
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int i = 0; i < 3; ++i)
      touches[mesh.triangles[t][i]] |= mesh.cut[t] != 0 ? std::uint8_t{2} : std::uint8_t{1};
  Clusters c;
  c.of.resize(n);
  std::unordered_map<std::uint64_t, std::uint32_t> cubes;
  std::vector<glm::dvec3> sums;
  std::vector<double> counts;
  for (std::size_t v = 0; v < n; ++v) {
    const glm::dvec3 place(mesh.vertices_lps_mm[v]);
    const glm::ivec3 cube(glm::floor(place / cube_mm) + 500000.0);
    const std::uint64_t key = (static_cast<std::uint64_t>(cube.x) << 42U) ^
                              (static_cast<std::uint64_t>(cube.y) << 22U) ^
                              (static_cast<std::uint64_t>(cube.z) << 2U) ^ (touches[v] == 3 ? 1U : 0U);
    const auto [at, fresh] = cubes.try_emplace(key, static_cast<std::uint32_t>(sums.size()));
    if (fresh) {
      sums.emplace_back(0.0);
      counts.push_back(0.0);
    }
    c.of[v] = at->second;
    sums[at->second] += place;
    counts[at->second] += 1.0;
  }
  for (std::size_t i = 0; i < sums.size(); ++i) c.mesh.vertices_lps_mm.emplace_back(sums[i] / counts[i]);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const glm::uvec3& from = mesh.triangles[t];
    const glm::uvec3 to(c.of[from.x], c.of[from.y], c.of[from.z]);
    if (to.x == to.y || to.y == to.z || to.z == to.x) continue;
    c.mesh.triangles.push_back(to);
    c.mesh.cut.push_back(mesh.cut[t]);
  }
  return c;
}

// Light patches a few centimetres wide: skin is not of one colour. Sums of waves, the same everywhere.
RoomColour skin_paint(const glm::dvec3& p) {
  const double slow = std::sin(p.x / 23.0 + 1.7 * std::sin(p.z / 31.0)) *
                      std::sin(p.y / 27.0 + 1.3 * std::sin(p.x / 37.0)) * std::cos(p.z / 29.0);
  const double quick = std::sin(p.x / 5.1 + p.z / 7.3) * std::sin(p.y / 6.1 - p.z / 4.7);
  const double light = 0.93 + 0.03 * slow + 0.02 * quick, red = 0.02 * slow - 0.01 * quick;
  return {light + red, light, light - 0.5 * red};
}

// Share of the light from all round that reaches a place on the skin: twelve directions, by cosine.
double light_around(const cases::Case& scene, const RoomFrame& frame, const glm::dvec3& place,
                    const glm::dvec3& n) {
  constexpr int kRays = 12;
  constexpr double kReachMm = 160.0, kLiftMm = 1.5;
  if (scene.skin_index.empty()) return 1.0;
  const glm::dvec3 u =
      glm::normalize(glm::cross(std::abs(n.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0), n));
  const glm::dvec3 v = glm::cross(n, u);
  double reached = 0.0;
  for (int i = 0; i < kRays; ++i) {
    // A spiral over the disk, lifted onto the half ball (Malley).
    const double r = std::sqrt((i + 0.5) / kRays), angle = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
    const glm::dvec3 way =
        glm::normalize(r * std::cos(angle) * u + r * std::sin(angle) * v + std::sqrt(1.0 - r * r) * n);
    const glm::dvec3 from = place + kLiftMm * n;
    const double falls = -glm::dot(way, frame.up);
    const double above_mm = glm::dot(from, frame.up) - frame.table_mm;
    if (falls > 0.0 && above_mm < falls * kReachMm) {
      reached += 0.25;  // the table, which gives back some light
      continue;
    }
    const auto hit = scene.skin_index.first_hit(from, way, kReachMm);
    reached += hit ? 0.35 * hit->distance_mm / kReachMm : 1.0;
  }
  return reached / kRays;
}

}  // namespace

PatientForms patient_forms(const cases::Case& scene, const RoomFrame& frame, std::size_t most_triangles) {
  const cases::Mesh& whole = scene.skin;
  PatientForms forms;
  if (whole.triangles.empty()) return forms;
  Clusters shown;
  if (whole.triangles.size() <= most_triangles) {
    shown.mesh = whole;
    for (std::uint32_t v = 0; v < whole.vertices_lps_mm.size(); ++v) shown.of.push_back(v);
  } else {
    double area_mm2 = 0.0;
    for (const glm::uvec3& t : whole.triangles)
      area_mm2 += 0.5 * static_cast<double>(
                            glm::length(glm::cross(whole.vertices_lps_mm[t.y] - whole.vertices_lps_mm[t.x],
                                                   whole.vertices_lps_mm[t.z] - whole.vertices_lps_mm[t.x])));
    // A cube holds some three triangles of a flat surface that lies askew in the grid.
    double cube_mm = std::sqrt(2.5 * area_mm2 / static_cast<double>(most_triangles));
    do {
      shown = cluster(whole, cube_mm);
      cube_mm *= 1.1;
    } while (shown.mesh.triangles.size() > most_triangles);
  }

  // Normals of skin and of cut apart, from all triangles: rims stay sharp, folds that are gone still shade.
  const std::size_t n = shown.mesh.vertices_lps_mm.size();
  std::array<std::vector<glm::dvec3>, 2> normals;
  normals.fill(std::vector<glm::dvec3>(n, glm::dvec3(0.0)));
  for (std::size_t t = 0; t < whole.triangles.size(); ++t) {
    const glm::uvec3& from = whole.triangles[t];
    const glm::dvec3 a(whole.vertices_lps_mm[from.x]), b(whole.vertices_lps_mm[from.y]),
        c(whole.vertices_lps_mm[from.z]);
    for (int i = 0; i < 3; ++i) normals[whole.cut[t] != 0 ? 1 : 0][shown.of[from[i]]] += glm::cross(b - a, c - a);
  }
  std::array<std::vector<std::uint32_t>, 2> here;
  here.fill(std::vector<std::uint32_t>(n, kNoClass));
  for (std::size_t t = 0; t < shown.mesh.triangles.size(); ++t) {
    const std::size_t part = shown.mesh.cut[t] != 0 ? 1 : 0;
    RoomMesh& mesh = part == 0 ? forms.skin : forms.cut_ends;
    glm::uvec3 corners{0U};
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t v = shown.mesh.triangles[t][i];
      if (here[part][v] == kNoClass) {
        const glm::dvec3 place(shown.mesh.vertices_lps_mm[v]), sum = normals[part][v];
        const double length = glm::length(sum);
        const glm::dvec3 normal = length > 0.0 ? sum / length : frame.up;
        here[part][v] = part == 0
                            ? mesh.add(place, normal, skin_paint(place), light_around(scene, frame, place, normal))
                            : mesh.add(place, normal);
      }
      corners[i] = here[part][v];
    }
    // Where clusters fold over, the back would look out.
    const gpu::Vertex *p = &mesh.vertices[corners.x], *q = &mesh.vertices[corners.y],
                      *r = &mesh.vertices[corners.z];
    if (glm::dot(glm::cross(q->place_mm - p->place_mm, r->place_mm - p->place_mm),
                 p->normal + q->normal + r->normal) < 0.0F)
      std::swap(corners.y, corners.z);
    mesh.triangles.push_back(corners);
  }
  if (scene.subject == cases::Subject::phantom) return forms;  // nobody to be covered
  for (const double end : {-1.0, 1.0}) {
    const RoomMesh drape = drape_over(scene.skin, frame, end);
    forms.drapes.append(drape, glm::dmat4(1.0));
  }
  return forms;
}

}  // namespace seldinger::imaging
