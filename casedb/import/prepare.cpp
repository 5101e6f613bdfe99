#include "casedb/import/prepare.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/common.hpp>
#include <glm/vec4.hpp>
#include <utility>

#include "casedb/import/ct_rules.h"
#include "casedb/import/diffusion.h"
#include "casedb/import/files/number_text.h"
#include "casedb/import/skin/surface.h"
#include "sim/base/check.h"

namespace seldinger::casedb {
namespace {

constexpr int kNoAirHu = -500;
constexpr std::size_t kMostAsked = 50'000;  // places of each surface, and of the volume, that are compared
constexpr double kFullGridMm = 0.1;         // finer than any CT: nothing is averaged

glm::ivec3 factors_of(const Preparation& preparation) {
  return {std::lround(preparation.shrink_i), std::lround(preparation.shrink_j), std::lround(preparation.shrink_k)};
}

SurfaceOptions surface_options(const Preparation& preparation) {
  return {static_cast<int>(std::lround(preparation.skin_hu)), preparation.skin_grid_mm, preparation.skin_decimate,
          static_cast<int>(std::lround(preparation.skin_smooth))};
}

// Where nothing was measured it says so still: the skin asks for that.
void clamp(const Preparation& preparation, volume::Volume& volume) {
  const auto low = static_cast<std::int16_t>(preparation.clamp_low_hu),
             high = static_cast<std::int16_t>(preparation.clamp_high_hu);
  for (std::int16_t& hu : volume.hu)
    if (hu != volume::kAirHu) hu = std::clamp(hu, low, high);
}

base::Result<void> fits(const volume::Volume& volume, const glm::ivec3& factors) {
  for (int axis = 0; axis < 3; ++axis) {
    if (factors[axis] == 1) continue;
    const double mm = volume.spacing_mm[axis] * factors[axis];
    if (mm > kThickMm)
      return base::Error{"bad_preparation", "shrunk so, a voxel measures " + number_text(mm) + " mm: more than " +
                                                number_text(kThickMm) + " mm do not tell targets"};
    if (volume.size_voxels[axis] / factors[axis] < 3)
      return base::Error{"bad_preparation", "shrunk so, fewer than three voxels are left along an axis"};
  }
  return {};
}

struct Spread {
  double mean = 0.0, most_95 = 0.0, most = 0.0;
};

Spread spread_of(std::vector<double> values) {
  Spread spread;
  if (values.empty()) return spread;
  for (const double value : values) spread.mean += value / static_cast<double>(values.size());
  std::sort(values.begin(), values.end());
  spread.most_95 = values[(values.size() - 1) * 95 / 100];
  spread.most = values.back();
  return spread;
}

// Of the corners of what is skin, evenly left out where there are many.
void add_distances(const cases::Mesh& from, const cases::MeshIndex& to, std::vector<double>& distances_mm) {
  std::vector<std::uint8_t> is_skin(from.vertices_lps_mm.size(), 0);
  for (std::size_t i = 0; i < from.triangles.size(); ++i)
    for (int corner = 0; corner < 3; ++corner)
      if (from.cut[i] == 0) is_skin[from.triangles[i][corner]] = 1;
  const std::size_t step = from.vertices_lps_mm.size() / kMostAsked + 1;
  std::uint32_t hint = 0;
  for (std::size_t i = 0; i < from.vertices_lps_mm.size(); i += step) {
    if (is_skin[i] == 0) continue;
    const cases::Closest near = to.closest(glm::dvec3(from.vertices_lps_mm[i]), hint);
    hint = near.triangle;
    distances_mm.push_back(std::abs(near.distance_mm));
  }
}

}  // namespace

volume::Volume shrunk(const volume::Volume& volume, const glm::ivec3& factors) {
  volume::Volume made;
  made.lps_from_voxel = volume.lps_from_voxel;
  made.lps_from_voxel[3] = volume.lps_from_voxel * glm::dvec4(0.5 * glm::dvec3(factors - 1), 1.0);
  for (int axis = 0; axis < 3; ++axis) {
    CHECK(factors[axis] >= 1 && factors[axis] <= volume.size_voxels[axis]);
    made.size_voxels[axis] = volume.size_voxels[axis] / factors[axis];
    made.spacing_mm[axis] = volume.spacing_mm[axis] * factors[axis];
    made.lps_from_voxel[axis] = volume.lps_from_voxel[axis] * static_cast<double>(factors[axis]);
  }
  const glm::ivec3 size = made.size_voxels;
  const double share = 1.0 / (static_cast<double>(factors.x) * factors.y * factors.z);
  made.hu.reserve(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) *
                  static_cast<std::size_t>(size.z));
  for (int k = 0; k < size.z; ++k)
    for (int j = 0; j < size.y; ++j)
      for (int i = 0; i < size.x; ++i) {
        int sum = 0;
        for (int c = 0; c < factors.z; ++c)
          for (int b = 0; b < factors.y; ++b)
            for (int a = 0; a < factors.x; ++a)
              sum += volume.at(i * factors.x + a, j * factors.y + b, k * factors.z + c);
        made.hu.push_back(static_cast<std::int16_t>(std::lround(sum * share)));
      }
  return made;
}

base::Result<Prepared> prepare(volume::Volume original, const Preparation& preparation) {
  if (const auto sound = check_preparation(preparation); !sound) return sound.error();
  if (const auto fit = fits(original, factors_of(preparation)); !fit) return fit.error();
  Prepared prepared;
  prepared.volume = std::move(original);
  clamp(preparation, prepared.volume);
  if (preparation.denoise > 0.0)
    prepared.warnings.push_back(denoise(prepared.volume, static_cast<int>(std::lround(preparation.denoise))));
  if (preparation.shrinks()) prepared.volume = shrunk(prepared.volume, factors_of(preparation));
  auto skin = skin_surface(prepared.volume, surface_options(preparation), &prepared.decimated);
  if (!skin) return skin.error();
  prepared.skin = std::move(*skin);
  if (auto cut = cut_body(prepared.skin, prepared.volume)) prepared.warnings.push_back(std::move(*cut));
  return prepared;
}

base::Result<FullSurface> full_surface(const volume::Volume& original, double skin_hu) {
  auto mesh = skin_surface(original, {static_cast<int>(std::lround(skin_hu)), kFullGridMm, 0.0, 0});
  if (!mesh) return mesh.error();
  FullSurface full;
  full.index = cases::MeshIndex(*mesh);
  full.mesh = std::move(*mesh);
  return full;
}

Fidelity fidelity_of(const volume::Volume& original, const FullSurface& full, const Prepared& prepared) {
  Fidelity found;
  found.triangles = prepared.skin.triangles.size();
  found.full_triangles = full.mesh.triangles.size();
  found.decimated = prepared.decimated;
  std::vector<double> distances_mm;
  add_distances(prepared.skin, full.index, distances_mm);
  add_distances(full.mesh, cases::MeshIndex(prepared.skin), distances_mm);
  found.compares_skin = !distances_mm.empty();
  const Spread away = spread_of(std::move(distances_mm));
  found.mean_mm = away.mean;
  found.most_95_mm = away.most_95;
  found.most_mm = away.most;

  std::vector<double> differences_hu;
  const glm::dmat4 prepared_from_original = volume::voxel_from_lps(prepared.volume) * original.lps_from_voxel;
  const std::size_t row = static_cast<std::size_t>(original.size_voxels.x),
                    slice = row * static_cast<std::size_t>(original.size_voxels.y);
  const std::size_t step = original.hu.size() / (4 * kMostAsked) + 1;  // of which air is a good part
  for (std::size_t at = 0; at < original.hu.size(); at += step) {
    if (original.hu[at] <= kNoAirHu) continue;
    const glm::dvec3 index(prepared_from_original * glm::dvec4(static_cast<double>(at % row),
                                                               static_cast<double>(at % slice / row),
                                                               static_cast<double>(at / slice), 1.0));
    if (const auto hu = volume::sample_trilinear(prepared.volume, index))
      differences_hu.push_back(std::abs(*hu - original.hu[at]));
  }
  const Spread differs = spread_of(std::move(differences_hu));
  found.mean_hu = differs.mean;
  found.most_95_hu = differs.most_95;
  return found;
}

std::string text_of(const Fidelity& fidelity) {
  char distances[128] = "there is no skin to compare with the full surface", text[320];
  if (fidelity.compares_skin)
    std::snprintf(distances, sizeof distances,
                  "the skin is %.2f mm from the full surface on average, 95 %% within %.2f mm, at most %.2f mm",
                  fidelity.mean_mm, fidelity.most_95_mm, fidelity.most_mm);
  std::snprintf(text, sizeof text, "%s; %zu triangles of %zu; HU differ by %.1f on average, 95 %% by at most %.0f",
                distances, fidelity.triangles, fidelity.full_triangles, fidelity.mean_hu, fidelity.most_95_hu);
  return text;
}

std::string less_decimated(const Preparation& preparation, const Fidelity& fidelity) {
  // Decimation itself stops within a hundredth or two of what it is asked for.
  constexpr double kToldFrom = 0.05;
  if (!(preparation.skin_decimate - fidelity.decimated > kToldFrom)) return {};
  char text[160];
  std::snprintf(text, sizeof text,
                "%.0f %% of the skin's triangles were taken away, not %.0f: more would have opened it",
                100.0 * fidelity.decimated, 100.0 * preparation.skin_decimate);
  return text;
}

base::Problem told_of(const Preparation& preparation, const Prepared& prepared, const Fidelity& fidelity) {
  std::string text = "asked for: " + text_of(preparation);
  if (preparation.shrinks()) {
    const glm::dvec3& mm = prepared.volume.spacing_mm;
    text += "; voxels now measure " + number_text(mm.x) + " x " + number_text(mm.y) + " x " + number_text(mm.z) +
            " mm: what is smaller is lost";
  }
  const std::string less = less_decimated(preparation, fidelity);
  return {"prepared", text + "; " + text_of(fidelity) + (less.empty() ? "" : "; " + less)};
}

}  // namespace seldinger::casedb
