#include "sim/volume/organs/lattice.h"

#include <algorithm>
#include <utility>

#include "sim/volume/components.h"

namespace seldinger::volume {

std::vector<glm::ivec3> ball(double radius_mm) {
  std::vector<glm::ivec3> made;
  const int r = static_cast<int>(radius_mm / kOrganGridMm);
  for (int z = -r; z <= r; ++z)
    for (int y = -r; y <= r; ++y)
      for (int x = -r; x <= r; ++x)
        if ((x * x + y * y + z * z) * kOrganGridMm * kOrganGridMm <= radius_mm * radius_mm)
          made.emplace_back(x, y, z);
  return made;
}

Mask Lattice::eroded(const Mask& mask, double radius_mm) const {
  Mask made(mask.size(), 0);
  const std::vector<glm::ivec3> offsets = ball(radius_mm);
  for (std::size_t from = 0; from < mask.size(); ++from) {
    if (mask[from] == 0) continue;
    const glm::ivec3 p = place(from);
    made[from] = std::all_of(offsets.begin(), offsets.end(),
                             [&](const glm::ivec3& off) { return !holds(p + off) || mask[at(p + off)] != 0; });
  }
  return made;
}

std::vector<Voxels> Lattice::pieces(const Mask& mask) const {
  Components parts(n_, mask);
  std::vector<Voxels> members(parts.numbers());
  parts.each_run([&](std::size_t part, std::size_t begin, std::size_t end) {
    for (std::size_t from = begin; from < end; ++from) members[part].push_back(from);
  });
  members.erase(std::remove_if(members.begin(), members.end(), [](const Voxels& one) { return one.empty(); }),
                members.end());
  return members;
}

void Lattice::spread(const Mask& mask, int most_steps, std::vector<std::uint8_t>& number) const {
  Voxels front, next;
  for (std::size_t from = 0; from < number.size(); ++from)
    if (number[from] != 0) front.push_back(from);
  for (int step = 0; step < most_steps && !front.empty(); ++step, front = std::exchange(next, {}))
    for (const std::size_t from : front)
      for (const glm::ivec3& way : kFaces) {
        const glm::ivec3 q = place(from) + way;
        if (!holds(q) || mask[at(q)] == 0 || number[at(q)] != 0) continue;
        number[at(q)] = number[from];
        next.push_back(at(q));
      }
}

}  // namespace seldinger::volume
