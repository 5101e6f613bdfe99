#include "web/json/skin_json.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

namespace seldinger::web {
namespace {

constexpr double kFinestCell_mm = 8.0, kCoarser = 1.25;

struct Net {
  std::vector<glm::dvec3> vertices_mm;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

Net net_of(const cases::Mesh& skin, double cell_mm) {
  Net net;
  std::map<std::array<int, 3>, std::uint32_t> cells;
  std::vector<double> count;
  std::vector<std::int64_t> net_from_skin(skin.vertices_lps_mm.size(), -1);
  const auto vertex = [&](std::uint32_t i) {
    if (net_from_skin[i] >= 0) return static_cast<std::uint32_t>(net_from_skin[i]);
    const glm::dvec3 at(skin.vertices_lps_mm[i]);
    const std::array<int, 3> cell{static_cast<int>(std::floor(at.x / cell_mm)),
                                  static_cast<int>(std::floor(at.y / cell_mm)),
                                  static_cast<int>(std::floor(at.z / cell_mm))};
    const auto [found, added] = cells.emplace(cell, static_cast<std::uint32_t>(net.vertices_mm.size()));
    if (added) {
      net.vertices_mm.emplace_back(0.0);
      count.push_back(0.0);
    }
    net.vertices_mm[found->second] += at;
    count[found->second] += 1.0;
    net_from_skin[i] = found->second;
    return found->second;
  };
  std::set<std::array<std::uint32_t, 3>> known;
  for (std::size_t i = 0; i < skin.triangles.size(); ++i) {
    if (i < skin.cut.size() && skin.cut[i] != 0) continue;
    const glm::uvec3& of_skin = skin.triangles[i];
    const std::array<std::uint32_t, 3> one{vertex(of_skin.x), vertex(of_skin.y), vertex(of_skin.z)};
    std::array<std::uint32_t, 3> sorted = one;
    std::sort(sorted.begin(), sorted.end());
    if (sorted[0] != sorted[1] && sorted[1] != sorted[2] && known.insert(sorted).second)
      net.triangles.push_back(one);
  }
  for (std::size_t i = 0; i < count.size(); ++i) net.vertices_mm[i] /= count[i];
  return net;
}

}  // namespace

std::string skin_json(const cases::Mesh& skin) {
  double cell_mm = kFinestCell_mm;
  Net net = net_of(skin, cell_mm);
  while (net.vertices_mm.size() > kMostSkinVertices) net = net_of(skin, cell_mm *= kCoarser);
  nlohmann::ordered_json json = {{"vertices_mm", nlohmann::ordered_json::array()},
                                 {"triangles", nlohmann::ordered_json::array()}};
  for (const glm::dvec3& one : net.vertices_mm)
    for (int i = 0; i < 3; ++i) json["vertices_mm"].push_back(std::lround(one[i]));
  for (const auto& one : net.triangles)
    for (const std::uint32_t i : one) json["triangles"].push_back(i);
  return json.dump() + "\n";
}

}  // namespace seldinger::web
