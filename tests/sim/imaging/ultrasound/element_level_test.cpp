// The scanner by elements against closed forms, then the picture against it (goal 16).
#include "app/measure/ultrasound_goals/element_level.h"

#include "app/measure/ultrasound_goals/elements.h"
#include "shaders/shared/ultrasound.glsl.h"
#include "tests/sim/imaging/ultrasound/ultrasound_scene.h"

namespace seldinger::imaging {
namespace {

using measure::Apodisation;
using measure::ElementLevel;
using measure::likeness_to_elements;
using measure::PlaneScatterer;

PlaneScatterer point_at(const UltrasoundView& view, double beam, double depth_mm) {
  const glm::dvec3 p = point_of(view, beam, depth_mm);
  return {p.x, p.y, 0.0, beam, depth_mm, 1.0};
}

// Where |f| falls to half, from 0 outwards in steps, interpolated.
double half_at(double step, const std::function<double(double)>& f) {
  const double whole = f(0.0);
  double before = whole;
  for (double at = step;; at += step) {
    const double now = f(at);
    if (now <= 0.5 * whole) return at - step * (0.5 * whole - now) / (before - now);
    before = now;
  }
}

TEST(ElementLevel, APointShowsAtItsDepthAsLongAsThePulse) {
  for (const UltrasoundView& view : {curved_view(), straight_view()})
    for (const double focus_mm : {0.0, 0.5 * view.depth_mm})
      for (const double share : {0.2, 0.5, 0.85}) {
        UltrasoundView focused = view;
        focused.focus_mm = focus_mm;
        const ElementLevel elements(focused, Apodisation::even);
        const double depth_mm = share * view.depth_mm;
        const std::vector<PlaneScatterer> one = {point_at(view, 64.0, depth_mm)};
        const auto level = [&](double off_mm) { return std::abs(elements.sample(64.0, depth_mm + off_mm, one)); };
        const double below = half_at(0.005, level), above = half_at(0.005, [&](double mm) { return level(-mm); });
        EXPECT_NEAR(0.5 * (below - above), 0.0, 0.02) << view.probe.name << " " << depth_mm;
        const double fwhm_mm = shaders::us_axial_fwhm_mm(view.probe.frequency_mhz, view.probe.bandwidth);
        if (focus_mm == 0.0) {
          EXPECT_NEAR(level(0.0), 1.0, 1e-9);
          EXPECT_NEAR((below + above) / fwhm_mm, 1.0, 0.03) << view.probe.name << " " << depth_mm;
        }
      }
}

// Two-way −6 dB width over 0.89·λ·F.
double width_ratio(const UltrasoundView& view, Apodisation apodisation, double depth_mm) {
  const ElementLevel elements(view, apodisation);
  const double wanted_mm =
                   shaders::us_lateral_fwhm_mm(depth_mm, shaders::us_wavelength_mm(view.probe.frequency_mhz),
                                               view.probe.f_number, view.probe.aperture_mm, 0.0),
               spacing_mm = fan_of(view).beam_spacing_mm(depth_mm);
  const double middle = 0.5 * view.beams;
  const double half_mm = half_at(0.02, [&](double mm) {
    const std::vector<PlaneScatterer> one = {point_at(view, middle + mm / spacing_mm, depth_mm)};
    return std::abs(elements.sample(middle, depth_mm, one));
  });
  return 2.0 * half_mm / wanted_mm;
}

TEST(ElementLevel, ItsWidthIsThatOfARectangularAperture) {
  for (const double share : {0.3, 0.6, 0.9}) {
    // Elements so small that they look everywhere alike, and F so great that a cosine does not matter.
    UltrasoundView fine = straight_view();
    fine.probe.elements *= 4;
    fine.probe.pitch_mm /= 4.0;
    fine.probe.f_number = 4.0;
    for (const Apodisation apodisation : {Apodisation::even, Apodisation::gaussian})
      EXPECT_NEAR(width_ratio(fine, apodisation, share * fine.depth_mm), 1.0, 0.04) << share;
    // The probes' own elements look ahead, a curve's apart, and so use less of the aperture.
    for (const UltrasoundView& view : {curved_view(), straight_view()}) {
      const double ratio = width_ratio(view, Apodisation::even, share * view.depth_mm);
      printf("element level: %s at %.0f mm: %.3f of 0.89 lambda F\n", std::string(view.probe.name).c_str(),
             share * view.depth_mm, ratio);
      EXPECT_GT(ratio, 1.0);
      EXPECT_LT(ratio, 1.16);
    }
  }
}

TEST(ElementLevel, EchoesAdd) {
  const UltrasoundView view = straight_view();
  const ElementLevel elements(view, Apodisation::even);
  const PlaneScatterer a = point_at(view, 63.6, 25.02);
  PlaneScatterer b = point_at(view, 64.7, 24.95);
  b.amplitude = 0.7;
  b.y_mm = 0.3;
  const auto of = [&](std::vector<PlaneScatterer> some) { return elements.sample(64.0, 25.0, some); };
  EXPECT_NEAR(std::abs(of({a, b}) - of({a}) - of({b})), 0.0, 1e-12);
  EXPECT_GT(std::abs(of({b})), 0.01);
  // Off the plane by its own Gaussian.
  PlaneScatterer flat = b;
  flat.y_mm = 0.0;
  const double sigma_mm = beam_width(view.probe, view.probe.frequency_mhz, 0.0, b.depth_mm).elevation_sigma_mm;
  EXPECT_NEAR(std::abs(of({b})) / std::abs(of({flat})), std::exp(-0.5 * std::pow(0.3 / sigma_mm, 2)), 1e-9);
}

TEST(ElementLevel, AtItsFocusOneFocusIsAsGoodAsMany) {
  UltrasoundView view = curved_view();
  const PlaneScatterer beside = point_at(view, 64.4, 75.1);
  const ElementLevel many(view, Apodisation::even);
  view.focus_mm = 75.0;
  const ElementLevel one(view, Apodisation::even);
  const std::vector<PlaneScatterer> scatterers = {beside};
  EXPECT_NEAR(std::abs(one.sample(64.0, 75.0, scatterers) - many.sample(64.0, 75.0, scatterers)), 0.0, 1e-9);
  EXPECT_LT(std::abs(one.sample(64.0, 30.0, std::vector<PlaneScatterer>{point_at(view, 64.0, 30.0)})), 0.9);
}

TEST(Goal16, ThePictureIsLikeTheScannersByElements) {
  for (const Probe& probe : kRealProbes)
    for (const double focus_mm : {0.0, 0.5 * practised(probe).depth_mm()}) {
      const measure::Setting setting = practised(probe);
      const measure::Likeness found =
          likeness_to_elements(setting, Apodisation::even, focus_mm, {0.5 * setting.depth_mm(), 2.0, 8});
      printf("goal 16: %s, focus %.0f mm: NCC %.4f of %zu scatterers\n", std::string(probe.name).c_str(), focus_mm,
             found.ncc, found.scatterers);
      EXPECT_GE(found.ncc, 0.9) << probe.name << " " << focus_mm;
      EXPECT_GT(found.scatterers, 4000U);
    }
}

}  // namespace
}  // namespace seldinger::imaging
