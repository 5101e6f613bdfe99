#include "sim/imaging/room/drape.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "sim/imaging/room/room_model.h"

namespace seldinger::imaging {
namespace {

constexpr double kOverMm = 8.0;      // onto the skin
constexpr double kBeyondMm = 330.0;  // over the table
constexpr double kStepMm = 8.0, kClothMm = 2.5;
constexpr double kAsideMm = 252.0;     // from the middle of the table, to before its sides
constexpr double kFallsMmPerMm = 5.0;  // cloth does not hang steeper
constexpr double kHemMm = 60.0;
constexpr double kLeastCutMm2 = 900.0;

// Heights above the table along `across`, mm; 0 where no body is.
using Profile = std::vector<double>;

void spread(Profile& heights) {
  // Cloth bridges hollows a little, and hangs down at its sides.
  Profile wider = heights;
  for (std::size_t i = 1; i + 1 < heights.size(); ++i)
    wider[i] = std::max(heights[i], 0.5 * (heights[i - 1] + heights[i + 1]));
  heights = wider;
  for (std::size_t i = 1; i < heights.size(); ++i)
    heights[i] = std::max(heights[i], heights[i - 1] - kFallsMmPerMm * kStepMm);
  for (std::size_t i = heights.size() - 1; i-- > 0;)
    heights[i] = std::max(heights[i], heights[i + 1] - kFallsMmPerMm * kStepMm);
}

}  // namespace

RoomMesh drape_over(const cases::Mesh& skin, const RoomFrame& f, double end) {
  const double at_mm = end > 0.0 ? f.high_mm.y : f.low_mm.y;
  const double middle_mm = 0.5 * (f.low_mm.x + f.high_mm.x);
  const double half_mm = std::max(kAsideMm, 0.5 * (f.high_mm.x - f.low_mm.x) + 30.0);
  const auto columns = static_cast<std::size_t>(2.0 * half_mm / kStepMm) + 1;
  const double first_mm = middle_mm - 0.5 * kStepMm * static_cast<double>(columns - 1);
  double cut_mm2 = 0.0;
  Profile edge(columns, 0.0);
  for (std::size_t t = 0; t < skin.triangles.size(); ++t) {
    const glm::uvec3& corners = skin.triangles[t];
    glm::dvec3 at[3];
    for (int i = 0; i < 3; ++i) at[i] = glm::dvec3(skin.vertices_lps_mm[corners[i]]);
    const bool cut = skin.cut[t] != 0;
    const glm::dvec3 area = 0.5 * glm::cross(at[1] - at[0], at[2] - at[0]);
    if (cut && end * glm::dot(area, f.head) > 0.9 * glm::length(area)) cut_mm2 += glm::length(area);
    double low = 1e30, high = -1e30, height = 0.0;
    bool near = false;
    for (const glm::dvec3& p : at) {
      near = near || std::abs(glm::dot(p, f.head) - at_mm) <= kOverMm + 2.0;
      low = std::min(low, glm::dot(p, f.across));
      high = std::max(high, glm::dot(p, f.across));
      height = std::max(height, glm::dot(p, f.up) - f.table_mm);
    }
    if (!near) continue;
    for (auto i = static_cast<std::size_t>(std::max(0.0, std::floor((low - first_mm) / kStepMm)));
         i < columns && first_mm + kStepMm * static_cast<double>(i) <= high + kStepMm; ++i)
      edge[i] = std::max(edge[i], height);
  }
  RoomMesh mesh;
  if (cut_mm2 < kLeastCutMm2) return mesh;
  spread(edge);

  // Its hem hangs down onto the skin: where that falls off, nobody looks in under the cloth.
  for (std::size_t i = 0; i < columns; ++i)
    mesh.add(f.lps(first_mm + kStepMm * static_cast<double>(i), at_mm - end * (kOverMm - 1.0),
                   f.table_mm + kClothMm + std::max(0.0, edge[i] - kHemMm)),
             f.up);
  const auto rows = static_cast<std::size_t>((kOverMm + kBeyondMm) / kStepMm) + 2;
  Profile heights = edge;
  for (std::size_t row = 0; row + 1 < rows; ++row) {
    const double out_mm = -kOverMm + kStepMm * static_cast<double>(row);
    if (out_mm > 0.0) {
      // Further out the body is guessed: smoother, a little lower.
      Profile smooth = heights;
      for (std::size_t i = 1; i + 1 < columns; ++i)
        smooth[i] = 0.25 * heights[i - 1] + 0.5 * heights[i] + 0.25 * heights[i + 1];
      heights = smooth;
      for (double& height : heights) height *= 0.998;
    }
    const double folds = std::clamp(out_mm / 120.0, 0.0, 1.0);
    for (std::size_t i = 0; i < columns; ++i) {
      const double x = first_mm + kStepMm * static_cast<double>(i), y = at_mm + end * out_mm;
      const double wave = std::sin(x / 21.0 + 1.6 * std::sin(y / 47.0)) * std::sin(y / 33.0 + x / 90.0) +
                          0.5 * std::sin(x / 11.0 - y / 19.0);
      const double lies = std::clamp(heights[i] / 40.0, 0.0, 1.0);
      mesh.add(f.lps(x, y, f.table_mm + kClothMm + heights[i] + lies * folds * (2.2 * wave + 2.0)), f.up);
    }
  }
  const auto at = [&](std::size_t row, std::size_t i) { return static_cast<std::uint32_t>(row * columns + i); };
  for (std::size_t row = 0; row + 1 < rows; ++row)
    for (std::size_t i = 0; i + 1 < columns; ++i) {
      glm::uvec3 one(at(row, i), at(row, i + 1), at(row + 1, i));
      glm::uvec3 two(at(row, i + 1), at(row + 1, i + 1), at(row + 1, i));
      if (end < 0.0) {
        std::swap(one.y, one.z);
        std::swap(two.y, two.z);
      }
      mesh.triangles.push_back(one);
      mesh.triangles.push_back(two);
    }
  make_smooth(mesh);
  return mesh;
}

}  // namespace seldinger::imaging
