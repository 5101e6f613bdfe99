#include "sim/tissue/blood_flow.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "sim/base/ascii.h"
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
    {"superior_vena", LumenContent::venous_blood, kFeet, kPortalMiddle, kPortalMiddle},
    {"cava", LumenContent::venous_blood, kHead, kPortalMiddle, kPortalMiddle},
    {"iliac", LumenContent::venous_blood, kHead, kPortalMiddle, kPortalMiddle},
    {"femoral", LumenContent::venous_blood, kHead, kPortalMiddle, kPortalMiddle},
    {"portal", LumenContent::venous_blood, kLiver, kPortalMiddle, kPortalMiddle},
    {"hepatic", LumenContent::venous_blood, kHead, kPortalMiddle, kPortalMiddle},
};

// Shares of a beat: blood is driven out, then runs back.
constexpr double kSystole = 0.35, kBack = 0.2;

// Walls of a common carotid: 8 to 13 % of its diameter in diastole (Olson and Cooke, Med. Instrum. 9 (1975) 99);
// taken for every artery (design). It is widest a quarter of a beat in.
constexpr double kPulseShare = 0.08, kWidest = 0.25;
// Of the piece that moves: half its length, of which its ends ease off, and how far away it may lie (design).
constexpr double kPulseHalfMm = 30.0, kPulseEndMm = 10.0, kPulseNearMm = 80.0;

double smooth(double at) noexcept {
  const double inside = std::clamp(at, 0.0, 1.0);
  return inside * inside * (3.0 - 2.0 * inside);
}

double beat_at(double t_s) noexcept {
  const double beats = t_s / kBeatS;
  return beats - std::floor(beats);
}

// From 0 over 1 in the middle to 0; none outside of 0 to 1.
double hump(double at) noexcept {
  const double inside = std::clamp(at, 0.0, 1.0), half = inside * (1.0 - inside);
  return 16.0 * half * half;
}

// Of a line through points, what is nearest to a place: where, which way the line goes there, how far off, squared.
struct Nearest {
  glm::dvec3 at_lps_mm{0.0}, along{0.0};
  double off_2 = std::numeric_limits<double>::infinity();
};
Nearest nearest_of(const std::vector<glm::dvec3>& points, const glm::dvec3& p) noexcept {
  Nearest nearest;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const glm::dvec3 way = points[i + 1] - points[i];
    const double length_2 = glm::dot(way, way);
    if (!(length_2 > 0.0)) continue;
    const glm::dvec3 at = points[i] + std::clamp(glm::dot(p - points[i], way) / length_2, 0.0, 1.0) * way;
    const double off_2 = glm::dot(p - at, p - at);
    if (off_2 < nearest.off_2) nearest = {at, way / std::sqrt(length_2), off_2};
  }
  return nearest;
}

glm::vec4 four(const glm::dvec3& of) noexcept {
  return glm::vec4(glm::vec3(of), 0.0F);
}

// As a vein's source, whose share of area that is gone is less than none here; where there is room for one.
void add_wider(const glm::dvec3& from_lps_mm, const glm::dvec3& along, double radius_mm, double wider,
               Displacement& made) noexcept {
  if (made.breath_end == shaders::kMostDisplacementSources) return;
  std::copy_backward(made.source + made.vein_end, made.source + made.breath_end, made.source + made.breath_end + 1);
  made.source[made.vein_end] = {four(from_lps_mm), four(along), four({radius_mm, 2.0 * kPulseHalfMm, kPulseEndMm}),
                                four({1.0 - (1.0 + wider) * (1.0 + wider), 0.0, 0.0})};
  ++made.vein_end;
  ++made.breath_end;
}

}  // namespace

const FlowLaw* flow_law_of(volume::TissueClass tissue, std::string_view name) noexcept {
  const LumenContent content = content_of(tissue, name);
  const std::string lower = base::lower(name);
  for (const FlowLaw& law : kFlowLaws)
    if (law.content == content && lower.find(law.word) != std::string::npos) return &law;
  return nullptr;
}

double middle_speed_mm_s(const FlowLaw& law, double t_s) noexcept {
  const double beat = beat_at(t_s);
  return law.diastole_mm_s + (law.systole_mm_s - law.diastole_mm_s) * hump(beat / kSystole) -
         law.back_share * law.systole_mm_s * hump((beat - kSystole) / kBack);
}

double pulse_share(const FlowLaw& law, double t_s) noexcept {
  if (law.content != LumenContent::arterial_blood) return 0.0;
  const double beat = beat_at(t_s);
  return kPulseShare * (beat < kWidest ? smooth(beat / kWidest) : 1.0 - smooth((beat - kWidest) / (1.0 - kWidest)));
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

bool BloodFlow::pulsates() const noexcept {
  return std::any_of(vessels_.begin(), vessels_.end(),
                     [](const Vessel& one) { return one.law->content == LumenContent::arterial_blood; });
}

Displacement BloodFlow::with_pulse(const Displacement& displacement, const glm::dvec3& about_lps_mm,
                                   double t_s) const noexcept {
  Displacement made = displacement;
  for (const Vessel& one : vessels_) {
    const double wider = pulse_share(*one.law, t_s);
    if (!(wider > 0.0)) continue;
    const Nearest near = nearest_of(one.points_lps_mm, about_lps_mm);
    if (!(near.off_2 < kPulseNearMm * kPulseNearMm)) continue;
    add_wider(near.at_lps_mm - kPulseHalfMm * near.along, near.along, one.radius_mm, wider, made);
  }
  return made;
}

glm::dvec3 BloodFlow::velocity_mm_s(const glm::dvec3& rest_lps_mm, double t_s) const noexcept {
  for (auto vessel = vessels_.rbegin(); vessel != vessels_.rend(); ++vessel) {
    const glm::dvec3& p = rest_lps_mm;
    if (glm::clamp(p, vessel->box.low_lps_mm, vessel->box.high_lps_mm) != p) continue;
    const Nearest near = nearest_of(vessel->points_lps_mm, p);
    const double share = 1.0 - near.off_2 / (vessel->radius_mm * vessel->radius_mm);
    if (share > 0.0) return share * middle_speed_mm_s(*vessel->law, t_s) * near.along;
  }
  return glm::dvec3(0.0);
}

}  // namespace seldinger::tissue
