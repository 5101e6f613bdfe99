#include "sim/imaging/probe.h"

#include "shaders/shared/ultrasound.glsl.h"

namespace seldinger::imaging {

const Probe* probe_named(std::string_view name) noexcept {
  for (const Probe& probe : kProbes)
    if (probe.name == name) return &probe;
  return nullptr;
}

double elevation_fwhm_mm(const Probe& probe, double frequency_mhz, double depth_mm) noexcept {
  return shaders::us_elevation_fwhm_mm(depth_mm, shaders::us_wavelength_mm(frequency_mhz), probe.height_mm,
                                       probe.elevation_focus_mm);
}

BeamWidth beam_width(const Probe& probe, double frequency_mhz, double focus_mm, double depth_mm) noexcept {
  const double wavelength_mm = shaders::us_wavelength_mm(frequency_mhz);
  return {shaders::us_axial_fwhm_mm(frequency_mhz, probe.bandwidth) / shaders::kUsFwhmPerSigma,
          shaders::us_lateral_fwhm_mm(depth_mm, wavelength_mm, probe.f_number, probe.aperture_mm, focus_mm) /
              shaders::kUsFwhmPerSigma,
          elevation_fwhm_mm(probe, frequency_mhz, depth_mm) / shaders::kUsFwhmPerSigma};
}

}  // namespace seldinger::imaging
