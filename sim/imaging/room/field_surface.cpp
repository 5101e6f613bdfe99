#include "sim/imaging/room/field_surface.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <variant>

namespace seldinger::imaging {
namespace {

constexpr std::uint32_t kNone = 0xffffffff;
constexpr double kVoxelSetMm = 3.0;

std::size_t index(const glm::ivec3& size, int i, int j, int k) {
  return (static_cast<std::size_t>(k) * static_cast<std::size_t>(size.y) + static_cast<std::size_t>(j)) *
             static_cast<std::size_t>(size.x) +
         static_cast<std::size_t>(i);
}

// With a border of one node below every value, so that surfaces close.
Field bordered(const Field& field, float below) {
  Field wide;
  wide.size = field.size + 2;
  wide.values.assign(index(wide.size, 0, 0, wide.size.z), below);
  for (int k = 0; k < field.size.z; ++k)
    for (int j = 0; j < field.size.y; ++j)
      for (int i = 0; i < field.size.x; ++i)
        wide.values[index(wide.size, i + 1, j + 1, k + 1)] = field.values[index(field.size, i, j, k)];
  wide.lps_from_node = field.lps_from_node * glm::translate(glm::dmat4(1.0), glm::dvec3(-1.0));
  return wide;
}

Field member_field(const cases::VoxelSet& set) {
  const glm::ivec3 step = glm::max(glm::ivec3(glm::round(kVoxelSetMm / set.spacing_mm)), glm::ivec3(1));
  Field field;
  field.size = (set.size + step - 1) / step;
  field.values.assign(index(field.size, 0, 0, field.size.z), 0.0F);
  const float share = 1.0F / static_cast<float>(step.x * step.y * step.z);
  for (int k = 0; k < set.size.z; ++k)
    for (int j = 0; j < set.size.y; ++j)
      for (int i = 0; i < set.size.x; ++i)
        if (set.member[index(set.size, i, j, k)] != 0)
          field.values[index(field.size, i / step.x, j / step.y, k / step.z)] += share;
  const glm::dvec3 middle = glm::dvec3(set.low) + 0.5 * glm::dvec3(step - 1);
  field.lps_from_node = glm::inverse(set.voxel_from_lps) * glm::translate(glm::dmat4(1.0), middle) *
                        glm::scale(glm::dmat4(1.0), glm::dvec3(step));
  return field;
}

RoomMesh ellipsoid(const glm::dvec3& center, const glm::dvec3& radii) {
  RoomMesh mesh;
  mesh.append(unit_sphere(16), glm::scale(glm::translate(glm::dmat4(1.0), center), radii));
  return mesh;
}

}  // namespace

RoomMesh field_surface(const Field& given, float iso) {
  RoomMesh mesh;
  if (given.values.empty()) return mesh;
  const Field field = bordered(given, iso - 1.0F - std::abs(iso));
  const glm::ivec3 size = field.size;
  std::vector<std::uint32_t> vertex(field.values.size(), kNone);  // of the cell above a node
  const auto value = [&](const glm::ivec3& n) { return field.values[index(size, n.x, n.y, n.z)]; };
  for (int k = 0; k + 1 < size.z; ++k)
    for (int j = 0; j + 1 < size.y; ++j)
      for (int i = 0; i + 1 < size.x; ++i) {
        glm::dvec3 sum(0.0);
        int crossings = 0;
        for (int axis = 0; axis < 3; ++axis)
          for (int corner = 0; corner < 4; ++corner) {
            glm::ivec3 a(i, j, k);
            a[(axis + 1) % 3] += corner & 1;
            a[(axis + 2) % 3] += corner >> 1;
            glm::ivec3 b = a;
            ++b[axis];
            const float from = value(a), to = value(b);
            if ((from > iso) == (to > iso)) continue;
            glm::dvec3 at(a);
            at[axis] += static_cast<double>((iso - from) / (to - from));
            sum += at;
            ++crossings;
          }
        if (crossings == 0) continue;
        const glm::dvec4 node(sum / static_cast<double>(crossings), 1.0);
        vertex[index(size, i, j, k)] = mesh.add(glm::dvec3(field.lps_from_node * node), {0.0, 0.0, 1.0});
      }
  const bool mirrored = glm::determinant(glm::dmat3(field.lps_from_node)) < 0.0;
  for (int k = 1; k + 1 < size.z; ++k)
    for (int j = 1; j + 1 < size.y; ++j)
      for (int i = 1; i + 1 < size.x; ++i)
        for (int axis = 0; axis < 3; ++axis) {
          const glm::ivec3 a(i, j, k);
          glm::ivec3 b = a;
          ++b[axis];
          const bool inside = value(a) > iso;
          if (inside == (value(b) > iso)) continue;
          // The four cells around the edge.
          const int u = (axis + 1) % 3, v = (axis + 2) % 3;
          std::uint32_t around[4];
          for (int corner = 0; corner < 4; ++corner) {
            glm::ivec3 cell = a;
            cell[u] -= corner == 0 || corner == 3 ? 1 : 0;
            cell[v] -= corner < 2 ? 1 : 0;
            around[corner] = vertex[index(size, cell.x, cell.y, cell.z)];
          }
          if (inside == mirrored) std::swap(around[1], around[3]);
          mesh.triangles.push_back({around[0], around[1], around[2]});
          mesh.triangles.push_back({around[0], around[2], around[3]});
        }
  make_smooth(mesh);
  return mesh;
}

Field hu_field(const volume::Volume& volume, double spacing_mm) {
  const glm::ivec3 step = glm::max(glm::ivec3(glm::round(spacing_mm / volume.spacing_mm)), glm::ivec3(1));
  Field field;
  field.size = (volume.size_voxels + step - 1) / step;
  field.values.reserve(index(field.size, 0, 0, field.size.z));
  for (int k = 0; k < volume.size_voxels.z; k += step.z)
    for (int j = 0; j < volume.size_voxels.y; j += step.y)
      for (int i = 0; i < volume.size_voxels.x; i += step.x)
        field.values.push_back(static_cast<float>(volume.at(i, j, k)));
  field.lps_from_node = volume.lps_from_voxel * glm::scale(glm::dmat4(1.0), glm::dvec3(step));
  return field;
}

RoomMesh form_of(const cases::Shape& shape) {
  if (const auto* sphere = std::get_if<cases::Sphere>(&shape))
    return ellipsoid(sphere->center_lps_mm, glm::dvec3(sphere->radius_mm));
  if (const auto* one = std::get_if<cases::Ellipsoid>(&shape)) return ellipsoid(one->center_lps_mm, one->radii_mm);
  if (const auto* tube = std::get_if<cases::Tube>(&shape)) {
    std::vector<glm::dvec3> points;
    for (const glm::dvec3& point : tube->points_lps_mm)
      if (points.empty() || point != points.back()) points.push_back(point);
    if (points.size() == 1) return ellipsoid(points.front(), glm::dvec3(tube->radius_mm));
    return points.empty() ? RoomMesh{} : swept(points, tube->radius_mm, 14);
  }
  return field_surface(member_field(std::get<cases::VoxelSet>(shape)), 0.5F);
}

}  // namespace seldinger::imaging
