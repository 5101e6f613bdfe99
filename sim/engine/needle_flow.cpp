#include "sim/engine/needle_flow.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "sim/case/gauge.h"

namespace seldinger::engine {
namespace {

using cases::EventKind;
using cases::LumenContent;

constexpr double kDepotMm = 5.0;   // contrast that comes out nearer than this to a depot joins it (design)
constexpr double kTraceMl = 1e-3;  // less contrast than this is none
constexpr double kMlPerM3 = 1e6, kMPerMm = 1e-3;

// Of a needle that pictures show solid, its stylet being in, the bore of the gauge next to it.
double bore_radius_mm(const cases::Instrument& needle) noexcept {
  if (needle.inner_radius_mm > 0.0) return needle.inner_radius_mm;
  const auto off_mm = [&](const cases::Gauge& gauge) { return std::abs(gauge.outer_mm - 2.0 * needle.radius_mm); };
  const cases::Gauge& next =
      *std::min_element(cases::kGauges.begin(), cases::kGauges.end(),
                        [&](const cases::Gauge& a, const cases::Gauge& b) { return off_mm(a) < off_mm(b); });
  return 0.5 * next.inner_mm;
}

bool is_empty(const cases::ContrastPool& pool) noexcept {
  return !(pool.contrast_ml > 0.0);
}

// The pool that contrast joins; else an empty one, or in place of the weakest, whose contrast is lost to view.
cases::ContrastPool& pool_for(std::int32_t lumen, const glm::dvec3& tip_lps_mm, cases::NeedleFlow& flow) noexcept {
  for (cases::ContrastPool& pool : flow.pools)
    if (!is_empty(pool) && pool.lumen == lumen &&
        (lumen >= 0 || glm::distance(pool.at_rest_lps_mm, tip_lps_mm) <= kDepotMm))
      return pool;
  cases::ContrastPool& pool = *std::min_element(
      flow.pools.begin(), flow.pools.end(),
      [](const cases::ContrastPool& a, const cases::ContrastPool& b) { return a.contrast_ml < b.contrast_ml; });
  flow.carried_away_ml += pool.contrast_ml;
  pool = {lumen, tip_lps_mm, 0.0, 0.0};
  return pool;
}

}  // namespace

NeedleFlows::NeedleFlows(const cases::Case& scene) : lumens_(scene) {
  const cases::Instrument& needle = scene.instrument;
  if (needle.kind != cases::InstrumentKind::access) return;
  const double radius_m = bore_radius_mm(needle) * kMPerMm, length_m = needle.length_mm * kMPerMm;
  const double area_m2 = std::numbers::pi * radius_m * radius_m;
  bore_ml_ = area_m2 * length_m * kMlPerM3;
  conductance_m3_ = area_m2 * radius_m * radius_m / (8.0 * length_m);
}

void NeedleFlows::hear(const cases::Inputs& inputs, const cases::NeedleState& needle, std::int32_t lumen,
                       cases::NeedleFlow& flow) const noexcept {
  // Told with a length since it is drawn through the needle; before, it was the anaesthetic's own at the skin.
  if (inputs.event == EventKind::aspirate && inputs.event_tenths_mm > 0 && needle.skin.in_body) {
    flow.in_use = true;
    const tissue::Lumen* from = lumens_.find(lumen);
    flow.aspirated = from != nullptr ? from->content : LumenContent::none;
  }
  if (!(bore_ml_ > 0.0)) return;
  if (inputs.event == EventKind::stylet_out || inputs.event == EventKind::inject) {
    flow.in_use = flow.stylet_out = true;
    if (inputs.event == EventKind::inject) flow.syringe_ml += kPushMl;
  }
  if (inputs.event == EventKind::stylet_in && flow.stylet_out) {
    flow.stylet_out = false;
    flow.column = flow.at_hub = LumenContent::none;
    flow.column_ml = flow.syringe_ml = 0.0;
  }
}

void NeedleFlows::run_back(std::int32_t lumen, double dt_s, cases::NeedleFlow& flow) const noexcept {
  const tissue::Lumen* from = lumens_.find(lumen);
  if (from == nullptr) return;
  const LumenContent content = from->content;
  if (flow.column != content) {
    flow.column = content;
    flow.column_ml = 0.0;
  }
  const tissue::ContentLaw& law = tissue::law_of(content);
  flow.column_ml += conductance_m3_ * law.pressure_pa / law.viscosity_pa_s * kMlPerM3 * dt_s;
  if (flow.column_ml >= bore_ml_) flow.at_hub = content;
}

void NeedleFlows::spread(std::int32_t lumen, const glm::dvec3& tip_lps_mm, double pushed_ml, double dt_s,
                         cases::NeedleFlow& flow) const noexcept {
  const cases::ContrastPool* into = nullptr;
  if (pushed_ml > 0.0) {
    cases::ContrastPool& pool = pool_for(lumen, tip_lps_mm, flow);
    pool.contrast_ml += pushed_ml;
    flow.injected_ml += pushed_ml;
    into = &pool;
  }
  for (cases::ContrastPool& pool : flow.pools) {
    if (is_empty(pool)) continue;
    const tissue::Lumen* of = lumens_.find(pool.lumen);
    const double room_ml = of != nullptr ? of->volume_ml : std::numeric_limits<double>::infinity();
    const double in_ml = (&pool == into ? pushed_ml : 0.0) + (of != nullptr ? of->inflow_ml_s * dt_s : 0.0);
    const double leaves_ml = std::max(0.0, pool.spread_ml + in_ml - room_ml);
    pool.spread_ml = std::min(room_ml, pool.spread_ml + in_ml);
    double away_ml = pool.contrast_ml * std::min(1.0, leaves_ml / pool.spread_ml);
    if (&pool != into && pool.contrast_ml - away_ml < kTraceMl) away_ml = pool.contrast_ml;
    pool.contrast_ml -= away_ml;
    flow.carried_away_ml += away_ml;
    if (is_empty(pool)) pool = {};
  }
}

void NeedleFlows::advance(const cases::Inputs& inputs, const cases::NeedleState& needle, double dt_s,
                          cases::NeedleFlow& flow) const noexcept {
  if (!flow.in_use && inputs.event == EventKind::none) return;
  const glm::dvec3& tip_lps_mm = needle.skin.tip_lps_mm;
  const std::int32_t lumen = needle.skin.in_body ? lumens_.at(tip_lps_mm) : -1;
  hear(inputs, needle, lumen, flow);
  if (!flow.in_use) return;
  const double pushed_ml = std::min(flow.syringe_ml, kPushMlS * dt_s);
  flow.syringe_ml -= pushed_ml;
  if (pushed_ml > 0.0) {  // contrast fills the bore
    flow.column = LumenContent::none;
    flow.column_ml = 0.0;
  } else if (flow.stylet_out) {
    run_back(lumen, dt_s, flow);
  }
  // Outside the body it drips away.
  spread(lumen, tip_lps_mm, needle.skin.in_body ? pushed_ml : 0.0, dt_s, flow);
}

}  // namespace seldinger::engine
