#include "sim/tissue/blood_flow.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "sim/tissue/lumens.h"

namespace seldinger::tissue {
namespace {

using cases::LumenContent;

const glm::dvec3 kHead(0.0, 0.0, 1.0), kFeet(0.0, 0.0, -1.0), kLiver(-0.8, 0.0, 0.6);

// Arteries, peak in systole: aorta 100 ± 20, iliac 119 ± 22, common femoral 114 ± 25 cm/s in 55 healthy people,
// with a phase that runs back (Jager, Ricketts and Strandness, in: Bernstein, Noninvasive Diagnostic Techniques in
// Vascular Disease, Mosby 1985); how much runs back is a judgement. Common carotid 62 to 64 cm/s and an index of
// resistance of 0.78, which leaves 14 at the end of diastole (199 people; Charles University, publication 444026).
// Veins, mean over the lumen, of which the middle has twice as much: internal jugular 12.6 cm/s (Ciuti et al., AJNR
// 34 (2013) 2000), portal 15.3 (Moriyasu et al., AJR 146 (1986) 735), which is taken for all others (design).
constexpr double kPortalMiddle = 306.0, kJugularMiddle = 252.0;
const FlowLaw kFlowLaws[] = {
    {"carotid", LumenContent::arterial_blood, kHead, 630.0, 140.0},
    {"aorta", LumenContent::arterial_blood, kFeet, 1000.0, 60.0, 0.1},
    {"iliac", LumenContent::arterial_blood, kFeet, 1190.0, 0.0, 0.2},
    {"femoral", LumenContent::arterial_blood, kFeet, 1140.0, 0.0, 0.25},
    {"jugular", LumenContent::venous_blood, kFeet, kJugularMiddle, kJugularMiddle},
    {"superior", LumenContent::venous_blood, kFeet, kPortalMiddle, kPortalMiddle},
    {"cava", LumenContent::venous_blood, kHead, kPortalMiddle, kPortalMiddle},
    {"iliac", LumenContent::venous_blood, kHead, kPortalMiddle, kPortalMiddle},
    {"femoral", LumenContent::venous_blood, kHead, kPortalMiddle, kPortalMiddle},
    {"hepatic", LumenContent::venous_blood, kHead, kPortalMiddle, kPortalMiddle},
    {"portal", LumenContent::venous_blood, kLiver, kPortalMiddle, kPortalMiddle},
};

// Shares of a beat: blood is driven out, then runs back.
constexpr double kSystole = 0.35, kBack = 0.2;

// From 0 over 1 in the middle to 0; none outside of 0 to 1.
double hump(double at) noexcept {
  const double inside = std::clamp(at, 0.0, 1.0), half = inside * (1.0 - inside);
  return 16.0 * half * half;
}

}  // namespace

const FlowLaw* flow_law_of(volume::TissueClass tissue, std::string_view name) noexcept {
  const LumenContent content = content_of(tissue, name);
  std::string lower(name);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  for (const FlowLaw& law : kFlowLaws)
    if (law.content == content && lower.find(law.word) != std::string::npos) return &law;
  return nullptr;
}

double middle_speed_mm_s(const FlowLaw& law, double t_s) noexcept {
  const double beats = t_s / kBeatS, beat = beats - std::floor(beats);
  return law.diastole_mm_s + (law.systole_mm_s - law.diastole_mm_s) * hump(beat / kSystole) -
         law.back_share * law.systole_mm_s * hump((beat - kSystole) / kBack);
}

BloodFlow::BloodFlow(std::span<const cases::Structure> structures) {
  for (const cases::Structure& one : structures) {
    if (one.tissue != volume::TissueClass::vessel) continue;
    const FlowLaw* law = flow_law_of(one.tissue, one.name);
    const auto* tube = std::get_if<cases::Tube>(&one.shape);
    if (law == nullptr || tube == nullptr || tube->points_lps_mm.size() < 2 || !(tube->radius_mm > 0.0)) {
      unknown_.push_back(one.name);
      continue;
    }
    Vessel vessel{one.name, law, tube->points_lps_mm, tube->radius_mm, cases::bounds_of(one.shape)};
    if (glm::dot(vessel.points_lps_mm.back() - vessel.points_lps_mm.front(), law->towards_lps) < 0.0)
      std::reverse(vessel.points_lps_mm.begin(), vessel.points_lps_mm.end());
    vessels_.push_back(std::move(vessel));
  }
}

std::vector<std::string> BloodFlow::names() const {
  std::vector<std::string> names;
  for (const Vessel& one : vessels_) names.push_back(one.name);
  return names;
}

glm::dvec3 BloodFlow::velocity_mm_s(const glm::dvec3& rest_lps_mm, double t_s) const noexcept {
  for (auto vessel = vessels_.rbegin(); vessel != vessels_.rend(); ++vessel) {
    const glm::dvec3& p = rest_lps_mm;
    if (glm::clamp(p, vessel->box.low_lps_mm, vessel->box.high_lps_mm) != p) continue;
    double least_2 = vessel->radius_mm * vessel->radius_mm;
    glm::dvec3 along(0.0);
    for (std::size_t i = 0; i + 1 < vessel->points_lps_mm.size(); ++i) {
      const glm::dvec3& from = vessel->points_lps_mm[i];
      const glm::dvec3 way = vessel->points_lps_mm[i + 1] - from;
      const double length_2 = glm::dot(way, way);
      if (!(length_2 > 0.0)) continue;
      const glm::dvec3 off = p - from - std::clamp(glm::dot(p - from, way) / length_2, 0.0, 1.0) * way;
      const double off_2 = glm::dot(off, off);
      if (!(off_2 < least_2)) continue;
      least_2 = off_2;
      along = way / std::sqrt(length_2);
    }
    const double share = 1.0 - least_2 / (vessel->radius_mm * vessel->radius_mm);
    if (share > 0.0) return share * middle_speed_mm_s(*vessel->law, t_s) * along;
  }
  return glm::dvec3(0.0);
}

}  // namespace seldinger::tissue
