// Speckle by definition: every scatterer of the lattice, in double, each with its own Gaussians at exactly its
// place, summed for every sample of a beam. No tiles, tables, fine samples or whole numbers.
#include <complex>

#include "app/measure/ultrasound_goals/plane_scatterers.h"
#include "shaders/shared/ultrasound.glsl.h"
#include "sim/imaging/ultrasound/speckle/scatterers.h"
#include "tests/sim/imaging/ultrasound/ultrasound_scene.h"

namespace seldinger::imaging {
namespace {

TEST(Reference, TheFastSumIsTheDefinition) {
  for (UltrasoundView view : {curved_view(50.0), straight_view(15.0)}) {
    view.attenuation_db_cm_mhz = 0.0;
    view.samples = static_cast<int>(view.depth_mm * (fan_of(view).curved ? 7 : 20));
    // Askew to the lattice.
    view.axial = glm::normalize(glm::dvec3(0.3, 0.9, 0.2));
    view.lateral = glm::normalize(glm::cross(view.axial, glm::dvec3(0.2, 0.1, -1.0)));
    view.origin_lps_mm = {3.3, -7.7, 1.1};
    const Scene liver = all_of(TissueClass::liver);
    const TissueAt tissue_at(liver.tissue(), {});
    const ScattererField field(view, tissue_at);
    const PolarPicture fast = polar_of(liver, view);
    const double wavelength_mm = shaders::us_wavelength_mm(view.probe.frequency_mhz);
    const std::vector<measure::PlaneScatterer> scatterers = measure::scatterers_in(
        view, field,
        {-8.0, view.beams + 8.0, 0.0, view.depth_mm,
         4.0 * std::max(beam_width(view.probe, view.probe.frequency_mhz, 0, 0.01).elevation_sigma_mm,
                        beam_width(view.probe, view.probe.frequency_mhz, 0, view.depth_mm).elevation_sigma_mm)});
    ASSERT_GT(scatterers.size(), 10000U);
    const Fan fan = fan_of(view);
    std::vector<double> wanted, found;
    for (const int beam : {0, 1, 30, 63, 64, 101, 127}) {
      std::vector<std::complex<double>> signal(static_cast<std::size_t>(view.samples));
      for (const measure::PlaneScatterer& s : scatterers) {
        const BeamWidth w = beam_width(view.probe, view.probe.frequency_mhz, 0, std::max(s.depth_mm, 0.01));
        const double u = (s.beam - beam) * fan.beam_spacing_mm(s.depth_mm) / w.lateral_sigma_mm,
                     v = s.y_mm / w.elevation_sigma_mm;
        if (std::abs(u) > 4.0 || std::abs(v) > 4.0) continue;
        const double unit =
            std::pow(M_PI, 0.75) * std::sqrt(w.axial_sigma_mm * w.lateral_sigma_mm * w.elevation_sigma_mm);
        const std::complex<double> echo =
            s.amplitude / unit *
            std::polar(std::exp(-0.5 * (u * u + v * v)), -4.0 * M_PI * s.depth_mm / wavelength_mm);
        const int middle = sample_at(view, s.depth_mm),
                  reach = static_cast<int>(5.0 * w.axial_sigma_mm / fan.sample_mm) + 1;
        for (int k = std::max(0, middle - reach); k <= std::min(view.samples - 1, middle + reach); ++k) {
          const double off = ((k + 0.5) * fan.sample_mm - s.depth_mm) / w.axial_sigma_mm;
          signal[static_cast<std::size_t>(k)] += echo * std::exp(-0.5 * off * off);
        }
      }
      for (int k = 0; k < view.samples; ++k) {
        wanted.push_back(std::abs(signal[static_cast<std::size_t>(k)]));
        found.push_back(at(fast, beam, k));
      }
    }
    double off = 0.0, all = 0.0;
    for (std::size_t i = 0; i < wanted.size(); ++i)
      off += (found[i] - wanted[i]) * (found[i] - wanted[i]), all += wanted[i] * wanted[i];
    const double r = correlation(wanted, found);
    printf("reference: %s: correlation %.5f, RMS difference %.1f dB below the signal\n", view.probe.name.data(), r,
           -10.0 * std::log10(off / all));
    EXPECT_GE(r, 0.99);
    EXPECT_LE(off / all, 0.01);
  }
}

}  // namespace
}  // namespace seldinger::imaging
