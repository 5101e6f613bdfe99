#include "sim/volume/organs/great_vessels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>

namespace seldinger::volume {
namespace {

// Above muscle's level, 55 to 65 HU, as blood without contrast is not.
constexpr int kLeastBloodHu = 80, kMostBloodHu = 600;
constexpr double kStep = 1.05, kWideHu = 10.0, kWidePart = 0.08;
// Round discs of a slice, 11 to 34 mm across, before the spine: from the middle of the body's front.
constexpr double kAsideMm = 50.0, kAheadMm = 50.0, kBehindMm = 30.0;
constexpr int kDeepest = 2;  // grid voxels taken off before it is asked what is joined
constexpr double kLeastMm2 = 90.0, kMostMm2 = 900.0, kLeastRound = 0.6, kLeastParted = 0.5;
// From one slice to the next.
constexpr double kShiftMm = 6.0, kLevelPart = 0.1, kAreaPart = 1.7;
constexpr std::size_t kGapSlices = 5;  // where a vein or an artery of an organ comes in, it is not round
constexpr double kSureMm = 90.0;       // no loop of bowel runs straight as far
constexpr double kApartMm = 12.0;      // one vessel's middle from the other's

struct Disc {
  glm::dvec2 centre_mm{0.0}, off_mm{0.0};           // off: from the front of the vertebral body
  double level_hu = 0.0, widths = 0.0, good = 0.0;  // widths: to the side; good: 0 to 1, round and parted
  Voxels voxels;
  double sum = 0.0;  // of the best way up to here
  const Disc* before = nullptr;
};
using Slices = std::vector<std::vector<Disc>>;

double width_hu(double level) {
  return std::max(kWideHu, kWidePart * level);
}

bool is_alike(const OrganGrid& grid, const glm::ivec3& p, double level) {
  const Lattice lattice(grid.volume.size_voxels);
  return lattice.holds(p) && grid.soft[lattice.at(p)] != 0 &&
         std::abs(double{grid.level_hu[lattice.at(p)]} - level) <= width_hu(level);
}

class Discs {
 public:
  Discs(const OrganGrid& grid, const Spine& spine)
      : grid_(grid),
        spine_(spine),
        lattice_(grid.volume.size_voxels),
        seen_(grid.soft.size(), 0),
        depth_(lattice_.at({0, 0, 1}), 0) {}

  Slices find() {
    Slices made(spine_.bodies.size());
    for (int k = 0; k < lattice_.size().z; ++k)
      if (spine_.bodies[static_cast<std::size_t>(k)])
        for (double level = kLeastBloodHu; level <= kMostBloodHu; level *= kStep) slice(k, level, made);
    return made;
  }

 private:
  // Of a place of the slice: 0 where it is not alike, 1 at the rim of what is, to kDeepest + 1. Nothing is alike so
  // far from where vessels are looked for that none reaches there.
  int depth(const glm::ivec3& p) const {
    return p.x < low_.x || p.y < low_.y || p.x > high_.x || p.y > high_.y ? 0 : depth_[lattice_.at({p.x, p.y, 0})];
  }
  void find_depths(int k, double level, const glm::ivec2& low, const glm::ivec2& high) {
    constexpr int kBeside = 16;  // grid voxels, 48 mm: no disc that is round enough is so long
    low_ = glm::max(low - kBeside, glm::ivec2(0));
    high_ = glm::min(high + kBeside, glm::ivec2(lattice_.size()) - 1);
    const auto each = [&](const auto& what) {
      for (int j = low_.y; j <= high_.y; ++j)
        for (int i = low_.x; i <= high_.x; ++i) what(glm::ivec3(i, j, k), depth_[lattice_.at({i, j, 0})]);
    };
    each([&](const glm::ivec3& p, std::uint8_t& depth) { depth = is_alike(grid_, p, level) ? 1 : 0; });
    for (int deep = 1; deep <= kDeepest; ++deep)
      each([&](const glm::ivec3& p, std::uint8_t& its) {
        if (its == deep && depth(p + kFaces[0]) >= deep && depth(p + kFaces[1]) >= deep &&
            depth(p + kFaces[2]) >= deep && depth(p + kFaces[3]) >= deep)
          ++its;
      });
  }

  void slice(int k, double level, Slices& made) {
    const VertebralBody& body = *spine_.bodies[static_cast<std::size_t>(k)];
    const glm::dvec2 front_mm = body.centre_mm - glm::dvec2(0.0, body.half_depth_mm);
    const glm::ivec2 low(glm::floor((front_mm - glm::dvec2(kAsideMm, kAheadMm)) / kOrganGridMm)),
        high(glm::ceil((front_mm + glm::dvec2(kAsideMm, kBehindMm)) / kOrganGridMm));
    // What lies on a vessel and is of its level, as the heart in a late phase, is parted from it by a deeper core.
    find_depths(k, level, low, high);
    bool wide = true;
    for (int deep = 1; deep <= kDeepest && wide; ++deep) {
      wide = false;
      ++pass_;
      for (int j = low.y; j <= high.y; ++j)
        for (int i = low.x; i <= high.x; ++i) {
          const glm::ivec3 p(i, j, k);
          if (depth(p) <= deep || seen_[lattice_.at(p)] == pass_) continue;
          if (auto one = disc(p, level, deep, front_mm, body.half_width_mm, wide))
            made[static_cast<std::size_t>(k)].push_back(std::move(*one));
        }
    }
  }

  // `wide` becomes true where it is larger than any vessel.
  std::optional<Disc> disc(const glm::ivec3& from, double level, int deep, const glm::dvec2& front_mm,
                           double half_width_mm, bool& wide) {
    Disc made;
    seen_[lattice_.at(from)] = pass_;
    made.voxels.push_back(lattice_.at(from));
    const auto take = [&](const glm::ivec3& q) {
      if (!lattice_.holds(q) || seen_[lattice_.at(q)] == pass_) return;
      seen_[lattice_.at(q)] = pass_;
      made.voxels.push_back(lattice_.at(q));
    };
    for (std::size_t which = 0; which < made.voxels.size(); ++which)
      for (std::size_t way = 0; way < 4; ++way)
        if (const glm::ivec3 q = lattice_.place(made.voxels[which]) + kFaces[way]; depth(q) > deep) take(q);
    for (int step = 0; step < deep; ++step)
      for (std::size_t which = 0, cores = made.voxels.size(); which < cores; ++which)
        for (std::size_t way = 0; way < 4; ++way)
          if (const glm::ivec3 q = lattice_.place(made.voxels[which]) + kFaces[way]; depth(q) > 0) take(q);
    const double area_mm2 = static_cast<double>(made.voxels.size()) * kOrganGridMm * kOrganGridMm;
    wide |= area_mm2 > kMostMm2;
    if (area_mm2 < kLeastMm2 || area_mm2 > kMostMm2) return std::nullopt;
    double faces = 0.0, joined = 0.0, farthest_mm = 0.0;
    for (const std::size_t at : made.voxels) {
      made.centre_mm += glm::dvec2(lattice_.place(at)) * kOrganGridMm / static_cast<double>(made.voxels.size());
      made.level_hu += grid_.level_hu[at] / static_cast<double>(made.voxels.size());
    }
    for (const std::size_t at : made.voxels) {
      farthest_mm =
          std::max(farthest_mm, glm::length(glm::dvec2(lattice_.place(at)) * kOrganGridMm - made.centre_mm));
      for (std::size_t way = 0; way < 4; ++way) {
        const glm::ivec3 q = lattice_.place(at) + kFaces[way];
        if (lattice_.holds(q) && seen_[lattice_.at(q)] == pass_) continue;
        faces += 1.0;
        joined += depth(q) > 0 ? 1.0 : 0.0;
      }
    }
    const double reach_mm = farthest_mm + kOrganGridMm / 2.0,
                 round = area_mm2 / (std::numbers::pi * reach_mm * reach_mm), parted = 1.0 - joined / faces;
    if (round < kLeastRound || parted < kLeastParted || std::abs(made.level_hu - level) > width_hu(level) / 2.0)
      return std::nullopt;
    made.off_mm = made.centre_mm - front_mm;
    made.widths = std::abs(made.off_mm.x) / half_width_mm;
    made.good = std::min(1.0, round / 0.8) * parted;
    return made;
  }

  const OrganGrid& grid_;
  const Spine& spine_;
  Lattice lattice_;
  std::vector<std::uint32_t> seen_;
  std::uint32_t pass_ = 0;
  std::vector<std::uint8_t> depth_;  // of a slice, between low_ and high_
  glm::ivec2 low_{0}, high_{-1};
};

bool follows(const Disc& one, const Disc& next) {
  const double areas = static_cast<double>(next.voxels.size()) / static_cast<double>(one.voxels.size());
  return glm::length(next.centre_mm - one.centre_mm) <= kShiftMm &&
         std::abs(next.level_hu - one.level_hu) <= kLevelPart * one.level_hu && areas <= kAreaPart &&
         areas >= 1.0 / kAreaPart;
}

struct VesselLaw {
  FoundOrgan organ;
  double least_x_mm, most_x_mm;  // of each disc's middle
  double most_widths;            // to the side of the vertebral body, in halves of its width
};
// The aorta lies before the spine or left of it, the vena cava right.
constexpr VesselLaw kAorta{FoundOrgan::aorta, -8.0, 45.0, 2.2}, kVenaCava{FoundOrgan::vena_cava, -45.0, -4.0, 1.8};

std::vector<const Disc*> best_way(Slices& slices, const VesselLaw& law, const std::vector<const Disc*>& beside) {
  const Disc* best = nullptr;
  for (std::size_t k = 0; k < slices.size(); ++k)
    for (Disc& one : slices[k]) {
      one.sum = 0.0, one.before = nullptr;
      const bool by_other =
          k < beside.size() && beside[k] != nullptr && glm::length(one.centre_mm - beside[k]->centre_mm) < kApartMm;
      if (one.off_mm.x < law.least_x_mm || one.off_mm.x > law.most_x_mm || one.widths > law.most_widths || by_other)
        continue;
      for (std::size_t back = 1; back <= kGapSlices; ++back)
        if (k >= back)
          for (const Disc& before : slices[k - back])
            if (before.sum > one.sum && follows(before, one)) one.sum = before.sum, one.before = &before;
      one.sum += one.good;
      if (best == nullptr || one.sum > best->sum) best = &one;
    }
  std::vector<const Disc*> way(slices.size(), nullptr);
  for (std::size_t k = slices.size(); best != nullptr; best = best->before) {
    while (best < slices[k - 1].data() || best >= slices[k - 1].data() + slices[k - 1].size()) --k;
    way[k - 1] = best;
  }
  return way;
}

// Where it was not round: as far from its middle as a disc of the size of those around it.
void fill_gap(const OrganGrid& grid, std::size_t from, std::size_t to, const std::vector<const Disc*>& way,
              Voxels& voxels) {
  const Lattice lattice(grid.volume.size_voxels);
  const Disc &one = *way[from], &other = *way[to];
  const double reach =
                   std::sqrt(static_cast<double>(one.voxels.size() + other.voxels.size()) / 2.0 / std::numbers::pi),
               level = (one.level_hu + other.level_hu) / 2.0;
  for (std::size_t k = from + 1; k < to; ++k) {
    const glm::dvec2 middle =
        glm::mix(one.centre_mm, other.centre_mm, static_cast<double>(k - from) / static_cast<double>(to - from)) /
        kOrganGridMm;
    for (int j = static_cast<int>(middle.y - reach); j <= middle.y + reach; ++j)
      for (int i = static_cast<int>(middle.x - reach); i <= middle.x + reach; ++i) {
        const glm::ivec3 p(i, j, static_cast<int>(k));
        if (glm::length(glm::dvec2(i, j) - middle) <= reach && is_alike(grid, p, level))
          voxels.push_back(lattice.at(p));
      }
  }
}

Part vessel(const OrganGrid& grid, FoundOrgan organ, const std::vector<const Disc*>& way) {
  const Lattice lattice(grid.volume.size_voxels);
  Part made;
  double good = 0.0, discs = 0.0, level = 0.0;
  std::size_t first = 0, last = 0;
  for (std::size_t k = 0; k < way.size(); ++k) {
    if (way[k] == nullptr) continue;
    made.voxels.insert(made.voxels.end(), way[k]->voxels.begin(), way[k]->voxels.end());
    if (discs > 0.0)
      fill_gap(grid, last, k, way, made.voxels);
    else
      first = k;
    last = k;
    good += way[k]->good, discs += 1.0, level += way[k]->level_hu;
  }
  if (made.voxels.empty()) return made;
  level /= discs;
  const double length_mm = static_cast<double>(last - first + 1) * kOrganGridMm;
  good /= static_cast<double>(last - first + 1);
  // What lies nearer to it than to what is beyond, in HU, is its edge.
  Mask in(grid.soft.size(), 0);
  for (const std::size_t at : made.voxels) in[at] = 1;
  const std::size_t inner = made.voxels.size();
  for (std::size_t which = 0; which < inner; ++which)
    for (std::size_t way_out = 0; way_out < 4; ++way_out) {
      const glm::ivec3 q = lattice.place(made.voxels[which]) + kFaces[way_out], beyond = q + kFaces[way_out];
      if (!lattice.holds(beyond) || in[lattice.at(q)] != 0) continue;
      const double here = grid.volume.hu[lattice.at(q)], there = grid.volume.hu[lattice.at(beyond)];
      if (std::abs(here - level) >= std::abs(here - there)) continue;
      in[lattice.at(q)] = 2;
      made.voxels.push_back(lattice.at(q));
    }
  made.found = {organ, good * std::min(1.0, length_mm / kSureMm), ml_of(made.voxels.size()),
                static_cast<int>(std::lround(level))};
  return made;
}

}  // namespace

std::vector<Part> find_great_vessels(const OrganGrid& grid, const Spine& spine) {
  Slices slices = Discs(grid, spine).find();
  const std::vector<const Disc*> way = best_way(slices, kAorta, {});
  Part aorta = vessel(grid, kAorta.organ, way),
       vena_cava = vessel(grid, kVenaCava.organ, best_way(slices, kVenaCava, way));
  // It runs beside the aorta; where there is none, another vein may look like it.
  if (aorta.found.confidence < kOrganConfidence) vena_cava.found.confidence *= kDoubted;
  std::vector<Part> made;
  for (Part* one : {&aorta, &vena_cava})
    if (!one->voxels.empty()) made.push_back(std::move(*one));
  return made;
}

}  // namespace seldinger::volume
