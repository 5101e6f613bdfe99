#include "app/measure/ultrasound_goals/elements.h"

#include <algorithm>

#include "app/measure/ultrasound_goals/polar_levels.h"
#include "sim/imaging/ultrasound/view/view.h"

namespace seldinger::measure {

Likeness likeness_to_elements(const Setting& setting, Apodisation apodisation, double focus_mm,
                              const ElementWindow& window) {
  static const TissueBlock kLiver = block_of(volume::TissueClass::liver);
  imaging::UltrasoundView view = setting.lossless_view();
  view.focus_mm = focus_mm;
  const imaging::PolarPicture picture = setting.picture(kLiver, view);
  const imaging::TissueVolume tissue = kLiver.tissue();
  const imaging::Inserted none;
  const imaging::TissueAt tissue_at(tissue, none);
  const imaging::ScattererField field(view, tissue_at);
  const ElementLevel elements(view, apodisation);
  const imaging::Fan fan = imaging::fan_of(view);

  const int step = std::max(1, view.beams / 128), middle = view.beams / 2;
  const int first = middle - step * (window.lines / 2), last = first + step * (window.lines - 1);
  const int from = sample_at(view, window.depth_mm - 0.5 * window.length_mm),
            to = sample_at(view, window.depth_mm + 0.5 * window.length_mm);
  // The widths go down to a focus and up again: the ends have the greatest.
  double beside = 0.0, reach_y_mm = 0.0;
  for (const int k : {from, to}) {
    const double depth_mm = depth_at(view, k);
    beside = std::max(beside, elements.lateral_reach_mm(depth_mm) / fan.beam_spacing_mm(depth_mm));
    reach_y_mm = std::max(
        reach_y_mm, 3.0 * imaging::beam_width(view.probe, working_mhz(view), 0.0, depth_mm).elevation_sigma_mm);
  }
  const std::vector<PlaneScatterer> scatterers =
      scatterers_in(view, field,
                    {first - beside, last + beside, depth_at(view, from) - elements.axial_reach_mm(),
                     depth_at(view, to) + elements.axial_reach_mm(), reach_y_mm});
  std::vector<double> wanted, found;
  for (int b = first; b <= last; b += step)
    for (int k = from; k < to; ++k) {
      // The picture shows speckle of one level at every depth: as if the scanner took out how many scatterers its
      // beam holds there.
      const imaging::BeamWidth width =
          imaging::beam_width(view.probe, working_mhz(view), focus_mm, depth_at(view, k));
      wanted.push_back(std::abs(elements.sample(b, depth_at(view, k), scatterers)) /
                       std::sqrt(width.lateral_sigma_mm * width.elevation_sigma_mm));
      found.push_back(at(picture, b, k));
    }
  return {correlation(wanted, found), scatterers.size(), wanted.size()};
}

void measure_elements(const Setting& setting, Readings& readings) {
  double everywhere = 0.0, one = 0.0;
  const double length_mm = setting.probe.radius_mm > 0.0 ? 4.0 : 2.0;
  for (const double share : {0.2, 0.5, 0.85})
    for (const double focus_mm : {0.0, 0.5 * setting.depth_mm()}) {
      if (setting.quick && focus_mm > 0.0) continue;
      const Likeness found = likeness_to_elements(setting, Apodisation::even, focus_mm,
                                                  {share * setting.depth_mm(), length_mm, setting.quick ? 8 : 16});
      double& worst = focus_mm > 0.0 ? one : everywhere;
      worst = farther(worst, 1.0 - found.ncc);
    }
  const std::string probe(setting.probe.name);
  readings.push_back({16, "1 - NCC with a scanner by elements", probe, everywhere, "", 0.10, 0.03});
  if (!setting.quick)
    readings.push_back({16, "1 - NCC with one by elements, one focus", probe, one, "", 0.10, 0.03});
}

}  // namespace seldinger::measure
