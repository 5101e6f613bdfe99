// Walks on the coarse grid on which organs are looked for. Inside sim/volume/organs only.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "sim/volume/organs/find_organs.h"
#include "sim/volume/organs/organ_grid.h"

namespace seldinger::volume {

using Mask = std::vector<std::uint8_t>;   // one per voxel, not 0: in it
using Voxels = std::vector<std::size_t>;  // their indices

constexpr double kDoubted = 0.4;  // times: however sure it is but for that, it is not named

struct Part {  // what may be named
  OrganFound found;
  Voxels voxels;
};

inline constexpr std::array<glm::ivec3, 6> kFaces{
    {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}};

class Lattice {
 public:
  explicit Lattice(const glm::ivec3& size) : n_(size) {}
  const glm::ivec3& size() const { return n_; }
  std::size_t voxels() const { return at({0, 0, n_.z}); }
  std::size_t at(const glm::ivec3& p) const {
    return static_cast<std::size_t>(p.x) +
           static_cast<std::size_t>(n_.x) *
               (static_cast<std::size_t>(p.y) + static_cast<std::size_t>(n_.y) * static_cast<std::size_t>(p.z));
  }
  glm::ivec3 place(std::size_t at) const {
    const auto nx = static_cast<std::size_t>(n_.x), ny = static_cast<std::size_t>(n_.y);
    return {static_cast<int>(at % nx), static_cast<int>(at / nx % ny), static_cast<int>(at / (nx * ny))};
  }
  bool holds(const glm::ivec3& p) const {
    return p.x >= 0 && p.y >= 0 && p.z >= 0 && p.x < n_.x && p.y < n_.y && p.z < n_.z;
  }
  // Those whose neighbours within the radius are in the mask too; beyond the grid all is.
  Mask eroded(const Mask& mask, double radius_mm) const;
  // Connected pieces (6 neighbours).
  std::vector<Voxels> pieces(const Mask& mask) const;
  // Each seed's number (> 0) spreads to what lies nearest to it within the mask, at most so many steps.
  void spread(const Mask& mask, int most_steps, std::vector<std::uint8_t>& number) const;

 private:
  glm::ivec3 n_;
};

std::vector<glm::ivec3> ball(double radius_mm);

constexpr double ml_of(std::size_t voxels) {
  return static_cast<double>(voxels) * kOrganGridMm * kOrganGridMm * kOrganGridMm * 1e-3;
}

}  // namespace seldinger::volume
