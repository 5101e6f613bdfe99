#include "sim/imaging/ultrasound/view/organs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "shaders/shared/ultrasound.glsl.h"
#include "sim/base/check.h"
#include "sim/base/rows.h"
#include "sim/imaging/ultrasound/view/echogenicity.h"
#include "sim/imaging/ultrasound/view/tissue.h"

namespace seldinger::imaging {
namespace {

using volume::TissueClass;

// The order is the atlases' (recalled: sinus over pancreas over liver and spleen over renal cortex over pyramids;
// fat under the skin dark with bright septa, about the bowel bright); by how many dB is tuned for display, so that
// neighbours differ by at least 3 dB where they are told apart by eye.
constexpr std::array<OrganRow, kOrgans> kOrganRows{{
    {Organ::none, "as its class", 0.0, ""},
    {Organ::skin, "skin", 5.0, "bright line (recalled); tuned"},
    {Organ::fat_under_skin, "fat under the skin", -5.0, "dark with bright septa (recalled); tuned"},
    {Organ::fascia, "fascia", 8.0, "bright lines about muscle (recalled); tuned"},
    {Organ::muscle, "muscle", -8.0, "dark with bright fibres (recalled); tuned"},
    {Organ::fat_inside, "fat about organs", 3.0, "brighter than liver (recalled); tuned"},
    {Organ::diaphragm, "diaphragm", 7.0, "a bright line (recalled); tuned"},
    {Organ::spleen, "spleen", 0.5, "about liver, a little over it (recalled); tuned"},
    {Organ::kidney_cortex, "renal cortex", -4.0, "darker than liver (recalled); tuned"},
    {Organ::kidney_pyramid, "renal pyramids", -9.0, "darker than the cortex (recalled); tuned"},
    {Organ::kidney_sinus, "renal sinus", 6.0, "the brightest of the kidney (recalled); tuned"},
    {Organ::bowel_wall, "bowel wall", -6.0, "its muscle, dark (recalled); tuned"},
    {Organ::portal_wall, "portal vein's wall", 7.0, "bright about a black lumen (recalled); tuned"},
}};

constexpr float kFar = 1e6F;
constexpr double kThinnestWallMm = 3.0;  // what is thinner is a fleck of noise or a vessel in the fat

bool is_fatty(TissueClass tissue) {
  return tissue == TissueClass::fat;
}
bool may_be_muscle(TissueClass tissue) {
  return tissue == TissueClass::muscle || tissue == TissueClass::soft_tissue || tissue == TissueClass::connective;
}

// From 0 to 1, of a cell of space.
float noise_of_cell(std::uint32_t key, const glm::ivec3& cell) {
  const std::uint32_t bits = shaders::us_lattice_bits(shaders::us_lattice_seed(key, cell.x, cell.y, cell.z));
  return static_cast<float>(bits >> 8) * 0x1.0p-24F;
}
// The same between cells: smooth enough to bend what is drawn by it.
float smooth_noise(std::uint32_t key, const glm::vec3& p) {
  const glm::vec3 low = glm::floor(p), part = p - low;
  const glm::ivec3 cell(low);
  float sum = 0.0F;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::ivec3 step(corner & 1, (corner >> 1) & 1, corner >> 2);
    const glm::vec3 weight = glm::mix(1.0F - part, part, glm::vec3(step));
    sum += weight.x * weight.y * weight.z * noise_of_cell(key, cell + step);
  }
  return sum;
}

// Sheets some mm apart, bent and broken: where a voxel is of one, it is brighter by `bright_db`, and the rest
// darker so that the mean stays.
struct Sheets {
  float apart_mm, thick_share, bent_mm, bright_db;
  std::uint32_t key;
};
constexpr Sheets kSepta{6.5F, 0.2F, 9.0F, 9.0F, 11U}, kFibres{4.0F, 0.3F, 4.0F, 7.0F, 12U};

// The level of the rest, for the mean to be 0.
double rest_db(const Sheets& sheets) {
  const double share = 0.75 * static_cast<double>(sheets.thick_share);  // a quarter is broken away
  return -10.0 * std::log10(1.0 - share + share * std::pow(10.0, 0.1 * static_cast<double>(sheets.bright_db)));
}
bool in_sheet(const Sheets& sheets, float depth_mm, const glm::vec3& p) {
  const float bent = depth_mm + sheets.bent_mm * smooth_noise(sheets.key, p / 14.0F);
  const float turns = bent / sheets.apart_mm;
  if (turns - std::floor(turns) >= sheets.thick_share) return false;
  return noise_of_cell(sheets.key + 7U, glm::ivec3(glm::floor(p / 5.0F))) >= 0.25F;
}

// Pyramids lie side by side about the sinus, cortex between them.
bool in_pyramid(const glm::vec3& p) {
  constexpr float kApartMm = 12.0F, kHalfMm = 5.0F;
  const glm::vec3 cell = glm::floor(p / kApartMm);
  const glm::vec3 off = p - (cell + 0.5F) * kApartMm;
  return glm::dot(off, off) <= kHalfMm * kHalfMm;
}

// One slice: ways within it are enough, for a trunk's layers run along it.
class SliceOfOrgans {
 public:
  SliceOfOrgans(const volume::Volume& volume, std::span<const TissueClass> classes)
      : nx_(volume.size_voxels.x),
        ny_(volume.size_voxels.y),
        dx_(static_cast<float>(volume.spacing_mm.x)),
        dy_(static_cast<float>(volume.spacing_mm.y)),
        lps_from_voxel_(volume.lps_from_voxel),
        classes_(classes) {}

  // What each voxel of slice k is.
  void tell(int k, std::span<Organ> organs) {
    here_ = classes_.subspan(static_cast<std::size_t>(k) * size(), size());
    const auto outside = [&](std::size_t i) { return here_[i] == TissueClass::air; };
    spread(outside, depth_);
    spread_wall();
    find_sinus();
    spread([&](std::size_t i) { return here_[i] != TissueClass::kidney && !sinus_[i]; }, in_kidney_);
    spread([&](std::size_t i) { return here_[i] == TissueClass::lung; }, from_lung_);
    spread([&](std::size_t i) { return here_[i] == TissueClass::gas; }, from_gas_);
    spread([&](std::size_t i) { return here_[i] == TissueClass::fat && wall_[i] > 0.0F; }, from_inner_fat_);
    for (std::size_t i = 0; i < size(); ++i) {
      organs[i] = organ_at(i);
      if (organs[i] == Organ::kidney_pyramid && !in_pyramid(place(i, k))) organs[i] = Organ::kidney_cortex;
    }
  }
  // And its level over liver, of what was told last.
  double level_db(std::size_t i, int k, Organ organ) const {
    const double mean_db = kOrganRows[static_cast<std::size_t>(organ)].level_db;
    const Sheets* sheets = organ == Organ::fat_under_skin ? &kSepta : organ == Organ::muscle ? &kFibres : nullptr;
    if (sheets == nullptr) return mean_db;
    const double above_db =
        in_sheet(*sheets, depth_[i], place(i, k)) ? static_cast<double>(sheets->bright_db) : 0.0;
    return mean_db + rest_db(*sheets) + above_db;
  }
  std::size_t size() const { return static_cast<std::size_t>(nx_) * static_cast<std::size_t>(ny_); }

 private:
  glm::vec3 place(std::size_t i, int k) const {
    const auto nx = static_cast<std::size_t>(nx_);
    return glm::vec3(lps_from_voxel_ *
                     glm::dvec4(static_cast<double>(i % nx), static_cast<double>(i / nx), k, 1.0));
  }

  // Over a slice there and back, each voxel from the four before it (chamfer distance, within 8 %).
  template <typename Take>
  void sweep(const Take& take) const {
    const float diagonal = std::sqrt(dx_ * dx_ + dy_ * dy_);
    for (int way = 0; way < 2; ++way) {
      const int step = way == 0 ? 1 : -1;
      for (int y = way == 0 ? 0 : ny_ - 1; y >= 0 && y < ny_; y += step)
        for (int x = way == 0 ? 0 : nx_ - 1; x >= 0 && x < nx_; x += step) {
          const auto at = [&](int i, int j) {
            return static_cast<std::size_t>(i) + static_cast<std::size_t>(nx_) * static_cast<std::size_t>(j);
          };
          const bool left = x - step >= 0 && x - step < nx_, above = y - step >= 0 && y - step < ny_,
                     right = x + step >= 0 && x + step < nx_;
          if (left) take(at(x, y), at(x - step, y), dx_);
          if (above) take(at(x, y), at(x, y - step), dy_);
          if (left && above) take(at(x, y), at(x - step, y - step), diagonal);
          if (right && above) take(at(x, y), at(x + step, y - step), diagonal);
        }
    }
  }
  template <typename From>
  void spread(const From& from, std::vector<float>& distance) const {
    distance.resize(size());
    std::size_t near = 0;
    for (std::size_t i = 0; i < size(); ++i) {
      distance[i] = from(i) ? 0.0F : kFar;
      near += distance[i] == 0.0F ? 1 : 0;
    }
    if (near == 0 || near == size()) return;  // nothing there to be far from
    sweep([&](std::size_t to, std::size_t before, float mm) {
      distance[to] = std::min(distance[to], distance[before] + mm);
    });
  }
  // How far a voxel lies behind the first that is neither skin nor fat, on its shortest way from outside; 0: there
  // is none.
  void spread_wall() {
    std::vector<float>& far = reach_;
    far.assign(size(), kFar);
    wall_.assign(size(), 0.0F);
    for (std::size_t i = 0; i < size(); ++i)
      if (here_[i] == TissueClass::air) far[i] = 0.0F;
    sweep([&](std::size_t to, std::size_t before, float mm) {
      if (!(far[before] + mm < far[to])) return;
      far[to] = far[before] + mm;
      const bool deep = far[to] > static_cast<float>(kSkinMm) + std::max(dx_, dy_);
      const bool other = deep && !is_fatty(here_[to]) && here_[to] != TissueClass::skin;
      const float through_mm = wall_[before] > 0.0F || other ? wall_[before] + mm : 0.0F;
      wall_[to] = other || through_mm > static_cast<float>(kThinnestWallMm) ? through_mm : 0.0F;
    });
  }
  // Fat and urine with kidney on three sides or more: at the hilum it is open.
  void find_sinus() {
    sinus_.assign(size(), 0);
    if (std::find(here_.begin(), here_.end(), TissueClass::kidney) == here_.end()) return;
    constexpr float kReachMm = 30.0F;
    const int far_x = static_cast<int>(kReachMm / dx_), far_y = static_cast<int>(kReachMm / dy_);
    for (int y = 0; y < ny_; ++y)
      for (int x = 0; x < nx_; ++x) {
        const std::size_t at =
            static_cast<std::size_t>(x) + static_cast<std::size_t>(nx_) * static_cast<std::size_t>(y);
        if (here_[at] != TissueClass::fat && here_[at] != TissueClass::fluid) continue;
        int sides = 0;
        for (const auto& [i, j] : {std::pair(1, 0), std::pair(-1, 0), std::pair(0, 1), std::pair(0, -1)})
          sides += meets_kidney(x, y, i, j, i != 0 ? far_x : far_y) ? 1 : 0;
        sinus_[at] = sides >= 3 ? 1 : 0;
      }
  }
  bool meets_kidney(int x, int y, int i, int j, int steps) const {
    for (int n = 1; n <= steps; ++n) {
      const int u = x + n * i, v = y + n * j;
      if (u < 0 || v < 0 || u >= nx_ || v >= ny_) return false;
      if (here_[static_cast<std::size_t>(u) + static_cast<std::size_t>(nx_) * static_cast<std::size_t>(v)] ==
          TissueClass::kidney)
        return true;
    }
    return false;
  }

  Organ organ_at(std::size_t i) const {
    const TissueClass tissue = here_[i];
    const float wall_mm = wall_[i];
    if (tissue == TissueClass::spleen) return Organ::spleen;
    if (tissue == TissueClass::kidney)
      return in_kidney_[i] > static_cast<float>(kCortexMm) ? Organ::kidney_pyramid : Organ::kidney_cortex;
    if (sinus_[i] && tissue == TissueClass::fat) return Organ::kidney_sinus;
    if (tissue == TissueClass::skin) return Organ::skin;
    if (depth_[i] <= static_cast<float>(kSkinMm) && (is_fatty(tissue) || tissue == TissueClass::soft_tissue))
      return Organ::skin;
    if (is_fatty(tissue)) return wall_mm > 0.0F ? Organ::fat_inside : Organ::fat_under_skin;
    if (!may_be_muscle(tissue)) return Organ::none;
    if (wall_mm > 0.0F && from_lung_[i] <= static_cast<float>(kDiaphragmMm)) return Organ::diaphragm;
    if (wall_mm > 0.0F && wall_mm <= static_cast<float>(kFasciaMm)) return Organ::fascia;
    if (tissue == TissueClass::muscle)
      return from_inner_fat_[i] <= static_cast<float>(kFasciaMm) ? Organ::fascia : Organ::muscle;
    if (wall_mm > 0.0F && wall_mm <= static_cast<float>(kWallMuscleMm)) return Organ::muscle;
    return from_gas_[i] <= static_cast<float>(kBowelWallMm) ? Organ::bowel_wall : Organ::none;
  }

  int nx_, ny_;
  float dx_, dy_;
  glm::dmat4 lps_from_voxel_;
  std::span<const TissueClass> classes_, here_;
  std::vector<float> depth_, reach_, wall_, in_kidney_, from_lung_, from_gas_, from_inner_fat_;
  std::vector<std::uint8_t> sinus_;
};

}  // namespace

std::span<const OrganRow, kOrgans> organ_rows() noexcept {
  return kOrganRows;
}
const OrganRow& organ_row(Organ organ) noexcept {
  return kOrganRows[static_cast<std::size_t>(organ)];
}

std::vector<Organ> organs_of(const volume::Volume& volume, std::span<const TissueClass> classes, int threads) {
  CHECK(classes.size() == volume.hu.size());
  std::vector<Organ> organs(classes.size());
  base::over_rows(
      volume.size_voxels.z, threads, [&] { return SliceOfOrgans(volume, classes); },
      [&](int k, SliceOfOrgans& slice) {
        slice.tell(k, std::span(organs).subspan(static_cast<std::size_t>(k) * slice.size(), slice.size()));
      });
  return organs;
}

void show_organs(const volume::Volume& volume, std::span<const TissueClass> classes, std::span<std::uint8_t> levels,
                 int threads) {
  CHECK(classes.size() == volume.hu.size() && levels.size() == classes.size());
  base::over_rows(
      volume.size_voxels.z, threads, [&] { return SliceOfOrgans(volume, classes); },
      [&](int k, SliceOfOrgans& slice) {
        std::vector<Organ> organs(slice.size());
        slice.tell(k, organs);
        const std::size_t first = static_cast<std::size_t>(k) * slice.size();
        for (std::size_t i = 0; i < organs.size(); ++i)
          if (organs[i] != Organ::none)
            levels[first + i] = echo_level(slice.level_db(i, k, organs[i]), classes[first + i]);
      });
}

}  // namespace seldinger::imaging
