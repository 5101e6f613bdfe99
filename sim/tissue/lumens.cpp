#include "sim/tissue/lumens.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <initializer_list>
#include <iterator>
#include <limits>
#include <queue>
#include <utility>

#include "sim/base/ascii.h"
#include "sim/case/paint.h"
#include "sim/tissue/veins.h"

namespace seldinger::tissue {
namespace {

using cases::LumenContent;

constexpr double kMm3PerMl = 1000.0;

// Pressures: a renal pelvis that drains stays below 15 cm of water (Whitaker, Br. J. Urol. 45 (1973) 15), so 10
// here and, for want of better, in bile ducts and cysts; the mean of a systemic artery is 93 mmHg, that of a vein
// at the heart's height some 5 (Guyton and Hall, Textbook of Medical Physiology). Viscosities: of water at 37 °C,
// and of blood, 3 to 4 times that of water (ibid.).
constexpr double kCmWaterPa = 98.0665, kMmHgPa = 133.322;
constexpr double kWaterPaS = 0.69e-3, kBloodPaS = 3.0e-3;
constexpr ContentLaw kLaws[] = {
    {0.0, kWaterPaS},           {10.0 * kCmWaterPa, kWaterPaS}, {10.0 * kCmWaterPa, kWaterPaS},
    {5.0 * kMmHgPa, kBloodPaS}, {93.0 * kMmHgPa, kBloodPaS},    {10.0 * kCmWaterPa, kWaterPaS}};

// Urine 1 ml/min from both kidneys, bile 600 to 1000 ml a day (Guyton and Hall).
constexpr double kUrineMlS = 0.5 / 60.0, kBileMlS = 800.0 / 86400.0;
// Of blood, mean over the vessel: 15.3 ± 4.0 cm/s in the portal vein (Moriyasu et al., AJR 146 (1986) 735); taken
// for every vessel (design).
constexpr double kBloodMmS = 150.0;

bool says_any(std::string_view name, std::initializer_list<std::string_view> words) {
  const std::string lower = base::lower(name);
  return std::any_of(words.begin(), words.end(),
                     [&](std::string_view word) { return lower.find(word) != std::string::npos; });
}

bool is_blood(LumenContent content) noexcept {
  return content == LumenContent::venous_blood || content == LumenContent::arterial_blood;
}

using Voxels = std::vector<std::uint32_t>;  // ascending

// Of one voxel among `voxels`, those that share a face, an edge or a corner with it: step(place in `voxels`).
template <typename Step>
void over_neighbours(std::uint32_t voxel, const Voxels& voxels, const glm::ivec3& size, const Step& step) {
  const std::int64_t row = size.x, slice = row * size.y;
  const glm::ivec3 at(voxel % row, voxel / row % size.y, voxel / slice);
  for (int dz = -1; dz <= 1; ++dz)
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const glm::ivec3 other = at + glm::ivec3(dx, dy, dz);
        if (glm::any(glm::lessThan(other, glm::ivec3(0))) || glm::any(glm::greaterThanEqual(other, size))) continue;
        const auto number = static_cast<std::uint32_t>(other.x + row * other.y + slice * other.z);
        const auto found = std::lower_bound(voxels.begin(), voxels.end(), number);
        if (number != voxel && found != voxels.end() && *found == number)
          step(static_cast<std::size_t>(found - voxels.begin()), glm::dvec3(dx, dy, dz));
      }
}

// The connected pieces of some voxels, by their first ones.
std::vector<Voxels> pieces_of(const Voxels& voxels, const glm::ivec3& size) {
  std::vector<Voxels> pieces;
  std::vector<bool> taken(voxels.size(), false);
  std::vector<std::size_t> open;
  for (std::size_t first = 0; first < voxels.size(); ++first) {
    if (taken[first]) continue;
    Voxels piece;
    taken[first] = true;
    open = {first};
    while (!open.empty()) {
      const std::size_t place = open.back();
      open.pop_back();
      piece.push_back(voxels[place]);
      over_neighbours(voxels[place], voxels, size, [&](std::size_t other, const glm::dvec3&) {
        if (!taken[other]) open.push_back(other);
        taken[other] = true;
      });
    }
    std::sort(piece.begin(), piece.end());
    pieces.push_back(std::move(piece));
  }
  return pieces;
}

Voxels voxels_in(const cases::Shape& shape, const volume::Volume& volume) {
  Voxels voxels;
  cases::over_voxels_in(shape, volume, 1e-3,
                        [&](std::size_t voxel, double) { voxels.push_back(static_cast<std::uint32_t>(voxel)); });
  std::sort(voxels.begin(), voxels.end());
  return voxels;
}

// The diagonal of the box around them.
double diagonal_mm(const Voxels& voxels, const volume::Volume& volume) {
  const auto row = static_cast<std::uint32_t>(volume.size_voxels.x);
  const std::uint32_t slice = row * static_cast<std::uint32_t>(volume.size_voxels.y);
  glm::ivec3 low(volume.size_voxels), high(0);
  for (const std::uint32_t voxel : voxels) {
    const glm::ivec3 at(voxel % row, voxel % slice / row, voxel / slice);
    low = glm::min(low, at);
    high = glm::max(high, at);
  }
  return glm::length(glm::dvec3(high - low + 1) * volume.spacing_mm);
}

double inflow_ml_s(LumenContent content, double volume_ml, double longest_mm) {
  if (content == LumenContent::urine) return kUrineMlS;
  if (content == LumenContent::bile) return kBileMlS;
  // Through the mean cross-section of what is as long as its box.
  return is_blood(content) ? volume_ml / longest_mm * kBloodMmS : 0.0;
}

}  // namespace

LumenContent content_of(volume::TissueClass tissue, std::string_view name) {
  if (tissue == volume::TissueClass::vessel)
    return says_vein(std::string(name)) ? LumenContent::venous_blood : LumenContent::arterial_blood;
  if (tissue != volume::TissueClass::fluid) return LumenContent::none;
  if (says_any(name, {"gall", "bile", "biliar", "chol", "hepatic_duct"})) return LumenContent::bile;
  if (says_any(name, {"calyx", "calyces", "pelvis", "collecting", "ureter", "bladder", "urin"}))
    return LumenContent::urine;
  return LumenContent::fluid;
}

const ContentLaw& law_of(LumenContent content) noexcept {
  return kLaws[static_cast<std::size_t>(content)];
}

Lumens::Lumens(const cases::Case& scene)
    : size_voxels_(scene.volume.size_voxels),
      spacing_mm_(scene.volume.spacing_mm),
      lps_from_voxel_(scene.volume.lps_from_voxel),
      voxel_from_lps_(volume::voxel_from_lps(scene.volume)),
      voxel_ml_(spacing_mm_.x * spacing_mm_.y * spacing_mm_.z / kMm3PerMl) {
  const auto add = [&](LumenContent content, const Voxels& voxels) {
    for (Voxels& piece : pieces_of(voxels, size_voxels_)) {
      const double volume_ml = voxel_ml_ * static_cast<double>(piece.size());
      const double inflow = inflow_ml_s(content, volume_ml, diagonal_mm(piece, scene.volume));
      lumens_.push_back({content, std::move(piece), volume_ml, inflow});
    }
  };
  std::array<Voxels, std::size(kLaws)> together;  // by content
  const auto take = [&](LumenContent content, const cases::Shape& shape) {
    if (content == LumenContent::none) return;
    const Voxels voxels = voxels_in(shape, scene.volume);
    if (is_blood(content)) return add(content, voxels);
    Voxels& of_content = together[static_cast<std::size_t>(content)];
    Voxels both;
    std::set_union(voxels.begin(), voxels.end(), of_content.begin(), of_content.end(), std::back_inserter(both));
    of_content = std::move(both);
  };
  for (const cases::Structure& one : scene.structures) take(content_of(one.tissue, one.name), one.shape);
  for (const cases::Lesion& one : scene.lesions)
    if (one.kind == cases::LesionKind::cyst || one.kind == cases::LesionKind::abscess)
      take(LumenContent::fluid, cases::shape_of(one));
  for (std::size_t content = 0; content < together.size(); ++content)
    add(static_cast<LumenContent>(content), together[content]);
}

std::vector<std::uint32_t> Lumens::filling_order(const Lumen& lumen, const glm::dvec3& rest_lps_mm) const {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  std::vector<double> way_mm(lumen.voxels.size(), kFar);
  using Entry = std::pair<double, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  // From the voxel that is next to the place: the tip may have moved on since.
  const std::int64_t row = size_voxels_.x, slice = row * size_voxels_.y;
  const auto center = [&](std::uint32_t voxel) {
    return glm::dvec3(lps_from_voxel_ * glm::dvec4(voxel % row, voxel / row % size_voxels_.y, voxel / slice, 1.0));
  };
  std::size_t first = 0;
  double nearest_mm = kFar;
  for (std::size_t i = 0; i < lumen.voxels.size(); ++i) {
    const double mm = glm::distance(center(lumen.voxels[i]), rest_lps_mm);
    if (mm < nearest_mm) first = i;
    nearest_mm = std::min(nearest_mm, mm);
  }
  way_mm[first] = 0.0;
  open.push({0.0, first});
  std::vector<std::uint32_t> order;
  while (!open.empty()) {
    const double mm = open.top().first;
    const auto place = open.top().second;
    open.pop();
    if (mm > way_mm[place]) continue;
    order.push_back(lumen.voxels[place]);
    over_neighbours(lumen.voxels[place], lumen.voxels, size_voxels_,
                    [&](std::size_t other, const glm::dvec3& step) {
                      const double there_mm = mm + glm::length(step * spacing_mm_);
                      if (there_mm >= way_mm[other]) return;
                      way_mm[other] = there_mm;
                      open.push({there_mm, other});
                    });
  }
  return order;
}

std::int32_t Lumens::at(const glm::dvec3& rest_lps_mm) const noexcept {
  if (lumens_.empty()) return -1;
  const glm::dvec4 index = voxel_from_lps_ * glm::dvec4(rest_lps_mm, 1.0);
  std::size_t voxel = 0, stride = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const double place = std::floor(index[axis] + 0.5);
    if (!(place >= 0.0 && place < size_voxels_[axis])) return -1;
    voxel += static_cast<std::size_t>(place) * stride;
    stride *= static_cast<std::size_t>(size_voxels_[axis]);
  }
  // What was drawn last lies over what was drawn before.
  for (std::size_t i = lumens_.size(); i-- > 0;)
    if (std::binary_search(lumens_[i].voxels.begin(), lumens_[i].voxels.end(), voxel))
      return static_cast<std::int32_t>(i);
  return -1;
}

}  // namespace seldinger::tissue
