#include "assessment/operators/lesion_site.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <sstream>
#include <tuple>

#include "assessment/operators/organ_places.h"

namespace seldinger::assessment {
namespace {

struct Candidate {
  glm::dvec3 center_lps_mm;
  int rank;  // as OrganPlaces
  double mean_hu, sd_hu;
};

// Offsets of a cubic lattice within a ball.
std::vector<glm::dvec3> ball(double radius_mm, double step_mm) {
  std::vector<glm::dvec3> offsets;
  const int n = static_cast<int>(radius_mm / step_mm);
  for (int k = -n; k <= n; ++k)
    for (int j = -n; j <= n; ++j)
      for (int i = -n; i <= n; ++i) {
        const glm::dvec3 d = glm::dvec3(i, j, k) * step_mm;
        if (glm::dot(d, d) <= radius_mm * radius_mm) offsets.push_back(d);
      }
  return offsets;
}

constexpr const char* kNone = "no place in this volume fits the rule for a lesion: ";

std::string rounded(double value) {
  return std::to_string(std::lround(value));
}

// How many places of homogeneous tissue there are, and how many of them so deep as the rule wants.
base::Error none_of(std::size_t homogeneous, std::size_t deep, const LesionRule& rule) {
  const std::string depths = rounded(rule.min_depth_mm) + "–" + rounded(rule.max_depth_mm) + " mm below the skin";
  if (homogeneous == 0)
    return {"no_lesion_site", kNone + std::string("nowhere is soft tissue (mean ") + rounded(rule.min_mean_hu) +
                                  "–" + rounded(rule.max_mean_hu) + " HU) homogeneous within " +
                                  rounded(rule.homogeneous_radius_mm) + " mm"};
  if (deep == 0)
    return {"no_lesion_site", kNone + std::string("none of ") + std::to_string(homogeneous) +
                                  " places of homogeneous soft tissue lies " + depths};
  return {"no_lesion_site", kNone + std::string("none of ") + std::to_string(deep) +
                                " places of homogeneous soft tissue " + depths +
                                " is reached by a straight path as the rule wants it"};
}

// Where the volume is thinner than what must be homogeneous.
std::optional<base::Error> too_thin(const volume::Volume& volume, const LesionRule& rule) {
  const double need_mm = 2.0 * rule.homogeneous_radius_mm;
  double thinnest_mm = volume.spacing_mm.x * volume.size_voxels.x;
  for (int axis = 1; axis < 3; ++axis)
    thinnest_mm = std::min(thinnest_mm, volume.spacing_mm[axis] * volume.size_voxels[axis]);
  if (thinnest_mm >= need_mm) return std::nullopt;
  return base::Error{"no_lesion_site", kNone + std::string("the CT is a slab of ") + rounded(thinnest_mm) +
                                           " mm, and the rule asks for " + rounded(need_mm) +
                                           " mm of soft tissue around the lesion's centre"};
}

}  // namespace

LesionRule lesion_rule(cases::Modality modality, cases::PatientPosition position) {
  constexpr double kContrastAgentHu =
      500.0;                        // iodine in a calyx or a cavity; far above what a CT calls soft tissue
  constexpr double kFluidHu = 5.0;  // water, and what CT's noise makes of it
  LesionRule rule;
  rule.modality = modality;
  rule.position = position;
  if (modality == cases::Modality::xray) rule.contrast_hu = kContrastAgentHu;
  if (modality == cases::Modality::ultrasound) rule.lesion_hu = kFluidHu;
  return rule;
}

std::string describe(const LesionRule& rule) {
  std::ostringstream text;
  text << "a sphere of " << 2 * rule.radius_mm << " mm diameter, " << rule.min_depth_mm << "–" << rule.max_depth_mm
       << " mm below the skin, where soft tissue (mean " << rule.min_mean_hu << "–" << rule.max_mean_hu
       << " HU) is most homogeneous within " << rule.homogeneous_radius_mm
       << " mm (in a CT without labels within a solid organ that was recognised, where there is one, and never "
          "lateral "
          "to the lungs), on a straight path free of bone and gas"
       << (rule.modality == cases::Modality::xray         ? ", filled with contrast agent"
           : rule.modality == cases::Modality::ultrasound ? ", filled with fluid, seen by a probe beside the path"
                                                          : "");
  return text.str();
}

base::Result<LesionSite> find_lesion_site(const volume::Volume& volume, const cases::MeshIndex& skin,
                                          const LesionRule& rule) {
  if (skin.empty()) return base::Error{"no_lesion_site", kNone + std::string("it has no skin")};
  if (const auto thin = too_thin(volume, rule)) return *thin;
  // The lattice lies along the volume's axes; all samples below are nearest voxels, by integer offsets.
  const glm::ivec3 size = volume.size_voxels;
  glm::ivec3 stride;
  for (int axis = 0; axis < 3; ++axis)
    stride[axis] = std::max(1, static_cast<int>(std::lround(rule.grid_mm / volume.spacing_mm[axis])));
  std::vector<glm::ivec3> around;
  for (const glm::dvec3& d : ball(rule.homogeneous_radius_mm, 4.0))
    around.push_back(glm::ivec3(std::lround(d.x / volume.spacing_mm.x), std::lround(d.y / volume.spacing_mm.y),
                                std::lround(d.z / volume.spacing_mm.z)));
  std::optional<OrganPlaces> places;
  if (rule.organs != nullptr) places.emplace(*rule.organs);
  std::vector<Candidate> candidates;
  for (int k = 0; k < size.z; k += stride.z)
    for (int j = 0; j < size.y; j += stride.y)
      for (int i = 0; i < size.x; i += stride.x) {
        const int here = volume.at(i, j, k);
        if (here < -50 || here > 300) continue;
        double sum = 0.0, sum2 = 0.0;
        bool fits = true;
        for (const glm::ivec3& d : around) {
          const glm::ivec3 p = glm::ivec3(i, j, k) + d;
          if (p.x < 0 || p.y < 0 || p.z < 0 || p.x >= size.x || p.y >= size.y || p.z >= size.z) {
            fits = false;
            break;
          }
          const double hu = volume.at(p.x, p.y, p.z);
          if (hu < -150.0 || hu > 400.0) {  // gas, bone or metal, beyond any noise of soft tissue
            fits = false;
            break;
          }
          sum += hu;
          sum2 += hu * hu;
        }
        if (!fits) continue;
        const double n = static_cast<double>(around.size()), mean = sum / n;
        if (mean < rule.min_mean_hu || mean > rule.max_mean_hu) continue;
        const glm::dvec3 center_lps_mm(volume.lps_from_voxel * glm::dvec4(i, j, k, 1.0));
        const std::optional<int> rank = places ? places->rank(center_lps_mm, rule.radius_mm) : 1;
        if (!rank) continue;
        candidates.push_back({center_lps_mm, *rank, mean, std::sqrt(std::max(0.0, sum2 / n - mean * mean))});
      }
  std::stable_sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return std::tie(a.rank, a.sd_hu) < std::tie(b.rank, b.sd_hu);
  });
  PathLimits limits = path_limits(rule.modality, rule.position);
  limits.classes = rule.classes;
  limits.min_depth_mm = rule.min_depth_mm;
  limits.max_depth_mm = rule.max_depth_mm;
  std::size_t deep = 0;
  for (const Candidate& candidate : candidates) {
    const double below_mm = -skin.closest_skin(candidate.center_lps_mm).distance_mm;
    if (below_mm < rule.min_depth_mm || below_mm > rule.max_depth_mm) continue;
    ++deep;
    LesionSite site;
    site.lesion = {candidate.center_lps_mm, rule.radius_mm,
                   rule.lesion_hu.value_or(std::round(candidate.mean_hu + rule.contrast_hu))};
    if (rule.looks_from)
      limits.looks_from = [&](const PuncturePlan& plan, const WorthTaking& worth) {
        return rule.looks_from(plan, worth, site.lesion);
      };
    const auto plan = plan_puncture(volume, skin, candidate.center_lps_mm, limits);
    if (!plan) continue;
    site.plan = *plan;
    site.skin_distance_mm = below_mm;
    site.mean_hu = candidate.mean_hu;
    site.sd_hu = candidate.sd_hu;
    return site;
  }
  return none_of(candidates.size(), deep, rule);
}

}  // namespace seldinger::assessment
