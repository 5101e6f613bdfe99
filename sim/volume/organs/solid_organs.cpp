#include "sim/volume/organs/solid_organs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>
#include <utility>

#include "sim/volume/organs/gallbladder.h"

namespace seldinger::volume {
namespace {

// Where an organ lies from the spine (LPS: +x left, +y back), its size, adults' and children's, and its level:
// above that of muscle, 55 to 65 HU (Bae, Radiology 2010;256:32), which lies beside every organ; of urine, water's.
struct OrganLaw {
  FoundOrgan organ;
  glm::dvec2 low_mm, high_mm;  // of its centre from the spine
  double least_ml, most_ml;
  int least_hu, most_hu;
  double wide_hu;      // to each side of its level: a kidney has cortex and medulla
  double reach_mm;     // a neck thinner than twice this parts it from others
  double compactness;  // least; of a ball 1
  double vessel_mm;    // across: what is brighter, runs through it and is no wider does not part it
};
constexpr std::size_t kRightKidney = 0, kLeftKidney = 1;  // among the laws
constexpr std::array<OrganLaw, 5> kLaws{{
    {FoundOrgan::right_kidney, {-95.0, -45.0}, {-25.0, 40.0}, 60.0, 350.0, 100, 260, 30.0, 6.0, 0.45, 0.0},
    {FoundOrgan::left_kidney, {25.0, -45.0}, {95.0, 40.0}, 60.0, 350.0, 100, 260, 30.0, 6.0, 0.45, 0.0},
    {FoundOrgan::liver, {-130.0, -130.0}, {0.0, 0.0}, 500.0, 3000.0, 78, 260, 12.0, 12.0, 0.35, 15.0},
    {FoundOrgan::spleen, {70.0, -60.0}, {150.0, 60.0}, 60.0, 700.0, 78, 260, 12.0, 6.0, 0.4, 0.0},
    {FoundOrgan::bladder, {-35.0, -140.0}, {35.0, -15.0}, 40.0, 800.0, -10, 26, 10.0, 6.0, 0.5, 0.0},
}};
// Of bile, which may be as thick as muscle; then it is not told from a gut.
constexpr OrganLaw kGallbladder{
    FoundOrgan::gallbladder, {-110.0, -150.0}, {10.0, -10.0}, 3.0, 90.0, -6, 26, 10.0, 3.0, 0.5, 0.0};
constexpr double kHardlyParted = 0.6;  // of its faces: what is joined to more is no organ of its own
constexpr int kStepHu = 4;
constexpr std::uint8_t kVessel = 2;  // among what is alike: it joins what it runs through, and is not named so

class Finder {
 public:
  Finder(const OrganGrid& grid, const std::vector<glm::dvec2>& middle_mm)
      : grid_(grid), lattice_(grid.volume.size_voxels), middle_mm_(middle_mm) {
    for (std::size_t at = 0; at < grid.soft.size(); ++at)
      if (grid.soft[at] != 0) by_level_.emplace_back(double{grid.level_hu[at]}, at);
    std::sort(by_level_.begin(), by_level_.end());
  }

  std::vector<Part> all(const OrganLaw& law) const {
    std::vector<Part> made;
    for (int level = law.least_hu; level <= law.most_hu; level += kStepHu)
      for (Part& one : pieces(law, level)) made.push_back(std::move(one));
    return made;
  }
  std::optional<Part> find(const OrganLaw& law) const {
    std::optional<Part> best;
    for (Part& one : all(law))
      if (!best || one.found.confidence > best->found.confidence) best = std::move(one);
    return best;
  }

 private:
  std::vector<Part> pieces(const OrganLaw& law, int level) const {
    const double wide_hu = std::max(law.wide_hu, grid_.noise_sd_hu);
    const auto first =
                   std::lower_bound(by_level_.begin(), by_level_.end(), std::pair(level - wide_hu, std::size_t{0})),
               last = std::lower_bound(first, by_level_.end(), std::pair(level + wide_hu, grid_.soft.size()));
    std::vector<Part> made;
    if (ml_of(static_cast<std::size_t>(last - first)) < law.least_ml / 2.0) return made;  // its edge is the rest
    Mask alike(grid_.soft.size(), 0);
    for (auto one = first; one != last; ++one) alike[one->second] = 1;
    if (law.vessel_mm > 0.0) {
      Voxels vessels;
      for (auto one = last; one != by_level_.end(); ++one)
        if (is_vessel_within(alike, one->second, law.vessel_mm)) vessels.push_back(one->second);
      for (const std::size_t at : vessels) alike[at] = kVessel;
    }
    for (const Voxels& cores : lattice_.pieces(lattice_.eroded(alike, law.reach_mm))) {
      if (ml_of(cores.size()) < 0.02 * law.least_ml || ml_of(cores.size()) > law.most_ml) continue;
      if (auto one = judged(law, level, alike, cores)) made.push_back(std::move(*one));
    }
    return made;
  }

  // In a third of all directions what is soft ends, both ways, in the organ, no farther than that apart.
  bool is_vessel_within(const Mask& alike, std::size_t at, double widest_mm) const {
    constexpr int kLeastWays = 4;  // of 13: those across a straight tube
    const glm::ivec3 from = lattice_.place(at);
    const auto steps_to_organ = [&](const glm::ivec3& way, int most) {
      for (int step = 1; step <= most; ++step) {
        const glm::ivec3 q = from + step * way;
        if (!lattice_.holds(q) || grid_.soft[lattice_.at(q)] == 0) break;
        if (alike[lattice_.at(q)] != 0) return step;
      }
      return 0;
    };
    int ways = 0;
    for (int which = 14; which < 27; ++which) {
      const glm::ivec3 way(which % 3 - 1, which / 3 % 3 - 1, which / 9 - 1);
      const int most = static_cast<int>(widest_mm / (kOrganGridMm * glm::length(glm::dvec3(way)))),
                one = steps_to_organ(way, most);
      if (one != 0 && steps_to_organ(-way, most + 1 - one) != 0 && ++ways == kLeastWays) return true;
    }
    return false;
  }

  std::optional<Part> judged(const OrganLaw& law, int level, const Mask& alike, const Voxels& cores) const {
    Mask in(alike.size(), 0);
    Part made;
    made.voxels = cores;
    for (const std::size_t at : cores) in[at] = 1;
    // Back to its edge, along voxels that are alike.
    std::size_t from = 0;
    const int steps = static_cast<int>(law.reach_mm / kOrganGridMm) + 2;
    for (int step = 0; step < steps; ++step) {
      const std::size_t end = made.voxels.size();
      for (; from < end; ++from)
        for (const glm::ivec3& way : kFaces) {
          const glm::ivec3 q = lattice_.place(made.voxels[from]) + way;
          if (!lattice_.holds(q) || alike[lattice_.at(q)] == 0 || in[lattice_.at(q)] != 0) continue;
          in[lattice_.at(q)] = 1;
          made.voxels.push_back(lattice_.at(q));
        }
    }
    // What lies nearer to it than to what is beyond, in HU, is its edge. Then what still joins it to more of the
    // same.
    const std::size_t inner = made.voxels.size();
    std::size_t faces = 0, joined = 0;
    glm::dvec3 centre(0.0);
    for (std::size_t which = 0; which < inner; ++which) {
      const glm::ivec3 p = lattice_.place(made.voxels[which]);
      centre += glm::dvec3(p);
      for (const glm::ivec3& way : kFaces) {
        const glm::ivec3 q = p + way, beyond = q + way;
        if (!lattice_.holds(q) || in[lattice_.at(q)] == 1) continue;
        ++faces;
        joined += alike[lattice_.at(q)] != 0 ? 1 : 0;
        if (in[lattice_.at(q)] != 0 || alike[lattice_.at(q)] != 0 || !lattice_.holds(beyond) ||
            in[lattice_.at(beyond)] == 1)
          continue;
        const double here = grid_.volume.hu[lattice_.at(q)], there = grid_.volume.hu[lattice_.at(beyond)];
        if (std::abs(here - level) < std::abs(here - there)) {
          in[lattice_.at(q)] = 2;
          made.voxels.push_back(lattice_.at(q));
        }
      }
    }
    centre /= static_cast<double>(inner);
    const glm::dvec2 off_mm =
        glm::dvec2(centre) * kOrganGridMm - middle_mm_[static_cast<std::size_t>(std::lround(centre.z))];
    if (!(off_mm.x >= law.low_mm.x && off_mm.y >= law.low_mm.y && off_mm.x <= law.high_mm.x &&
          off_mm.y <= law.high_mm.y))
      return std::nullopt;
    if (law.organ == FoundOrgan::bladder && !between_hips(glm::ivec3(glm::round(centre)))) return std::nullopt;
    made.voxels.erase(std::remove_if(made.voxels.begin(), made.voxels.end(),
                                     [&](std::size_t at) { return alike[at] == kVessel; }),
                      made.voxels.end());
    made.found.organ = law.organ;
    made.found.level_hu = level;
    made.found.ml = ml_of(made.voxels.size());
    if (!(made.found.ml >= law.least_ml && made.found.ml <= law.most_ml)) return std::nullopt;
    // Its own level is that it was looked for at: a window beside it takes in others.
    std::vector<float> levels;
    for (const std::size_t at : cores) levels.push_back(grid_.level_hu[at]);
    std::nth_element(levels.begin(), levels.begin() + static_cast<std::ptrdiff_t>(levels.size() / 2), levels.end());
    if (std::abs(double{levels[levels.size() / 2]} - level) > kStepHu / 2.0) return std::nullopt;
    // Of a ball of voxels' faces, which are half as many again as its surface.
    const double volume = static_cast<double>(inner),
                 ball_faces = 1.5 * std::cbrt(36.0 * std::numbers::pi * volume * volume);
    const double compact = ball_faces / static_cast<double>(faces);
    const double parted = 1.0 - static_cast<double>(joined) / static_cast<double>(faces);
    if (compact < law.compactness) return std::nullopt;
    made.found.confidence = std::clamp((parted - kHardlyParted) / (1.0 - kHardlyParted), 0.0, 1.0);
    return made;
  }

  // Bone at both sides, of hip or thigh.
  bool between_hips(const glm::ivec3& p) const {
    constexpr double kNearMm = 24.0, kFarMm = 120.0;
    const auto bone_at = [&](int side) {
      for (int off = static_cast<int>(kNearMm / kOrganGridMm); off <= static_cast<int>(kFarMm / kOrganGridMm);
           ++off)
        if (const glm::ivec3 q = p + glm::ivec3(side * off, 0, 0);
            lattice_.holds(q) && grid_.bone[lattice_.at(q)] != 0)
          return true;
      return false;
    };
    return bone_at(-1) && bone_at(1);
  }

  const OrganGrid& grid_;
  Lattice lattice_;
  const std::vector<glm::dvec2>& middle_mm_;
  std::vector<std::pair<double, std::size_t>> by_level_;  // level in HU and index of each soft voxel, in order
};

// Two kidneys are alike in level and size; one alone may be something else.
bool are_a_pair(const std::optional<Part>& right, const std::optional<Part>& left) {
  constexpr int kAlikeHu = 30;
  return right && left && std::abs(right->found.level_hu - left->found.level_hu) <= kAlikeHu &&
         std::max(right->found.ml, left->found.ml) <= 2.0 * std::min(right->found.ml, left->found.ml);
}

}  // namespace

std::vector<Part> find_solid_organs(const OrganGrid& grid, const std::vector<glm::dvec2>& middle_mm) {
  const Finder finder(grid, middle_mm);
  std::array<std::optional<Part>, kLaws.size()> found;
  for (std::size_t which = 0; which < kLaws.size(); ++which) found[which] = finder.find(kLaws[which]);
  if (!are_a_pair(found[kRightKidney], found[kLeftKidney]))
    for (const std::size_t which : {kRightKidney, kLeftKidney})
      if (found[which]) found[which]->found.confidence *= kDoubted;
  std::vector<Part> made;
  for (auto& one : found)
    if (one) made.push_back(std::move(*one));
  return made;
}

std::optional<Part> find_gallbladder(const OrganGrid& grid, const std::vector<glm::dvec2>& middle_mm,
                                     const std::vector<Part>& solid) {
  const Part* liver = nullptr;
  std::vector<const Part*> kidneys;
  for (const Part& one : solid) {
    if (one.found.confidence < kOrganConfidence) continue;
    if (one.found.organ == FoundOrgan::liver) liver = &one;
    if (one.found.organ == FoundOrgan::right_kidney || one.found.organ == FoundOrgan::left_kidney)
      kidneys.push_back(&one);
  }
  if (liver == nullptr) return std::nullopt;
  return gallbladder_among(grid, Finder(grid, middle_mm).all(kGallbladder), *liver, kidneys);
}

}  // namespace seldinger::volume
