#include "sim/volume/body/field_of_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <optional>

#include "sim/volume/axial_slices.h"
#include "sim/volume/body/body_mask.h"
#include "sim/volume/body/padding_planes.h"

namespace seldinger::volume {
namespace {

constexpr double kLeastShare = 0.002;                 // of a slice: the corners of a full circle are a fifth
constexpr double kOffVoxels = 1.5, kOffShare = 0.02;  // of the edge from its circle; share of the radius
constexpr double kOnCircleShare = 0.95;               // of the edge
constexpr double kMeasuredAirShare = 0.1;             // of the voxels within the edge, where padding is not kAirHu
constexpr int kMostFillHu = -900;                     // what is filled with more is tissue to whoever reads it
constexpr double kFillShare = 0.002;                  // of all voxels, among their like
constexpr double kNoiseShare = 0.005;  // of all voxels: air of which each differs from those beside it
constexpr int kFarInVoxels = 3, kRoomBelowHu = -900;
constexpr std::size_t kLeastEdge = 20;

struct Circle {
  glm::dvec2 middle_mm{0.0};
  double radius_mm = 0.0;
};

// Least squares of |p|² = 2 p·m + c (Kåsa, IEEE Trans Instrum Meas 1976); nothing for points on one line.
std::optional<Circle> circle_through(const std::vector<glm::dvec2>& points_mm) {
  glm::dvec2 mean(0.0);
  for (const glm::dvec2& p : points_mm) mean += p / static_cast<double>(points_mm.size());
  glm::dmat2 normal(0.0);
  glm::dvec2 right(0.0);
  double mean_square = 0.0;
  for (const glm::dvec2& p : points_mm) mean_square += glm::dot(p - mean, p - mean);
  mean_square /= static_cast<double>(points_mm.size());
  for (const glm::dvec2& p : points_mm) {
    const glm::dvec2 q = p - mean;
    normal += 2.0 * glm::outerProduct(q, q);
    right += q * (glm::dot(q, q) - mean_square);
  }
  const double size = normal[0][0] + normal[1][1];
  if (!(glm::determinant(normal) > 1e-9 * size * size)) return std::nullopt;
  const glm::dvec2 middle = glm::inverse(normal) * right;
  return Circle{mean + middle, std::sqrt(glm::dot(middle, middle) + mean_square)};
}

// take(hu, of the four beside it) of each voxel of air that is no kAirHu, but for a slice's border.
template <typename Take>
void over_air(const Volume& volume, const Take& take) {
  const glm::ivec3 n = volume.size_voxels;
  const auto row = static_cast<std::size_t>(n.x);
  for (int k = 0; k < n.z; ++k)
    for (int j = 1; j + 1 < n.y; ++j)
      for (int i = 1; i + 1 < n.x; ++i) {
        const std::size_t at = volume.index(i, j, k);
        if (volume.hu[at] <= kMostFillHu && volume.hu[at] > kAirHu)
          take(volume.hu[at],
               std::array{volume.hu[at - 1], volume.hu[at + 1], volume.hu[at - row], volume.hu[at + row]});
      }
}

// What padding may be filled with: kAirHu, which readers make of it, and that value of air, if there is one, which
// many voxels have among their like while this CT's own air has noise: what a program wrote where it had none.
std::vector<std::int16_t> fills_of(const Volume& volume) {
  std::array<std::size_t, kMostFillHu - kAirHu + 1> like{};
  over_air(volume, [&](std::int16_t hu, const std::array<std::int16_t, 4>& beside) {
    if (std::all_of(beside.begin(), beside.end(), [&](std::int16_t other) { return other == hu; }))
      ++like[static_cast<std::size_t>(hu - kAirHu)];
  });
  std::vector<std::int16_t> fills{kAirHu};
  const auto most = std::max_element(like.begin(), like.end());
  const auto fill = static_cast<std::int16_t>(kAirHu + (most - like.begin()));
  const auto all = static_cast<double>(volume.hu.size());
  if (static_cast<double>(*most) < kFillShare * all) return fills;
  std::size_t noise = 0;  // not at an edge of tissue or of the fill, where values lie between
  over_air(volume, [&](std::int16_t hu, const std::array<std::int16_t, 4>& beside) {
    const auto is_other = [&](std::int16_t other) { return other != fill && other != hu && other <= kMostFillHu; };
    noise += hu != fill && std::all_of(beside.begin(), beside.end(), is_other) ? 1 : 0;
  });
  if (static_cast<double>(noise) >= kNoiseShare * all) fills.push_back(fill);
  return fills;
}

// A slice's places that hold the same value in every slice and are joined to its border.
class Surround {
 public:
  Surround(const Volume& volume, const AxialSlices& slices, std::int16_t fill)
      : volume_(volume), slices_(slices), fill_(fill), constant_(places(), 1), joined_(places(), 0) {
    for (int slice = 0; slice < slices.count(); ++slice)
      for (int y = 0; y < slices.height(); ++y)
        for (int x = 0; x < slices.width(); ++x)
          if (volume.hu[slices.voxel(slice, x, y)] != fill_) constant_[at(x, y)] = 0;
    for (int x = 0; x < slices.width(); ++x) reach(x, 0), reach(x, slices.height() - 1);
    for (int y = 0; y < slices.height(); ++y) reach(0, y), reach(slices.width() - 1, y);
    while (!open_.empty()) {
      const glm::ivec2 p = open_.back();
      open_.pop_back();
      for (const glm::ivec2& q : around(p)) reach(q.x, q.y);
    }
  }

  bool is_circle() const {
    const auto count = static_cast<double>(std::count(joined_.begin(), joined_.end(), 1));
    if (count < kLeastShare * static_cast<double>(places()) || count == static_cast<double>(places())) return false;
    std::vector<glm::dvec2> edge_mm;
    std::size_t within = 0, air = 0;
    for (int y = 0; y < slices_.height(); ++y)
      for (int x = 0; x < slices_.width(); ++x) {
        if (joined_[at(x, y)] != 0) continue;
        for (const glm::ivec2& q : around({x, y})) {
          if (!holds(q.x, q.y) || joined_[at(q.x, q.y)] == 0) continue;
          edge_mm.push_back((glm::dvec2(x, y) + glm::dvec2(q)) / 2.0 * slices_.spacing_mm());
          // A few voxels in, where a body's own edge has no blur.
          const glm::ivec2 in = glm::ivec2(x, y) + kFarInVoxels * (glm::ivec2(x, y) - q);
          for (int slice = 0; holds(in.x, in.y) && slice < slices_.count(); ++slice) {
            ++within;
            const int hu = volume_.hu[slices_.voxel(slice, in.x, in.y)];
            air += hu < kRoomBelowHu && hu != fill_ ? 1 : 0;
          }
        }
      }
    if (edge_mm.size() < kLeastEdge) return false;
    if (fill_ != kAirHu && static_cast<double>(air) < kMeasuredAirShare * static_cast<double>(within)) return false;
    const auto circle = circle_through(edge_mm);
    const double voxel_mm = std::max(slices_.spacing_mm().x, slices_.spacing_mm().y);
    const auto on = [&](const glm::dvec2& p) {
      return std::abs(glm::distance(p, circle->middle_mm) - circle->radius_mm) <=
             std::min(kOffVoxels * voxel_mm, kOffShare * circle->radius_mm);
    };
    return circle && static_cast<double>(std::count_if(edge_mm.begin(), edge_mm.end(), on)) >=
                         kOnCircleShare * static_cast<double>(edge_mm.size());
  }

  void add_to(std::vector<std::uint8_t>& padding) const {
    for (int slice = 0; slice < slices_.count(); ++slice)
      for (int y = 0; y < slices_.height(); ++y)
        for (int x = 0; x < slices_.width(); ++x) padding[slices_.voxel(slice, x, y)] |= joined_[at(x, y)];
  }

 private:
  std::size_t places() const {
    return static_cast<std::size_t>(slices_.width()) * static_cast<std::size_t>(slices_.height());
  }
  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(slices_.width()) + static_cast<std::size_t>(x);
  }
  bool holds(int x, int y) const { return x >= 0 && y >= 0 && x < slices_.width() && y < slices_.height(); }
  static std::array<glm::ivec2, 4> around(glm::ivec2 p) {
    return {glm::ivec2(p.x - 1, p.y), {p.x + 1, p.y}, {p.x, p.y - 1}, {p.x, p.y + 1}};
  }
  void reach(int x, int y) {
    if (!holds(x, y) || constant_[at(x, y)] == 0 || joined_[at(x, y)] != 0) return;
    joined_[at(x, y)] = 1;
    open_.emplace_back(x, y);
  }

  const Volume& volume_;
  const AxialSlices& slices_;
  std::int16_t fill_;
  std::vector<std::uint8_t> constant_, joined_;
  std::vector<glm::ivec2> open_;
};

}  // namespace

std::vector<std::uint8_t> padding_of(const Volume& volume) {
  if (volume.hu.empty()) return {};
  const AxialSlices slices(volume);
  std::vector<std::uint8_t> padding(volume.hu.size(), 0);
  bool any = false;
  for (const std::int16_t fill : fills_of(volume)) {
    const Surround surround(volume, slices, fill);
    if (surround.is_circle()) surround.add_to(padding), any = true;
    any |= add_padding_planes(volume, fill, padding);
  }
  return any ? padding : std::vector<std::uint8_t>();
}

}  // namespace seldinger::volume
