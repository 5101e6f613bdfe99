#include "sim/volume/tissue/pools.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>
#include <utility>

#include "sim/volume/tissue/class_steps.h"

namespace seldinger::volume {
namespace pooling {  // files of a folder are compiled as one
namespace {

constexpr double kCoarseMm3 = 60.0;     // a little less than 4 mm a side
constexpr double kFineMm = 1.5;         // voxels below are smoothed
constexpr double kSmoothNoise = 0.375;  // of the noise that [1 2 1] x [1 2 1] / 16 leaves: sqrt(6 / 16)^2
constexpr int kLeastHu = 105;           // as the plateaus of rule 1: above muscle with its noise
constexpr double kRadiusMm = 3.5;       // thicker than the blurred cortex of ribs and laminae
constexpr double kEvenHu = 30.0, kEvenNoise = 3.0, kEvenShare = 0.06;  // mixing of contrast grows with it
// Marrow with cortex that a noisy coarse picture mixes differs more from voxel to voxel than noise alone.
constexpr double kSpongyHu = 180.0, kEvenSdHu = 12.0, kEvenSdNoise = 1.4, kEvenSdShare = 0.03;
constexpr int kRimHu = 45;                // four times the noise of a smoothed noisy picture
constexpr double kAcrossMarrowMm = 32.0;  // half a vertebral body and a little
constexpr double kHeldBy = 0.5, kHeldInner = 0.5;
constexpr double kCoarseHeldBy = 0.42;  // a vessel on bone is by a third
constexpr int kNoBloodHu = 600;         // blood of an early angiogram stays below 500
constexpr double kUrineMl = 20.0;       // as bright and even as this, and larger: a bladder full of contrast
constexpr std::size_t kRaysFrom = 400;  // of a pool's voxels
constexpr std::size_t kMostPools = 65000, kLeastCoarseCore = 3;  // fewer are even by chance
constexpr std::size_t kMostCost = 1500, kStepCost = 2;           // HU climbed and a little for the way

struct Grid {
  explicit Grid(const Volume& volume)
      : n(volume.size_voxels), row(static_cast<std::size_t>(n.x)), slice(row * static_cast<std::size_t>(n.y)) {}
  glm::ivec3 place(std::size_t at) const {
    return {static_cast<int>(at % row), static_cast<int>(at / row % static_cast<std::size_t>(n.y)),
            static_cast<int>(at / slice)};
  }
  bool inside(const glm::ivec3& p) const {
    return p.x >= 0 && p.y >= 0 && p.z >= 0 && p.x < n.x && p.y < n.y && p.z < n.z;
  }
  std::ptrdiff_t step(const glm::ivec3& by) const {
    return by.x + by.y * static_cast<std::ptrdiff_t>(row) + by.z * static_cast<std::ptrdiff_t>(slice);
  }
  template <typename Visit>
  void neighbours(std::size_t at, const Visit& visit) const {
    const glm::ivec3 p = place(at);
    if (p.x > 0) visit(at - 1);
    if (p.x + 1 < n.x) visit(at + 1);
    if (p.y > 0) visit(at - row);
    if (p.y + 1 < n.y) visit(at + row);
    if (p.z > 0) visit(at - slice);
    if (p.z + 1 < n.z) visit(at + slice);
  }
  glm::ivec3 n;
  std::size_t row, slice;
};

// The places of a ball's surface and half way to it, in voxels.
std::vector<glm::ivec3> ball(const glm::dvec3& spacing_mm) {
  const glm::dvec3 r = glm::max(glm::round(kRadiusMm / spacing_mm), 1.0);
  std::vector<glm::ivec3> places;
  for (int z = -1; z <= 1; ++z)
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x) {
        const glm::dvec3 way(x, y, z);
        const double length = glm::length(way);
        if (length == 0.0 || length > 1.5) continue;
        for (const double far : {1.0, 0.5}) {
          const glm::ivec3 place(glm::round(way / length * r * far));
          if (place != glm::ivec3(0) && std::find(places.begin(), places.end(), place) == places.end())
            places.push_back(place);
        }
      }
  return places;
}

class Finder {
 public:
  Finder(const Volume& volume, const Smooth& smooth, const std::vector<TissueClass>& classes, Pools& out)
      : grid_(volume),
        spacing_mm_(volume.spacing_mm),
        hu_(smooth.hu),
        classes_(classes),
        out_(out),
        coarse_(is_coarse(volume)),
        even_hu_(kEvenHu + kEvenNoise * smooth.noise_sd_hu),
        sd_hu_(kEvenSdHu + kEvenSdNoise * smooth.noise_sd_hu),
        noise_hu_(static_cast<int>(std::lround(smooth.noise_sd_hu))) {}

  void find() {
    out_.of.assign(hu_.size(), 0);
    out_.core.assign(hu_.size(), 0);
    mark_cores();
    number_cores();
    tell_marrow();
    drain();
  }

 private:
  bool open(std::size_t at) const { return classes_[at] == TissueClass::soft_tissue; }
  double tolerance(int hu) const { return even_hu_ + kEvenShare * hu; }

  void mark_cores() {
    const std::vector<glm::ivec3> places = ball(spacing_mm_);
    glm::ivec3 reach(0);
    std::vector<std::ptrdiff_t> steps;
    for (const glm::ivec3& place : places) {
      reach = glm::max(reach, glm::abs(place));
      steps.push_back(grid_.step(place));
    }
    for (int k = 0; k < grid_.n.z; ++k)
      for (int j = reach.y; j + reach.y < grid_.n.y; ++j) {
        const std::size_t start =
            static_cast<std::size_t>(k) * grid_.slice + static_cast<std::size_t>(j) * grid_.row;
        for (int i = reach.x; i + reach.x < grid_.n.x; ++i) {
          const std::size_t at = start + static_cast<std::size_t>(i);
          if (hu_[at] < kLeastHu || !open(at)) continue;
          const double most = tolerance(hu_[at]);
          bool even = true;
          double sum = hu_[at], square = sum * sum, count = 1.0;
          for (std::size_t s = 0; s < steps.size() && even; ++s) {
            const int z = k + places[s].z;
            if (z < 0 || z >= grid_.n.z) continue;  // beyond the volume it goes on
            const std::size_t other = at + static_cast<std::size_t>(steps[s]);
            even = open(other) && std::abs(hu_[other] - hu_[at]) <= most;
            sum += hu_[other];
            square += static_cast<double>(hu_[other]) * hu_[other];
            count += 1.0;
          }
          const double mean = sum / count;
          even = even && (!coarse_ || mean < kSpongyHu ||
                          square / count - mean * mean <= std::pow(sd_hu_ + kEvenSdShare * mean, 2.0));
          if (even) out_.core[at] = 1;
        }
      }
  }

  // Pieces of cores that touch and are alike, each a pool.
  void number_cores() {
    std::vector<std::size_t> front;
    for (std::size_t seed = 0; seed < hu_.size(); ++seed) {
      if (out_.core[seed] == 0 || out_.of[seed] != 0) continue;
      std::vector<std::size_t> members;
      const auto number = static_cast<std::uint16_t>(out_.pools.size() + 1);
      front.assign(1, seed);
      out_.of[seed] = number;
      while (!front.empty()) {
        const std::size_t at = front.back();
        front.pop_back();
        members.push_back(at);
        grid_.neighbours(at, [&](std::size_t other) {
          if (out_.core[other] == 0 || out_.of[other] != 0 || std::abs(hu_[other] - hu_[at]) > even_hu_) return;
          out_.of[other] = number;
          front.push_back(other);
        });
      }
      if ((coarse_ && members.size() < kLeastCoarseCore) || out_.pools.size() >= kMostPools) {
        for (const std::size_t at : members) {
          out_.core[at] = 0;
          out_.of[at] = 0;
        }
        continue;
      }
      out_.pools.emplace_back();
      members_.push_back(std::move(members));
      std::vector<std::int16_t> values;
      for (const std::size_t at : members_.back()) values.push_back(hu_[at]);
      std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                       values.end());
      out_.pools.back().level_hu = values[values.size() / 2];
      out_.pools.back().inner = values.size();
    }
  }

  // Every pool takes what it reaches by the least climbing up and down. Contrast runs downhill only: a rise of more
  // than noise belongs to something else.
  void drain() {
    struct Reached {
      std::size_t at;
      std::int16_t lowest_hu;
      std::uint16_t pool;
    };
    std::vector<std::vector<Reached>> buckets(kMostCost + 1);
    std::vector<std::uint8_t> done(hu_.size(), 0);
    for (std::size_t which = 0; which < members_.size(); ++which)
      for (const std::size_t at : members_[which])
        buckets[0].push_back({at, hu_[at], static_cast<std::uint16_t>(which + 1)});
    for (std::size_t cost = 0; cost < buckets.size(); ++cost) {
      for (std::size_t next = 0; next < buckets[cost].size(); ++next) {
        const Reached from = buckets[cost][next];
        if (done[from.at] != 0) continue;
        done[from.at] = 1;
        out_.of[from.at] = from.pool;
        const bool bone = out_.pools[from.pool - 1U].marrow;
        const int level = out_.pools[from.pool - 1U].level_hu;
        grid_.neighbours(from.at, [&](std::size_t other) {
          if (done[other] != 0 || !open(other) || hu_[other] < kLeastHu) return;
          if (!bone && hu_[other] > from.lowest_hu + even_hu_) return;
          // Blood of an early angiogram, brighter than spongy bone, runs on without cost.
          const bool blood = !bone && level >= kAboveSpongyHu && std::abs(hu_[other] - level) <= even_hu_;
          const std::size_t to =
              blood ? cost
                    : cost + kStepCost +
                          static_cast<std::size_t>(std::max(0, std::abs(hu_[other] - hu_[from.at]) - noise_hu_));
          if (to < buckets.size()) buckets[to].push_back({other, std::min(from.lowest_hu, hu_[other]), from.pool});
        });
      }
      buckets[cost] = {};
    }
  }

  // Of 26 directions from a core's voxel those in which it ends at something brighter; -1 where none can be told.
  double rim_share(std::size_t from) const {
    const glm::ivec3 p = grid_.place(from);
    const int level = hu_[from];
    const double ends = level - 2.0 * even_hu_;
    int rim = 0, told = 0;
    for (int z = -1; z <= 1; ++z)
      for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
          const glm::ivec3 way(x, y, z);
          const double step_mm = glm::length(glm::dvec3(way) * spacing_mm_);
          if (step_mm == 0.0) continue;
          const int steps = std::max(1, static_cast<int>(kAcrossMarrowMm / step_mm));
          glm::ivec3 q = p;
          bool rimmed = false, left = false;
          for (int step = 0; step < steps; ++step) {
            q += way;
            if (!grid_.inside(q)) {
              left = true;
              break;
            }
            const std::size_t at = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(0) + grid_.step(q));
            if (!open(at) || hu_[at] < ends) break;
            if (hu_[at] >= level + kRimHu) {
              rimmed = out_.core[at] == 0 || out_.pools[out_.of[at] - 1U].marrow;
              break;
            }
          }
          if (left) continue;
          ++told;
          rim += rimmed ? 1 : 0;
        }
    return told < 9 ? -1.0 : static_cast<double>(rim) / told;
  }

  // Brighter ones first: what is brighter than marrow and a pool itself is no rim.
  void tell_marrow() {
    std::vector<std::size_t> order(out_.pools.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return out_.pools[a].level_hu > out_.pools[b].level_hu; });
    for (const std::size_t which : order) {
      const auto& members = members_[which];
      const std::size_t stride = std::max<std::size_t>(1, members.size() / kRaysFrom);
      std::size_t told = 0, held = 0;
      double sum = 0.0;
      for (std::size_t at = 0; at < members.size(); at += stride) {
        const double share = rim_share(members[at]);
        if (share < 0.0) continue;
        ++told;
        sum += share;
        held += share >= (coarse_ ? kCoarseHeldBy : kHeldBy) ? 1 : 0;
      }
      Pool& pool = out_.pools[which];
      const double ml = static_cast<double>(pool.inner) * spacing_mm_.x * spacing_mm_.y * spacing_mm_.z * 1e-3;
      if (pool.level_hu >= kNoBloodHu && ml < kUrineMl) pool.marrow = true;
      if (told == 0 || pool.marrow) continue;
      pool.rim_share = sum / static_cast<double>(told);
      pool.marrow = pool.spongy = static_cast<double>(held) >= kHeldInner * static_cast<double>(told);
    }
  }

  Grid grid_;
  glm::dvec3 spacing_mm_;
  const std::vector<std::int16_t>& hu_;
  const std::vector<TissueClass>& classes_;
  Pools& out_;
  bool coarse_;
  double even_hu_, sd_hu_;
  int noise_hu_;
  std::vector<std::vector<std::size_t>> members_;
};

}  // namespace
}  // namespace pooling

bool is_coarse(const Volume& volume) noexcept {
  return volume.spacing_mm.x * volume.spacing_mm.y * volume.spacing_mm.z > pooling::kCoarseMm3;
}

Smooth smooth_of(const Volume& volume, const std::vector<TissueClass>& classes) {
  Smooth made;
  const bool fine = std::max(volume.spacing_mm.x, volume.spacing_mm.y) <= pooling::kFineMm;
  // Noise of coarse voxels hangs together less, and most of their differences are of two tissues.
  made.noise_sd_hu = noise_sd_hu(volume, classes,
                                 fine                ? NoiseFrom{}
                                 : is_coarse(volume) ? NoiseFrom{1, 0.25, 0.451}
                                                     : NoiseFrom{.apart = 1});
  if (!fine) {
    made.hu = volume.hu;
    return made;
  }
  made.noise_sd_hu *= pooling::kSmoothNoise;
  made.hu.resize(volume.hu.size());
  const std::size_t slice =
      static_cast<std::size_t>(volume.size_voxels.x) * static_cast<std::size_t>(volume.size_voxels.y);
  std::vector<std::int16_t> smooth;
  for (int k = 0; k < volume.size_voxels.z; ++k) {
    smooth_slice(volume, k, smooth);
    std::copy(smooth.begin(), smooth.end(),
              made.hu.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(k) * slice));
  }
  return made;
}

Pools find_pools(const Volume& volume, const Smooth& smooth, const std::vector<TissueClass>& classes) {
  Pools made;
  pooling::Finder(volume, smooth, classes, made).find();
  return made;
}

}  // namespace seldinger::volume
