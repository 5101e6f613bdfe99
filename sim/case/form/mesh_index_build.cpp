// The tree of MeshIndex, and its normals.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <tuple>

#include "sim/base/exact_math.h"
#include "sim/case/form/mesh_index.h"
#include "sim/case/form/triangle.h"

namespace seldinger::cases {
namespace {

constexpr std::uint32_t kLeafTriangles = 4;
constexpr int kBins = 16;
constexpr int kMaxBinnedDepth = 40;  // below, halves: so that no mesh makes the tree deeper than a query's stack

glm::dvec3 unit_or_zero(const glm::dvec3& v) {
  const double length2 = glm::dot(v, v);
  return length2 > 0.0 ? v / std::sqrt(length2) : glm::dvec3(0.0);
}

struct Box {
  glm::vec3 low{std::numeric_limits<float>::infinity()}, high{-std::numeric_limits<float>::infinity()};
  void add(const Box& other) {
    for (int i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], other.low[i]);
      high[i] = std::max(high[i], other.high[i]);
    }
  }
  void add(const glm::vec3& point) { add(Box{point, point}); }
  double half_area() const {
    const glm::dvec3 e = glm::dvec3(high) - glm::dvec3(low);
    return e.x * e.y + e.y * e.z + e.z * e.x;
  }
};

}  // namespace

// Splits in two where a ray is expected to meet the least (Wald, IEEE Symp. Interactive Ray Tracing, 2007: surface
// area heuristic in bins), then folds pairs into fours. Of equal answers the lower id counts.
class MeshIndex::Builder {
 public:
  explicit Builder(const Mesh& mesh);
  std::vector<std::uint32_t> order() const;  // triangles' ids
  void fold(std::vector<Node>& nodes) const { fold_into(nodes, 0); }

 private:
  struct Sorted {
    Box box;
    std::uint32_t id;
    float center(int axis) const { return box.low[axis] + box.high[axis]; }  // twice
  };
  struct Pair {
    Box box;
    std::uint32_t first = 0, count = 0;  // leaf: triangles; inner (count 0): the left child, right = +1
  };
  using At = std::vector<Sorted>::iterator;

  void build(std::uint32_t pair, At first, At last, int depth);
  static At split(At first, At last, const Box& centers, int depth);
  void fold_into(std::vector<Node>& nodes, std::uint32_t pair) const;

  std::vector<Sorted> sorted_;
  std::vector<Pair> pairs_;
};

MeshIndex::Builder::Builder(const Mesh& mesh) {
  const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
  sorted_.resize(count);
  for (std::uint32_t t = 0; t < count; ++t) {
    for (int i = 0; i < 3; ++i) sorted_[t].box.add(mesh.vertices_lps_mm[mesh.triangles[t][i]]);
    sorted_[t].id = t;
  }
  pairs_.reserve(count);
  pairs_.emplace_back();
  build(0, sorted_.begin(), sorted_.end(), 0);
}

std::vector<std::uint32_t> MeshIndex::Builder::order() const {
  std::vector<std::uint32_t> ids(sorted_.size());
  std::transform(sorted_.begin(), sorted_.end(), ids.begin(), [](const Sorted& s) { return s.id; });
  return ids;
}

void MeshIndex::Builder::build(std::uint32_t pair, At first, At last, int depth) {
  Box box, centers;
  for (At s = first; s != last; ++s) {
    box.add(s->box);
    centers.add(s->box.low + s->box.high);
  }
  pairs_[pair].box = box;
  const auto count = static_cast<std::uint32_t>(last - first);
  if (count <= kLeafTriangles) {
    pairs_[pair].first = static_cast<std::uint32_t>(first - sorted_.begin());
    pairs_[pair].count = count;
    return;
  }
  const At middle = split(first, last, centers, depth);
  const auto child = static_cast<std::uint32_t>(pairs_.size());
  pairs_[pair].first = child;
  pairs_.emplace_back();
  pairs_.emplace_back();
  build(child, first, middle, depth + 1);
  build(child + 1, middle, last, depth + 1);
}

MeshIndex::Builder::At MeshIndex::Builder::split(At first, At last, const Box& centers, int depth) {
  const glm::vec3 extent = centers.high - centers.low;
  const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : (extent.y >= extent.z ? 1 : 2);
  if (depth < kMaxBinnedDepth && extent[axis] > 0.0F) {
    const float scale = static_cast<float>(kBins) * 0.9999F / extent[axis], from = centers.low[axis];
    const auto bin_of = [=](const Sorted& s) {
      return std::clamp(static_cast<int>((s.center(axis) - from) * scale), 0, kBins - 1);
    };
    Box bins[kBins];
    std::ptrdiff_t counts[kBins] = {};
    for (At s = first; s != last; ++s) {
      const int bin = bin_of(*s);
      bins[bin].add(s->box);
      ++counts[bin];
    }
    double right_cost[kBins] = {};
    Box right, left;
    std::ptrdiff_t right_count = 0, left_count = 0;
    for (int bin = kBins - 1; bin > 0; --bin) {
      right.add(bins[bin]);
      right_count += counts[bin];
      right_cost[bin] = right_count > 0 ? right.half_area() * static_cast<double>(right_count) : 0.0;
    }
    double best = std::numeric_limits<double>::infinity();
    int best_bin = 0;
    for (int bin = 1; bin < kBins; ++bin) {
      left.add(bins[bin - 1]);
      left_count += counts[bin - 1];
      if (left_count == 0 || left_count == last - first) continue;
      const double cost = left.half_area() * static_cast<double>(left_count) + right_cost[bin];
      if (cost < best) {
        best = cost;
        best_bin = bin;
      }
    }
    if (best_bin > 0) return std::partition(first, last, [&](const Sorted& s) { return bin_of(s) < best_bin; });
  }
  const At middle = first + (last - first) / 2;
  std::nth_element(first, middle, last, [axis](const Sorted& x, const Sorted& y) {
    return std::make_tuple(x.center(axis), x.id) < std::make_tuple(y.center(axis), y.id);
  });
  return middle;
}

void MeshIndex::Builder::fold_into(std::vector<Node>& nodes, std::uint32_t pair) const {
  std::uint32_t child[4] = {pair};
  int n = 1;
  while (n < 4) {
    int widest = -1;
    for (int i = 0; i < n; ++i)
      if (pairs_[child[i]].count == 0 &&
          (widest < 0 || pairs_[child[i]].box.half_area() > pairs_[child[widest]].box.half_area()))
        widest = i;
    if (widest < 0) break;
    child[n++] = pairs_[child[widest]].first + 1;
    child[widest] = pairs_[child[widest]].first;
  }
  const std::size_t at = nodes.size();
  nodes.emplace_back();
  for (int i = 0; i < 4; ++i) {
    const Box box = i < n ? pairs_[child[i]].box : Box();  // an empty box is never met
    for (int axis = 0; axis < 3; ++axis) {
      nodes[at].low[axis][i] = box.low[axis];
      nodes[at].high[axis][i] = box.high[axis];
    }
    const bool leaf = i < n && pairs_[child[i]].count > 0;
    nodes[at].first[i] = leaf ? pairs_[child[i]].first : 0;
    nodes[at].count[i] = leaf ? pairs_[child[i]].count : 0;
  }
  for (int i = 0; i < n; ++i) {
    if (pairs_[child[i]].count > 0) continue;
    nodes[at].first[i] = static_cast<std::uint32_t>(nodes.size());
    fold_into(nodes, child[i]);
  }
}

MeshIndex::MeshIndex(const Mesh& mesh) {
  const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
  if (count == 0) return;
  make_normals(mesh);
  const Builder builder(mesh);
  const std::vector<std::uint32_t> order = builder.order();
  nodes_.reserve(count / 4 + 1);
  builder.fold(nodes_);
  triangles_.resize(count);
  position_.resize(count);
  for (std::uint32_t at = 0; at < count; ++at) {
    const std::uint32_t id = order[at];
    const glm::uvec3& v = mesh.triangles[id];
    Triangle& triangle = triangles_[at];
    triangle.a = mesh.vertices_lps_mm[v.x];
    triangle.b = mesh.vertices_lps_mm[v.y];
    triangle.c = mesh.vertices_lps_mm[v.z];
    triangle.id = id;
    triangle.cut = !mesh.cut.empty() && mesh.cut[id] != 0;
    triangle.thin = is_thin(triangle.a, triangle.b, triangle.c);
    position_[id] = at;
    for (int i = 0; i < 3; ++i)
      for (const glm::vec3& corner : {triangle.a, triangle.b, triangle.c})
        reach_mm_ = std::max(reach_mm_, std::abs(static_cast<double>(corner[i])));
  }
}

void MeshIndex::make_normals(const Mesh& mesh) {
  struct EdgeSide {
    std::uint32_t high, triangle, side;
  };
  const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
  normals_.resize(count);
  std::vector<glm::dvec3> vertex_normal(mesh.vertices_lps_mm.size(), glm::dvec3(0.0));
  std::vector<std::uint32_t> first_side(mesh.vertices_lps_mm.size() + 1, 0);  // of each edge's lower vertex
  for (std::uint32_t t = 0; t < count; ++t) {
    const glm::uvec3& v = mesh.triangles[t];
    const glm::dvec3 corner[3] = {mesh.vertices_lps_mm[v.x], mesh.vertices_lps_mm[v.y], mesh.vertices_lps_mm[v.z]};
    normals_[t].face = unit_or_zero(glm::cross(corner[1] - corner[0], corner[2] - corner[0]));
    glm::dvec3 along[3];
    for (int i = 0; i < 3; ++i) {
      along[i] = unit_or_zero(corner[(i + 1) % 3] - corner[i]);
      ++first_side[std::min(v[i], v[(i + 1) % 3]) + 1];
    }
    for (int i = 0; i < 3; ++i)
      vertex_normal[v[i]] += normals_[t].face * base::exact_acos(-glm::dot(along[i], along[(i + 2) % 3]));
  }
  for (std::size_t v = 1; v < first_side.size(); ++v) first_side[v] += first_side[v - 1];
  std::vector<EdgeSide> sides(std::size_t{count} * 3);
  std::vector<std::uint32_t> next = first_side;
  for (std::uint32_t t = 0; t < count; ++t)
    for (std::uint32_t i = 0; i < 3; ++i) {
      const std::uint32_t from = mesh.triangles[t][static_cast<int>(i)],
                          to = mesh.triangles[t][static_cast<int>((i + 1) % 3)];
      sides[next[std::min(from, to)]++] = {std::max(from, to), t, i};
    }
  for (std::size_t v = 0; v + 1 < first_side.size(); ++v) {
    const auto begin = sides.begin() + first_side[v], end = sides.begin() + first_side[v + 1];
    std::sort(begin, end, [](const EdgeSide& x, const EdgeSide& y) {
      return std::tie(x.high, x.triangle, x.side) < std::tie(y.high, y.triangle, y.side);
    });
    for (auto group = begin; group != end;) {
      glm::dvec3 sum(0.0);
      auto after = group;
      for (; after != end && after->high == group->high; ++after) sum += normals_[after->triangle].face;
      for (; group != after; ++group) normals_[group->triangle].edge[group->side] = sum;
    }
  }
  for (std::uint32_t t = 0; t < count; ++t)
    for (int i = 0; i < 3; ++i) normals_[t].vertex[i] = vertex_normal[mesh.triangles[t][i]];
}

}  // namespace seldinger::cases
