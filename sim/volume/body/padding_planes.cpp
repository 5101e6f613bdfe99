#include "sim/volume/body/padding_planes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>
#include <utility>

#include "sim/base/rng.h"
#include "sim/volume/body/body_mask.h"

namespace seldinger::volume {
namespace {

constexpr double kLeastMm2 = 1000.0;
constexpr double kMostOfSurface = 0.6;  // of tissue against air: more, and the room itself is gone
constexpr int kSolidVoxels = 3;         // of the fill one behind the other: noise in air makes no three
constexpr double kBehindShare = 0.98;   // of what lies a little behind a plane is the fill
constexpr int kMostPlanes = 4, kTries = 400;
constexpr std::size_t kMostAsked = 4000;

// Where tissue ends in padding: the middle between two voxels.
struct Jump {
  glm::dvec3 place_mm;  // along the volume's axes
  glm::ivec3 beyond;
};

struct Plane {
  glm::dvec3 normal{0.0};  // unit, away from the tissue
  double at_mm = 0.0;
};

class Jumps {
 public:
  Jumps(const Volume& volume, std::int16_t fill, const std::vector<std::uint8_t>& padding)
      : volume_(volume), fill_(fill), padding_(padding) {
    const glm::ivec3 n = volume.size_voxels;
    const double face_mm2 = std::cbrt(volume.spacing_mm.x * volume.spacing_mm.y * volume.spacing_mm.z);
    each_mm2_ = face_mm2 * face_mm2;
    for (int k = 0; k < n.z; ++k)
      for (int j = 0; j < n.y; ++j)
        for (int i = 0; i < n.x; ++i) {
          if (volume.at(i, j, k) <= kSkinHu) continue;
          for (int side = 0; side < 6; ++side) look({i, j, k}, side);
        }
  }

  bool enough() const {
    return static_cast<double>(jumps_.size()) * each_mm2_ >= kLeastMm2 &&
           static_cast<double>(jumps_.size()) <= kMostOfSurface * static_cast<double>(surface_);
  }

  // The plane that most of them lie on; they are taken away. Nothing where it is too small or no edge of padding.
  std::optional<Plane> take_largest(base::Rng& rng) {
    if (static_cast<double>(jumps_.size()) * each_mm2_ < kLeastMm2) return std::nullopt;
    const std::size_t every = jumps_.size() / kMostAsked + 1;
    Plane best;
    std::size_t most = 0;
    const auto any = [&] {
      return jumps_[std::min(jumps_.size() - 1,
                             static_cast<std::size_t>(rng.uniform() * static_cast<double>(jumps_.size())))];
    };
    for (int i = 0; i < kTries; ++i) {
      const Jump a = any(), b = any(), c = any();
      const glm::dvec3 normal = glm::cross(b.place_mm - a.place_mm, c.place_mm - a.place_mm);
      const double length = glm::length(normal);
      if (!(length > 100.0)) continue;  // mm²: three places side by side tell no direction
      Plane plane{normal / length, glm::dot(normal / length, a.place_mm)};
      const double way = glm::dot(glm::dvec3(a.beyond) * volume_.spacing_mm - a.place_mm, plane.normal);
      if (way < 0.0) plane = {-plane.normal, -plane.at_mm};
      std::size_t on = 0;
      for (std::size_t at = 0; at < jumps_.size(); at += every) on += lies_on(plane, jumps_[at]) ? 1 : 0;
      if (on > most) most = on, best = plane;
    }
    if (most == 0) return std::nullopt;
    std::vector<Jump> rest, taken;
    for (const Jump& jump : jumps_) (lies_on(best, jump) ? taken : rest).push_back(jump);
    jumps_ = std::move(rest);
    if (static_cast<double>(taken.size()) * each_mm2_ < kLeastMm2 || !is_edge(best, taken)) return std::nullopt;
    return best;
  }

  // How far voxels' middles may lie off a plane that parts them from their neighbours.
  double off_mm(const Plane& plane) const {
    return 0.5 * glm::dot(glm::abs(plane.normal), volume_.spacing_mm) + 1e-6;
  }

 private:
  bool holds(const glm::ivec3& p) const {
    for (int axis = 0; axis < 3; ++axis)
      if (p[axis] < 0 || p[axis] >= volume_.size_voxels[axis]) return false;
    return true;
  }

  void look(const glm::ivec3& from, int side) {
    glm::ivec3 step(0);
    step[side / 2] = side % 2 == 0 ? 1 : -1;
    const glm::ivec3 beyond = from + step;
    if (!holds(beyond) || volume_.at(beyond.x, beyond.y, beyond.z) > kSkinHu) return;
    ++surface_;
    if (padding_[volume_.index(beyond.x, beyond.y, beyond.z)] != 0) return;
    for (int i = 1; i <= kSolidVoxels; ++i) {
      const glm::ivec3 p = from + i * step;
      if (holds(p) && volume_.at(p.x, p.y, p.z) != fill_) return;
    }
    jumps_.push_back({(glm::dvec3(from) + glm::dvec3(step) / 2.0) * volume_.spacing_mm, beyond});
  }

  bool lies_on(const Plane& plane, const Jump& jump) const {
    return std::abs(glm::dot(plane.normal, jump.place_mm) - plane.at_mm) <= off_mm(plane) &&
           glm::dot(glm::dvec3(jump.beyond) * volume_.spacing_mm - jump.place_mm, plane.normal) > 0.0;
  }

  bool is_edge(const Plane& plane, const std::vector<Jump>& jumps) const {
    std::size_t behind = 0, empty = 0;
    for (const Jump& jump : jumps)
      for (const double by : {2.0, 4.0}) {
        const glm::ivec3 p(
            glm::round((jump.place_mm + plane.normal * by * 2.0 * off_mm(plane)) / volume_.spacing_mm));
        if (!holds(p)) continue;
        ++behind;
        empty += volume_.at(p.x, p.y, p.z) == fill_ ? 1 : 0;
      }
    return static_cast<double>(empty) >= kBehindShare * static_cast<double>(behind);
  }

  const Volume& volume_;
  std::int16_t fill_;
  const std::vector<std::uint8_t>& padding_;
  double each_mm2_ = 0.0;
  std::size_t surface_ = 0;
  std::vector<Jump> jumps_;
};

void add_behind(const Volume& volume, std::int16_t fill, const Plane& plane, double off_mm,
                std::vector<std::uint8_t>& padding) {
  for (int k = 0; k < volume.size_voxels.z; ++k)
    for (int j = 0; j < volume.size_voxels.y; ++j)
      for (int i = 0; i < volume.size_voxels.x; ++i) {
        const std::size_t at = volume.index(i, j, k);
        if (volume.hu[at] == fill &&
            glm::dot(plane.normal, glm::dvec3(i, j, k) * volume.spacing_mm) > plane.at_mm - off_mm)
          padding[at] = 1;
      }
}

}  // namespace

bool add_padding_planes(const Volume& volume, std::int16_t fill, std::vector<std::uint8_t>& padding) {
  Jumps jumps(volume, fill, padding);
  if (!jumps.enough()) return false;
  base::Rng rng(1);
  bool any = false;
  for (int i = 0; i < kMostPlanes; ++i)
    if (const auto plane = jumps.take_largest(rng)) {
      add_behind(volume, fill, *plane, jumps.off_mm(*plane), padding);
      any = true;
    }
  return any;
}

}  // namespace seldinger::volume
