// Behind a plate of bone (3): where its shadow ends, and how deep it is.
#include <algorithm>

#include "app/measure/ultrasound_goals/goal.h"
#include "app/measure/ultrasound_goals/polar_levels.h"
#include "shaders/shared/ultrasound.glsl.h"
#include "sim/imaging/ultrasound/view/fan.h"
#include "sim/imaging/ultrasound/view/view.h"

namespace seldinger::measure {

using imaging::PolarPicture;
using imaging::UltrasoundView;
using volume::TissueClass;

void measure_shadow(const Setting& setting, Readings& readings) {
  constexpr double kHalfMm = 12.0, kTopMm = 20.0, kThickMm = 2.0;
  const TissueBlock with = tissue_block(
                        [=](const glm::dvec3&p) {
                          return std::abs(p.x) < kHalfMm && p.y > kTopMm && p.y < kTopMm + kThickMm
                                     ? TissueClass::bone
                                     : TissueClass::liver;
                        },
                        {100, 100, 30}, 1.0),
                    without =
                        tissue_block([](const glm::dvec3&) { return TissueClass::liver; }, {100, 100, 30}, 1.0);
  UltrasoundView view = setting.lossless_view();
  view.depth_mm = 50.0;
  view.samples = static_cast<int>(setting.samples * 50.0 / setting.depth_mm());
  // A tenth of a beam is told by more of them.
  if (setting.quality == Quality::reference) view.beams *= 2;
  const imaging::Acoustics& bone = imaging::acoustic_table()[static_cast<std::size_t>(TissueClass::bone)];
  const double liver_mrayl =
      imaging::acoustic_table()[static_cast<std::size_t>(TissueClass::liver)].impedance_mrayl;
  const double walls_db = 2.0 * shaders::us_step_loss_db(shaders::us_reflection(liver_mrayl, bone.impedance_mrayl));
  const double bone_db_mm =
      shaders::us_loss_db_per_mm(bone.attenuation_db_cm_mhz, bone.exponent, working_mhz(view));
  const double middle_mm = kTopMm + 0.5 * kThickMm;
  // Any way through the plate passes two walls: half the drop is reached where the beam runs this far inside it.
  const double half_db = 0.5 * (walls_db + bone_db_mm * kThickMm),
               half_way_mm = std::max(0.0, half_db - walls_db) / bone_db_mm;
  double worst_edge = 0.0, worst_depth = 0.0;
  // The probe stands anew each time: the plate's edges between beams, its faces between samples.
  const int places = setting.quick ? 3 : 5;
  for (int place = 0; place < places; ++place) {
    const imaging::Fan still = imaging::fan_of(view);
    view.origin_lps_mm = {(0.13 + 0.2 * place) * still.beam_spacing_mm(0.0),
                          (0.07 + 0.17 * place) * still.sample_mm, 0.0};
    view.seed = static_cast<std::uint64_t>(place) + 1;
    const imaging::Fan fan = imaging::fan_of(view);
    const PolarPicture dark = setting.picture(with, view), bright = setting.picture(without, view);
    // Of the same speckle with and without the plate, each beam.
    std::vector<double> drop_db(static_cast<std::size_t>(view.beams)), across_mm(drop_db.size());
    const int low = sample_at(view, 32.0), high = sample_at(view, 48.0);
    double sum = 0.0, wanted = 0.0;
    int inside = 0;
    for (int b = 0; b < view.beams; ++b) {
      const auto i = static_cast<std::size_t>(b);
      drop_db[i] = level_db(bright, b, b + 1, low, high) - level_db(dark, b, b + 1, low, high);
      const glm::dvec3 start = fan.start_lps_mm(b), direction = fan.direction(b);
      across_mm[i] = start.x + (kTopMm - start.y + half_way_mm * direction.y) / direction.y * direction.x;
      if (std::abs(across_mm[i]) > kHalfMm - 3.0 * fan.beam_spacing_mm(middle_mm) - 0.5) continue;
      sum += drop_db[i];
      wanted += walls_db + bone_db_mm * kThickMm / direction.y;
      ++inside;
    }
    worst_depth = farther(worst_depth, std::abs(sum - wanted) / inside);
    // "A beam": the spacing of 128 there.
    const double beam_mm = fan.beam_spacing_mm(middle_mm) * view.beams / 128.0;
    double edge_off = NAN;
    for (int b = 0; b + 1 < view.beams; ++b) {
      const auto i = static_cast<std::size_t>(b);
      if ((drop_db[i] > half_db) == (drop_db[i + 1] > half_db)) continue;
      const double share = (half_db - drop_db[i]) / (drop_db[i + 1] - drop_db[i]);
      const double edge_mm = across_mm[i] + share * (across_mm[i + 1] - across_mm[i]);
      const double off = std::abs(std::abs(edge_mm) - kHalfMm) / beam_mm;
      edge_off = std::isnan(edge_off) ? off : std::max(edge_off, off);
    }
    worst_edge = farther(worst_edge, edge_off);
  }
  const std::string probe(setting.probe.name);
  readings.push_back({3, "edge of a bone's shadow", probe, worst_edge, "beams of 128", 0.5, 0.1});
  readings.push_back({3, "depth of a bone's shadow", probe, worst_depth, "dB", 0.5, 0.1});
}

}  // namespace seldinger::measure
