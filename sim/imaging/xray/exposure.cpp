#include "sim/imaging/xray/exposure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "sim/base/check.h"
#include "sim/base/exact_math.h"

namespace seldinger::imaging {
namespace {

using base::exact_exp, base::exact_log;

constexpr double kNgyPerMgy = 1e6;

double square(double x) noexcept {
  return x * x;
}
double at_distance(double mm) noexcept {
  return square(1000.0 / mm);
}  // what is given at 1 m

// The line that automatic exposure follows, 0 ≤ s ≤ 1.
constexpr double kCurrentEnds = 0.6;
double kv_on_line(const cases::Fluoroscope& f, double s) noexcept {
  return f.kv_min + s * (f.kv_max - f.kv_min);
}
double ma_on_line(const cases::Fluoroscope& f, double s) noexcept {
  return f.ma_min * exact_exp(std::min(1.0, s / kCurrentEnds) * exact_log(f.ma_max / f.ma_min));
}

// AutomaticExposure's table.
constexpr double kKvStep = 10.0, kWaterStepMm = 25.0;
constexpr int kKvPoints = 12, kWaterPoints = 25;  // 40 … 150 kV, 0 … 600 mm
constexpr double kThickestMm = kWaterStepMm * (kWaterPoints - 1);

// The zero of a function that falls from `low` to `high`, or the end it never leaves.
template <class F>
double falling_zero(double low, double high, F f) {
  if (f(low) <= 0.0) return low;
  if (f(high) >= 0.0) return high;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (low + high);
    (f(middle) > 0.0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

int whole_kv(double kv) noexcept {
  return static_cast<int>(std::lround(std::clamp(kv, kMinTubeKv, kMaxTubeKv)));
}

}  // namespace

Beams::Beams(const cases::Fluoroscope& fluoroscope, const Detector& detector, const BehindCt& ct)
    : fluoroscope_(fluoroscope), detector_(detector), ct_(ct) {}

const BeamSignal& Beams::at(double kv) {
  CHECK(std::isfinite(kv));
  auto& beam = by_kv_[whole_kv(kv)];
  if (!beam) beam = std::make_unique<BeamSignal>(fluoroscope_spectrum(fluoroscope_, whole_kv(kv)), detector_, ct_);
  return *beam;
}

AutomaticExposure::AutomaticExposure(const cases::Fluoroscope& fluoroscope, const Detector& detector)
    : fluoroscope_(fluoroscope) {
  for (int i = 0; i < kKvPoints; ++i) {
    const BeamSignal beam(fluoroscope_spectrum(fluoroscope, kMinTubeKv + kKvStep * i), detector);
    for (int j = 0; j < kWaterPoints; ++j)
      table_.push_back(beam.log_share(kWaterStepMm * j, 0.0) +
                       exact_log(kNgyPerMgy * beam.kerma_mgy_per_mas_share()));
  }
}

double AutomaticExposure::log_kerma(double kv, double water_mm) const {
  const double x = std::clamp((kv - kMinTubeKv) / kKvStep, 0.0, kKvPoints - 1.0);
  const double y = std::clamp(water_mm / kWaterStepMm, 0.0, kWaterPoints - 1.0);
  const auto i = static_cast<std::size_t>(std::min(x, kKvPoints - 2.0));
  const auto j = static_cast<std::size_t>(std::min(y, kWaterPoints - 2.0));
  const double u = x - static_cast<double>(i), v = y - static_cast<double>(j);
  const double* cell = &table_[i * kWaterPoints + j];
  return (1.0 - u) * ((1.0 - v) * cell[0] + v * cell[1]) +
         u * ((1.0 - v) * cell[kWaterPoints] + v * cell[kWaterPoints + 1]);
}

cases::Technique AutomaticExposure::next(const cases::Technique& used, double panel_kerma_ngy,
                                         double sid_mm) const {
  CHECK(sid_mm > 0.0);
  const double pulse_s = fluoroscope_.pulse_ms / 1000.0, distance = at_distance(sid_mm);
  const double used_mas = used.ma * used.pulse_ms / 1000.0 * distance;
  // NaN or nothing at the panel: as behind the thickest patient.
  double water_mm = kThickestMm;
  if (panel_kerma_ngy > 0.0 && used_mas > 0.0) {
    const double seen = exact_log(panel_kerma_ngy / used_mas);
    water_mm = falling_zero(0.0, kThickestMm, [&](double mm) { return log_kerma(used.kv, mm) - seen; });
  }
  const auto ma_for = [&](double kv) {
    return kPanelKermaNgy / (exact_exp(log_kerma(kv, water_mm)) * pulse_s * distance);
  };
  const double s = falling_zero(
      0.0, 1.0, [&](double at) { return ma_for(kv_on_line(fluoroscope_, at)) - ma_on_line(fluoroscope_, at); });
  const double kv = std::clamp(std::round(kv_on_line(fluoroscope_, s)), fluoroscope_.kv_min, fluoroscope_.kv_max);
  return {kv, std::clamp(ma_for(kv), fluoroscope_.ma_min, fluoroscope_.ma_max), fluoroscope_.pulse_ms};
}

OpenField open_field(int width_px, int height_px, const cases::Collimator& collimator) noexcept {
  const auto cut = [](int pixels, double open) {
    const double closed = 0.5 * pixels * (1.0 - std::clamp(open, 0.0, 1.0));
    return std::clamp(static_cast<int>(std::ceil(closed - 0.5)), 0, (pixels - 1) / 2);  // never nothing
  };
  const int columns = cut(width_px, collimator.open_u), rows = cut(height_px, collimator.open_v);
  return {columns, width_px - columns, rows, height_px - rows};
}

double reference_air_kerma_mgy(Beams& beams, const Pulse& pulse) {
  return beams.at(pulse.technique.kv).open_kerma_mgy_per_mas() * pulse.mas() *
         at_distance(beams.fluoroscope().source_isocentre_mm - cases::kReferenceBeforeIsocentreMm);
}

double dose_area_mgy_cm2(Beams& beams, const Pulse& pulse, double plane_mm) {
  CHECK(plane_mm > 0.0 && pulse.sid_mm > 0.0);
  const double side_cm = 0.1 * beams.fluoroscope().field_side_mm.at(static_cast<std::size_t>(pulse.magnification));
  const double area_cm2 = side_cm * pulse.collimator.open_u * side_cm * pulse.collimator.open_v;  // at the panel
  return beams.at(pulse.technique.kv).open_kerma_mgy_per_mas() * pulse.mas() * at_distance(plane_mm) * area_cm2 *
         square(plane_mm / pulse.sid_mm);
}

double scatter_share(Beams& beams, const Pulse& pulse, const PathLengths& field) {
  CHECK(field.width_px > 0 && field.height_px > 0);
  const cases::Fluoroscope& f = beams.fluoroscope();
  const BeamSignal& beam = beams.at(pulse.technique.kv);
  // How thick the patient is, by steps of water; mineral and iodine count as what they take off behind an
  // abdomen.
  constexpr double kStepMm = 5.0, kBehindMm = 200.0;
  constexpr std::size_t kSteps = 121;
  const auto weight = [&](double water_mm, double mineral_mm, double contrast_mm = 0.0) {
    return beam.log_share(kBehindMm, 0.0) - beam.log_share(kBehindMm + water_mm, mineral_mm, 0.0, contrast_mm);
  };
  const double water_per_mineral = weight(0.0, 1.0) / weight(1.0, 0.0);
  const double water_per_contrast = field.contrast_mm.empty() ? 0.0 : weight(0.0, 0.0, 1.0) / weight(1.0, 0.0);
  std::array<double, kSteps> pixels{};
  const OpenField open = open_field(field.width_px, field.height_px, pulse.collimator);
  for (int row = open.first_row; row < open.end_row; ++row)
    for (int column = open.first_column; column < open.end_column; ++column) {
      const std::size_t i = static_cast<std::size_t>(row) * static_cast<std::size_t>(field.width_px) +
                            static_cast<std::size_t>(column);
      double water_mm =
          static_cast<double>(field.water_mm[i]) + water_per_mineral * static_cast<double>(field.mineral_mm[i]);
      if (!field.contrast_mm.empty()) water_mm += water_per_contrast * static_cast<double>(field.contrast_mm[i]);
      const double steps = std::clamp(water_mm / kStepMm, 0.0, kSteps - 1.0);
      const auto at = static_cast<std::size_t>(std::min(steps, kSteps - 2.0));
      const double above = steps - static_cast<double>(at);
      pixels[at] += 1.0 - above;
      pixels[at + 1] += above;
    }
  std::array<float, kSteps> water_mm, log_shares;
  for (std::size_t i = 0; i < kSteps; ++i) water_mm[i] = static_cast<float>(kStepMm * static_cast<double>(i));
  beam.log_shares(water_mm.data(), nullptr, nullptr, nullptr, kSteps, log_shares.data());
  const double side_mm = f.field_side_mm.at(static_cast<std::size_t>(pulse.magnification));
  const double field_mm = side_mm * std::sqrt(pulse.collimator.open_u * pulse.collimator.open_v);
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < kSteps; ++i) {
    count += pixels[i];
    // The patient's middle lies at the isocentre: the panel is never within the patient.
    const double water = kStepMm * static_cast<double>(i);
    const double gap_mm = std::max(pulse.sid_mm - f.source_isocentre_mm, 0.5 * water);
    sum += pixels[i] * exact_exp(static_cast<double>(log_shares[i])) *
           scatter_to_primary({water, field_mm, gap_mm, true});
  }
  return sum / count;
}

double panel_kerma_ngy(Beams& beams, const Pulse& pulse, const PathLengths& field) {
  CHECK(field.width_px > 0 && field.height_px > 0);
  const BeamSignal& beam = beams.at(pulse.technique.kv);
  // The measuring field does not reach beyond the collimator.
  const OpenField open = open_field(
      field.width_px, field.height_px,
      {std::min(kMeasuringShare, pulse.collimator.open_u), std::min(kMeasuringShare, pulse.collimator.open_v)});
  const int columns = open.end_column - open.first_column;
  std::vector<float> log_shares(static_cast<std::size_t>(columns));
  double sum = 0.0;
  for (int row = open.first_row; row < open.end_row; ++row) {
    const std::size_t first = static_cast<std::size_t>(row) * static_cast<std::size_t>(field.width_px) +
                              static_cast<std::size_t>(open.first_column);
    const auto from = [&](const std::vector<float>& mm) { return mm.empty() ? nullptr : mm.data() + first; };
    beam.log_shares(from(field.water_mm), from(field.mineral_mm), from(field.iron_mm), from(field.contrast_mm),
                    columns, log_shares.data());
    for (const float log_share : log_shares) sum += exact_exp(static_cast<double>(log_share));
  }
  const double pixels = static_cast<double>(columns) * (open.end_row - open.first_row);
  return (sum / pixels + pulse.scatter.value_or(0.0)) * pulse.grid_passes() * kNgyPerMgy *
         beam.kerma_mgy_per_mas_share() * pulse.mas() * at_distance(pulse.sid_mm);
}

cases::ExposureReport meter(Beams& beams, const AutomaticExposure& automatic, const Pulse& pulse,
                            const PathLengths& field, const cases::FluoroscopeInputs& asked) {
  const cases::Fluoroscope& f = beams.fluoroscope();
  cases::ExposureReport report;
  report.air_kerma_mgy = reference_air_kerma_mgy(beams, pulse);
  report.dap_mgy_cm2 = dose_area_mgy_cm2(beams, pulse, pulse.sid_mm);
  if (asked.automatic_exposure)
    report.next = automatic.next(pulse.technique, panel_kerma_ngy(beams, pulse, field), pulse.sid_mm);
  else
    report.next = {std::clamp(std::round(asked.kv), f.kv_min, f.kv_max), std::clamp(asked.ma, f.ma_min, f.ma_max),
                   f.pulse_ms};
  return report;
}

}  // namespace seldinger::imaging
