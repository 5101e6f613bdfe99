#include "casedb/import/skin/surface.h"

#include <vtkCellArray.h>
#include <vtkDecimatePro.h>
#include <vtkFloatArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkWindowedSincPolyDataFilter.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>
#include <string>
#include <utility>

#include "casedb/import/skin/closed_mesh.h"
#include "casedb/import/skin/surface_grid.h"
#include "sim/volume/body/field_of_view.h"

namespace seldinger::casedb {
namespace {

// Pass band 0.1 of the windowed sinc keeps what is longer than about 20 edges, with 15 terms and more.
constexpr double kPassBand = 0.1;
constexpr double kOnFaceVoxel = 1e-3, kOffFaceVoxel = 0.05;

cases::Mesh mesh_from(vtkPolyData* poly) {
  cases::Mesh mesh;
  mesh.vertices_lps_mm.resize(static_cast<std::size_t>(poly->GetNumberOfPoints()));
  for (vtkIdType i = 0; i < poly->GetNumberOfPoints(); ++i) {
    std::array<double, 3> at;
    poly->GetPoint(i, at.data());
    mesh.vertices_lps_mm[static_cast<std::size_t>(i)] = {static_cast<float>(at[0]), static_cast<float>(at[1]),
                                                         static_cast<float>(at[2])};
  }
  vtkCellArray* cells = poly->GetPolys();
  mesh.triangles.reserve(static_cast<std::size_t>(cells->GetNumberOfCells()));
  for (vtkIdType i = 0; i < cells->GetNumberOfCells(); ++i) {
    vtkIdType count = 0;
    const vtkIdType* points = nullptr;
    cells->GetCellAtId(i, count, points);
    if (count == 3) mesh.triangles.emplace_back(points[0], points[1], points[2]);
  }
  return mesh;
}

vtkNew<vtkPolyData> poly_from(const cases::Mesh& mesh) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToFloat();
  points->SetNumberOfPoints(static_cast<vtkIdType>(mesh.vertices_lps_mm.size()));
  for (std::size_t i = 0; i < mesh.vertices_lps_mm.size(); ++i) {
    const glm::vec3& p = mesh.vertices_lps_mm[i];
    points->SetPoint(static_cast<vtkIdType>(i), p.x, p.y, p.z);
  }
  vtkNew<vtkCellArray> cells;
  for (const glm::uvec3& triangle : mesh.triangles) {
    const std::array<vtkIdType, 3> ids = {triangle.x, triangle.y, triangle.z};
    cells->InsertNextCell(3, ids.data());
  }
  vtkNew<vtkPolyData> poly;
  poly->SetPoints(points);
  poly->SetPolys(cells);
  return poly;
}

// In grid coordinates.
cases::Mesh iso_surface(const SurfaceGrid& grid, int iso_hu) {
  vtkNew<vtkFloatArray> values;
  values->SetArray(const_cast<float*>(grid.hu.data()), static_cast<vtkIdType>(grid.hu.size()), 1);  // only read
  vtkNew<vtkImageData> image;
  image->SetDimensions(grid.size.x, grid.size.y, grid.size.z);
  image->GetPointData()->SetScalars(values);
  vtkNew<vtkFlyingEdges3D> edges;
  edges->SetInputData(image);
  edges->SetValue(0, iso_hu);
  edges->ComputeNormalsOff();
  edges->ComputeGradientsOff();
  edges->ComputeScalarsOff();
  edges->Update();
  return mesh_from(edges->GetOutput());
}

cases::Mesh decimated(const cases::Mesh& mesh, double share, double feature_degrees) {
  const vtkNew<vtkPolyData> poly = poly_from(mesh);
  vtkNew<vtkDecimatePro> decimate;
  decimate->SetInputData(poly);
  decimate->SetTargetReduction(share);
  decimate->SetFeatureAngle(feature_degrees);
  decimate->PreserveTopologyOn();
  decimate->SplittingOff();
  decimate->BoundaryVertexDeletionOff();
  decimate->Update();
  return mesh_from(decimate->GetOutput());
}

// Bit 2·axis: on the face below the first voxel; bit 2·axis + 1: on that beyond the last.
std::vector<std::uint8_t> faces_of(const cases::Mesh& mesh, const volume::Volume& volume) {
  const glm::dmat4 voxel_from_lps = volume::voxel_from_lps(volume);
  std::vector<std::uint8_t> faces;
  faces.reserve(mesh.vertices_lps_mm.size());
  for (const glm::vec3& p : mesh.vertices_lps_mm) {
    const glm::dvec4 voxel = voxel_from_lps * glm::dvec4(glm::dvec3(p), 1.0);
    unsigned on = 0;
    for (int axis = 0; axis < 3; ++axis) {
      if (std::abs(voxel[axis] + 0.5) < kOnFaceVoxel) on |= 1U << (2 * axis);
      if (std::abs(voxel[axis] - (volume.size_voxels[axis] - 0.5)) < kOnFaceVoxel) on |= 2U << (2 * axis);
    }
    faces.push_back(static_cast<std::uint8_t>(on));
  }
  return faces;
}

bool is_cut(const glm::uvec3& triangle, const std::vector<std::uint8_t>& faces) {
  return (faces[triangle.x] & faces[triangle.y] & faces[triangle.z]) != 0;
}

// Whether the body goes on where a triangle faces: it faces what was not measured, or leads out of the volume where
// the body reaches its face. So are a cap's triangles of which decimation took a corner off the face, and those
// along the edge between two cuts.
bool faces_body(const cases::Mesh& mesh, const glm::uvec3& triangle, const volume::Volume& volume,
                const glm::dmat4& voxel_from_lps, const SurfaceGrid& grid, int iso_hu,
                const std::vector<std::uint8_t>& padding, double step_mm) {
  const glm::dvec3 a(mesh.vertices_lps_mm[triangle.x]), b(mesh.vertices_lps_mm[triangle.y]),
      c(mesh.vertices_lps_mm[triangle.z]), normal = glm::cross(b - a, c - a);
  const double length = glm::length(normal);
  if (!(length > 0.0)) return false;
  for (int steps = 1; steps <= 3; ++steps) {
    const glm::dvec3 p = (a + b + c) / 3.0 + normal / length * (0.5 * steps * step_mm);
    const glm::dvec3 index(voxel_from_lps * glm::dvec4(p, 1.0));
    const glm::ivec3 voxel = glm::clamp(glm::ivec3(glm::round(index)), glm::ivec3(0), volume.size_voxels - 1);
    if (!padding.empty() && padding[volume.index(voxel.x, voxel.y, voxel.z)] != 0) return true;
    if (!volume::inside(volume, index)) return grid.hu_at(index) > static_cast<float>(iso_hu);
  }
  return false;
}

void mark_cuts(const volume::Volume& volume, const SurfaceGrid& grid, const SurfaceOptions& options,
               cases::Mesh& mesh) {
  const std::vector<std::uint8_t> faces = faces_of(mesh, volume), padding = volume::padding_of(volume);
  const glm::dmat4 voxel_from_lps = volume::voxel_from_lps(volume);
  const double step_mm =
      std::max({options.target_spacing_mm, volume.spacing_mm.x, volume.spacing_mm.y, volume.spacing_mm.z});
  mesh.cut.reserve(mesh.triangles.size());
  for (const glm::uvec3& triangle : mesh.triangles) {
    const bool cut = is_cut(triangle, faces) ||
                     faces_body(mesh, triangle, volume, voxel_from_lps, grid, options.iso_hu, padding, step_mm);
    mesh.cut.push_back(cut ? 1 : 0);
  }
}

// Moves the vertices of the skin; caps are left out, so that their right-angled rim, an edge the body does not
// have, neither rounds nor rings. The rim itself is smoothed along its line.
void smooth_skin(cases::Mesh& mesh, const std::vector<std::uint8_t>& faces, int iterations) {
  cases::Mesh skin;
  skin.vertices_lps_mm = mesh.vertices_lps_mm;
  for (const glm::uvec3& triangle : mesh.triangles)
    if (!is_cut(triangle, faces)) skin.triangles.push_back(triangle);
  if (skin.triangles.empty()) return;
  const vtkNew<vtkPolyData> poly = poly_from(skin);
  vtkNew<vtkWindowedSincPolyDataFilter> smooth;
  smooth->SetInputData(poly);
  smooth->SetNumberOfIterations(iterations);
  smooth->SetPassBand(kPassBand);
  smooth->NormalizeCoordinatesOn();
  smooth->BoundarySmoothingOn();
  smooth->FeatureEdgeSmoothingOff();
  smooth->NonManifoldSmoothingOff();
  smooth->Update();
  CHECK(static_cast<std::size_t>(smooth->GetOutput()->GetNumberOfPoints()) == mesh.vertices_lps_mm.size());
  mesh.vertices_lps_mm = mesh_from(smooth->GetOutput()).vertices_lps_mm;
}

// After smoothing: what lay on a face of the volume goes back there, and nothing else reaches a face.
void settle_on_faces(cases::Mesh& mesh, const std::vector<std::uint8_t>& faces, const volume::Volume& volume) {
  const glm::dmat4 voxel_from_lps = volume::voxel_from_lps(volume);
  for (std::size_t i = 0; i < faces.size(); ++i) {
    glm::dvec4 voxel = voxel_from_lps * glm::dvec4(glm::dvec3(mesh.vertices_lps_mm[i]), 1.0);
    for (int axis = 0; axis < 3; ++axis) {
      const double low = -0.5, high = volume.size_voxels[axis] - 0.5;
      const bool on_low = (faces[i] & 1U << (2 * axis)) != 0, on_high = (faces[i] & 2U << (2 * axis)) != 0;
      if (!on_low && !on_high) voxel[axis] = std::clamp(voxel[axis], low + kOffFaceVoxel, high - kOffFaceVoxel);
      if (on_low) voxel[axis] = low;
      if (on_high) voxel[axis] = high;
    }
    mesh.vertices_lps_mm[i] = glm::vec3(glm::dvec3(volume.lps_from_voxel * voxel));
  }
}

glm::dvec3 normal_of(const std::vector<glm::vec3>& vertices, const glm::uvec3& triangle) {
  const glm::dvec3 a(vertices[triangle.x]), b(vertices[triangle.y]), c(vertices[triangle.z]);
  return glm::cross(b - a, c - a);
}

// The vertices within a cap stay where they are, and where a corner of its rim is smoothed away over some of them
// the cap lies double: a sheet in the air, under which all seems to be in the body. There the rim goes back.
void unfold_caps(const std::vector<glm::vec3>& before, const std::vector<std::uint8_t>& faces, cases::Mesh& mesh) {
  constexpr int kHalfWays = 4, kMostRounds = 100;
  std::vector<glm::uvec3> caps;
  for (const glm::uvec3& triangle : mesh.triangles)
    if (is_cut(triangle, faces)) caps.push_back(triangle);
  for (int round = 0; round < kMostRounds; ++round) {
    std::vector<std::uint8_t> goes_back(before.size(), 0);
    bool folded = false;
    for (const glm::uvec3& triangle : caps) {
      const glm::dvec3 was = normal_of(before, triangle);
      if (!(glm::dot(was, was) > 0.0) || glm::dot(was, normal_of(mesh.vertices_lps_mm, triangle)) > 0.0) continue;
      for (int corner = 0; corner < 3; ++corner) goes_back[triangle[corner]] = 1;
      folded = true;
    }
    if (!folded) return;
    for (std::size_t i = 0; i < before.size(); ++i)
      if (goes_back[i] != 0)
        mesh.vertices_lps_mm[i] = round < kHalfWays ? 0.5F * (mesh.vertices_lps_mm[i] + before[i]) : before[i];
  }
}

// Whether a cap lies double somewhere: a triangle of it, no sliver, faces into the volume.
bool has_folded_cap(const cases::Mesh& mesh, const volume::Volume& volume) {
  constexpr double kSliverMm2 = 1e-4;
  const std::vector<std::uint8_t> faces = faces_of(mesh, volume);
  const glm::dmat3 outward = glm::transpose(glm::inverse(glm::dmat3(volume.lps_from_voxel)));
  return std::any_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const glm::uvec3& triangle) {
    const unsigned on = faces[triangle.x] & faces[triangle.y] & faces[triangle.z];
    for (int axis = 0; axis < 3; ++axis) {
      const double out_mm2 = glm::dot(glm::normalize(outward[axis]), normal_of(mesh.vertices_lps_mm, triangle));
      const bool low = (on & 1U << (2 * axis)) != 0, high = (on & 2U << (2 * axis)) != 0;
      if ((low && out_mm2 > kSliverMm2) || (high && out_mm2 < -kSliverMm2)) return true;
    }
    return false;
  });
}

// False: nothing could be taken away. On real skin VTK's usual 15° joins two sheets along an edge now and then, in
// spite of PreserveTopology; from 45° on it did not. Should it ever, other ways are tried before none.
bool take_away(double share, const volume::Volume& volume, cases::Mesh& mesh) {
  for (const auto& [part, feature_degrees] : {std::pair{1.0, 45.0}, std::pair{1.0, 90.0}, std::pair{0.7, 45.0}}) {
    cases::Mesh fewer = decimated(mesh, part * share, feature_degrees);
    if (!is_closed(fewer) || fewer.triangles.size() == mesh.triangles.size()) continue;
    if (has_folded_cap(fewer, volume) && !has_folded_cap(mesh, volume)) continue;
    mesh = std::move(fewer);
    return true;
  }
  return false;
}

// A large share not at once: the more goes in one pass, the sooner two sheets are joined.
void thin(double share, const volume::Volume& volume, cases::Mesh& mesh) {
  constexpr double kMostAtOnce = 0.7, kWorthIt = 0.02;
  if (!(share > 0.0)) return;
  const double wanted = (1.0 - share) * static_cast<double>(mesh.triangles.size());
  bool took = take_away(std::min(share, kMostAtOnce), volume, mesh);
  while (took && share > kMostAtOnce) {
    const double further = 1.0 - wanted / static_cast<double>(mesh.triangles.size());
    took = further > kWorthIt && take_away(std::min(further, kMostAtOnce), volume, mesh);
  }
}

}  // namespace

base::Result<cases::Mesh> skin_surface(const volume::Volume& volume, const SurfaceOptions& options,
                                       double* taken_share) {
  const base::Error no_body{"no_body", "nothing in the volume is denser than air: there is no skin"};
  vtkObject::GlobalWarningDisplayOff();
  const SurfaceGrid grid = surface_grid(volume, options.iso_hu, options.target_spacing_mm);
  if (grid.hu.empty()) return no_body;
  cases::Mesh full = largest_piece(iso_surface(grid, options.iso_hu));
  for (glm::vec3& p : full.vertices_lps_mm)
    p = glm::vec3(glm::dvec3(volume.lps_from_voxel * glm::dvec4(grid.voxel_at(glm::dvec3(p)), 1.0)));
  if (full.triangles.empty()) return no_body;
  CHECK(is_closed(full));
  if (signed_volume_mm3(full) < 0.0)
    for (glm::uvec3& triangle : full.triangles) std::swap(triangle.y, triangle.z);

  if (options.smoothing_iterations > 0) {
    const std::vector<std::uint8_t> faces = faces_of(full, volume);
    const std::vector<glm::vec3> before = full.vertices_lps_mm;
    smooth_skin(full, faces, options.smoothing_iterations);
    settle_on_faces(full, faces, volume);
    unfold_caps(before, faces, full);
  }
  cases::Mesh mesh = std::move(full);
  const auto before = static_cast<double>(mesh.triangles.size());
  thin(options.decimate_share, volume, mesh);
  if (taken_share != nullptr) *taken_share = 1.0 - static_cast<double>(mesh.triangles.size()) / before;
  CHECK(is_closed(mesh));
  mark_cuts(volume, grid, options, mesh);
  return mesh;
}

std::optional<base::Problem> cut_body(const cases::Mesh& skin, const volume::Volume& volume) {
  // Of the voxel axes nearest to the patient's: −x is right, −y is front, −z is feet (LPS).
  static constexpr const char* kSides[] = {"right", "left", "front", "back", "feet", "head"};
  constexpr double kLeastMm2 = 100.0;
  const std::vector<std::uint8_t> faces = faces_of(skin, volume);
  std::array<double, 6> side_mm2{};
  double skin_mm2 = 0.0, elsewhere_mm2 = 0.0, all_mm2 = 0.0;
  for (std::size_t i = 0; i < skin.triangles.size(); ++i) {
    const glm::uvec3& t = skin.triangles[i];
    const glm::dvec3 a(skin.vertices_lps_mm[t.x]), b(skin.vertices_lps_mm[t.y]), c(skin.vertices_lps_mm[t.z]);
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double area_mm2 = 0.5 * glm::length(normal);
    all_mm2 += area_mm2;
    if (skin.cut[i] == 0) {
      skin_mm2 += area_mm2;
    } else if (!is_cut(t, faces)) {
      elsewhere_mm2 += area_mm2;
    } else {
      int axis = 0;
      for (int other = 1; other < 3; ++other)
        if (std::abs(normal[other]) > std::abs(normal[axis])) axis = other;
      side_mm2[static_cast<std::size_t>(2 * axis + (normal[axis] > 0.0 ? 1 : 0))] += area_mm2;
    }
  }
  std::string where;
  const auto add = [&](const std::string& text) { where += (where.empty() ? "" : ", ") + text; };
  bool beside = elsewhere_mm2 >= kLeastMm2;
  for (std::size_t side = 0; side < side_mm2.size(); ++side) {
    if (side_mm2[side] < kLeastMm2) continue;
    beside = beside || side < 4;
    add(kSides[side]);
  }
  if (elsewhere_mm2 >= kLeastMm2) add("edge of what was reconstructed");
  if (!beside) return std::nullopt;  // any CT of a trunk ends towards head and feet
  return base::Problem{"cut_body", "the CT ends within the patient (" + where + "): there is no skin there, and " +
                                       std::to_string(std::lround(100.0 * skin_mm2 / all_mm2)) +
                                       " % of the surface is skin"};
}

}  // namespace seldinger::casedb
