#include "sim/volume/organs/find_organs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <numbers>
#include <optional>

#include "sim/base/check.h"
#include "sim/volume/components.h"
#include "sim/volume/organs/organ_grid.h"

namespace seldinger::volume {
namespace {

// Where an organ lies from the spine (LPS: +x left, +y back), its size, adults' and children's, and its level:
// above that of muscle, 55 to 65 HU (Bae, Radiology 2010;256:32), which lies beside every organ.
struct OrganLaw {
  FoundOrgan organ;
  glm::dvec2 low_mm, high_mm;  // of its centre from the spine
  double least_ml, most_ml;
  int least_hu;
  double wide_hu;      // to each side of its level: a kidney has cortex and medulla
  double reach_mm;     // a neck thinner than twice this parts it from others
  double compactness;  // least; of a ball 1
};
constexpr std::array<OrganLaw, 4> kLaws{{
    {FoundOrgan::right_kidney, {-95.0, -45.0}, {-25.0, 40.0}, 60.0, 350.0, 100, 30.0, 6.0, 0.45},
    {FoundOrgan::left_kidney, {25.0, -45.0}, {95.0, 40.0}, 60.0, 350.0, 100, 30.0, 6.0, 0.45},
    {FoundOrgan::liver, {-130.0, -130.0}, {0.0, 0.0}, 500.0, 3000.0, 78, 12.0, 12.0, 0.35},
    {FoundOrgan::spleen, {70.0, -60.0}, {150.0, 60.0}, 60.0, 700.0, 78, 12.0, 6.0, 0.4},
}};
constexpr double kHardlyParted = 0.6;  // of its faces: what is joined to more is no organ of its own
constexpr int kMostHu = 260, kStepHu = 4;

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

constexpr std::array<glm::ivec3, 6> kFaces{{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}};

struct Candidate {
  OrganFound found;
  std::vector<std::size_t> voxels;
};

class Finder {
 public:
  explicit Finder(const OrganGrid& grid) : grid_(grid), n_(grid.volume.size_voxels) { find_spine(); }

  bool has_spine() const { return !spine_mm_.empty(); }

  std::optional<Candidate> find(const OrganLaw& law) const {
    std::optional<Candidate> best;
    for (int level = law.least_hu; level <= kMostHu; level += kStepHu)
      for (Candidate& one : pieces(law, level))
        if (!best || one.found.confidence > best->found.confidence) best = std::move(one);
    return best;
  }

 private:
  std::size_t index(const glm::ivec3& p) const { return grid_.volume.index(p.x, p.y, p.z); }
  glm::ivec3 place(std::size_t at) const {
    const auto nx = static_cast<std::size_t>(n_.x), ny = static_cast<std::size_t>(n_.y);
    return {static_cast<int>(at % nx), static_cast<int>(at / nx % ny), static_cast<int>(at / (nx * ny))};
  }
  bool holds(const glm::ivec3& p) const {
    return p.x >= 0 && p.y >= 0 && p.z >= 0 && p.x < n_.x && p.y < n_.y && p.z < n_.z;
  }
  static constexpr double ml(std::size_t voxels) {
    return static_cast<double>(voxels) * kOrganGridMm * kOrganGridMm * kOrganGridMm * 1e-3;
  }

  // In grid mm, by slice: the mean of the bone in the middle of the back half of the body, and of slices around.
  void find_spine() {
    constexpr double kAsideMm = 40.0;
    constexpr int kAround = 8;
    std::vector<glm::dvec3> sums(static_cast<std::size_t>(n_.z));  // x, y, count
    for (int k = 0; k < n_.z; ++k) {
      glm::ivec2 low(n_.x, n_.y), high(-1);
      double middle = 0.0, count = 0.0;
      for (int j = 0; j < n_.y; ++j)
        for (int i = 0; i < n_.x; ++i)
          if (grid_.body[index({i, j, k})] != 0) {
            low = glm::min(low, glm::ivec2(i, j)), high = glm::max(high, glm::ivec2(i, j));
            middle += i, count += 1.0;
          }
      if (count == 0.0) continue;
      middle /= count;
      for (int j = (low.y + high.y) / 2; j <= high.y; ++j)
        for (int i = low.x; i <= high.x; ++i)
          if (grid_.bone[index({i, j, k})] != 0 && std::abs(i - middle) * kOrganGridMm <= kAsideMm)
            sums[static_cast<std::size_t>(k)] += glm::dvec3(i, j, 1);
    }
    std::vector<glm::dvec2> made(sums.size());
    for (int k = 0; k < n_.z; ++k) {
      glm::dvec3 sum(0.0);
      for (int z = std::max(0, k - kAround); z <= std::min(n_.z - 1, k + kAround); ++z)
        sum += sums[static_cast<std::size_t>(z)];
      if (sum.z == 0.0) return;
      made[static_cast<std::size_t>(k)] = glm::dvec2(sum) / sum.z * kOrganGridMm;
    }
    spine_mm_ = std::move(made);
  }

  std::vector<Candidate> pieces(const OrganLaw& law, int level) const {
    const double wide_hu = std::max(law.wide_hu, grid_.noise_sd_hu);
    std::vector<std::uint8_t> alike(grid_.soft.size(), 0), core(grid_.soft.size(), 0);
    for (std::size_t at = 0; at < alike.size(); ++at)
      alike[at] = grid_.soft[at] != 0 && std::abs(double{grid_.level_hu[at]} - level) <= wide_hu ? 1 : 0;
    const std::vector<glm::ivec3> offsets = ball(law.reach_mm);
    for (std::size_t at = 0; at < alike.size(); ++at) {
      if (alike[at] == 0) continue;
      const glm::ivec3 p = place(at);
      core[at] = std::all_of(offsets.begin(), offsets.end(),
                             [&](const glm::ivec3& off) { return !holds(p + off) || alike[index(p + off)] != 0; });
    }
    Components parts(n_, core);
    std::vector<std::vector<std::size_t>> members(parts.numbers());
    parts.each_run([&](std::size_t part, std::size_t begin, std::size_t end) {
      for (std::size_t at = begin; at < end; ++at) members[part].push_back(at);
    });
    std::vector<Candidate> made;
    for (const std::vector<std::size_t>& cores : members) {
      if (ml(cores.size()) < 0.02 * law.least_ml || ml(cores.size()) > law.most_ml) continue;
      if (auto one = judged(law, level, alike, cores)) made.push_back(std::move(*one));
    }
    return made;
  }

  std::optional<Candidate> judged(const OrganLaw& law, int level, const std::vector<std::uint8_t>& alike,
                                  const std::vector<std::size_t>& cores) const {
    std::vector<std::uint8_t> in(alike.size(), 0);
    Candidate made;
    made.voxels = cores;
    for (const std::size_t at : cores) in[at] = 1;
    // Back to its edge, along voxels that are alike.
    std::size_t from = 0;
    const int steps = static_cast<int>(law.reach_mm / kOrganGridMm) + 2;
    for (int step = 0; step < steps; ++step) {
      const std::size_t end = made.voxels.size();
      for (; from < end; ++from)
        for (const glm::ivec3& way : kFaces) {
          const glm::ivec3 q = place(made.voxels[from]) + way;
          if (!holds(q) || alike[index(q)] == 0 || in[index(q)] != 0) continue;
          in[index(q)] = 1;
          made.voxels.push_back(index(q));
        }
    }
    // What lies nearer to it than to what is beyond, in HU, is its edge. Then what still joins it to more of the
    // same.
    const std::size_t inner = made.voxels.size();
    std::size_t faces = 0, joined = 0;
    glm::dvec3 centre(0.0);
    for (std::size_t which = 0; which < inner; ++which) {
      const glm::ivec3 p = place(made.voxels[which]);
      centre += glm::dvec3(p);
      for (const glm::ivec3& way : kFaces) {
        const glm::ivec3 q = p + way, beyond = q + way;
        if (!holds(q) || in[index(q)] == 1) continue;
        ++faces;
        joined += alike[index(q)];
        if (in[index(q)] != 0 || alike[index(q)] != 0 || !holds(beyond) || in[index(beyond)] == 1) continue;
        const double here = grid_.volume.hu[index(q)], there = grid_.volume.hu[index(beyond)];
        if (std::abs(here - level) < std::abs(here - there)) {
          in[index(q)] = 2;
          made.voxels.push_back(index(q));
        }
      }
    }
    centre /= static_cast<double>(inner);
    const glm::dvec2 off_mm =
        glm::dvec2(centre) * kOrganGridMm - spine_mm_[static_cast<std::size_t>(std::lround(centre.z))];
    if (!(off_mm.x >= law.low_mm.x && off_mm.y >= law.low_mm.y && off_mm.x <= law.high_mm.x &&
          off_mm.y <= law.high_mm.y))
      return std::nullopt;
    made.found.organ = law.organ;
    made.found.level_hu = level;
    made.found.ml = ml(made.voxels.size());
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

  const OrganGrid& grid_;
  glm::ivec3 n_;
  std::vector<glm::dvec2> spine_mm_;  // empty: not found
};

// Two kidneys are alike in level and size; one alone may be something else.
bool are_a_pair(const std::optional<Candidate>& right, const std::optional<Candidate>& left) {
  constexpr int kAlikeHu = 30;
  return right && left && std::abs(right->found.level_hu - left->found.level_hu) <= kAlikeHu &&
         std::max(right->found.ml, left->found.ml) <= 2.0 * std::min(right->found.ml, left->found.ml);
}

}  // namespace

Organs find_organs(const Volume& volume, const std::vector<TissueClass>& classes) {
  CHECK(classes.size() == volume.hu.size());
  OrganGrid grid = organ_grid(volume, classes);
  Organs made;
  made.at.assign(grid.volume.hu.size(), FoundOrgan::none);
  const Finder finder(grid);
  std::array<std::optional<Candidate>, kLaws.size()> candidates;
  for (std::size_t which = 0; which < kLaws.size() && finder.has_spine(); ++which)
    candidates[which] = finder.find(kLaws[which]);
  if (!are_a_pair(candidates[0], candidates[1]))
    for (std::size_t which : {0, 1})
      if (candidates[which]) candidates[which]->found.confidence /= 2.0;
  for (const auto& one : candidates) {
    if (!one) continue;
    made.found.push_back(one->found);
    if (one->found.confidence < kOrganConfidence) continue;
    for (const std::size_t at : one->voxels)
      if (made.at[at] == FoundOrgan::none) made.at[at] = one->found.organ;
  }
  made.grid = std::move(grid.volume);
  return made;
}

}  // namespace seldinger::volume
