// Statistics of speckle and how it moves (goals 6 to 9 and 15).
#include "sim/imaging/ultrasound/scatterers.h"

#include "ultrasound_scene.h"

namespace seldinger::imaging {
namespace {

const Scene& liver() {
  static const Scene kLiver = all_of(TissueClass::liver);
  return kLiver;
}

UltrasoundView lossless(UltrasoundView view) {
  view.attenuation_db_cm_mhz = 0.0;
  return view;
}

TEST(Goal6, SpeckleIsRayleighAtFiveDepths) {
  for (UltrasoundView view : {lossless(curved_view()), lossless(straight_view())}) {
    std::vector<std::vector<double>> envelope(5);
    double cells = 1e30;
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
      view.seed = seed;
      const PolarPicture picture = polar_of(liver(), view);
      for (int d = 0; d < 5; ++d) {
        const int middle = static_cast<int>((0.1 + 0.2 * d) * view.samples);
        for (int b = 0; b < view.beams; ++b)
          for (int k = middle - 40; k < middle + 40; ++k)
            envelope[static_cast<std::size_t>(d)].push_back(at(picture, b, k));
        const double depth_mm = (0.1 + 0.2 * d) * view.depth_mm;
        const BeamWidth w = beam_width(view.probe, view.probe.frequency_mhz, 0, depth_mm);
        const double spacing = fan_of(view).beam_spacing_mm(depth_mm);
        // Independent values in the window, of beams no more than there are: a cell is √(2π)·σ wide.
        const double across = std::min(1.0, spacing / (2.5066 * w.lateral_sigma_mm)) * view.beams;
        const double down = 80.0 * view.depth_mm / view.samples / (2.5066 * w.axial_sigma_mm);
        cells = std::min(cells, 8.0 * across * down);
      }
    }
    EXPECT_GE(cells, 7000.0) << view.probe.name;
    for (int d = 0; d < 5; ++d) {
      std::vector<double>& e = envelope[static_cast<std::size_t>(d)];
      double s1 = 0, s2 = 0, s4 = 0;
      for (const double v : e) s1 += v, s2 += v * v, s4 += v * v * v * v;
      const double n = static_cast<double>(e.size()), mean = s1 / n, square = s2 / n;
      const double snr = mean / std::sqrt(square - mean * mean), m = square * square / (s4 / n - square * square);
      std::sort(e.begin(), e.end());
      double ks = 0.0;
      for (std::size_t i = 0; i < e.size(); ++i)
        ks = std::max(ks, std::abs((static_cast<double>(i) + 0.5) / n - (1.0 - std::exp(-e[i] * e[i] / square))));
      printf("goal 6: %s at %.0f mm: SNR %.3f, KS %.4f, m %.3f, mean square %.3f\n", view.probe.name.data(),
             (0.1 + 0.2 * d) * view.depth_mm, snr, ks, m, square);
      EXPECT_NEAR(snr, 1.913, 0.06);
      EXPECT_LE(ks, 0.03);
      EXPECT_NEAR(m, 1.0, 0.1);
      EXPECT_NEAR(square, 1.0, 0.06);  // unit energy of the PSF at every depth
    }
  }
}

// Of the intensity, between values `lag` apart.
double covariance(const std::vector<double>& a, const std::vector<double>& b) {
  return correlation(a, b);
}

// exp(−lag²/2σ²) through correlations at two lags → FWHM.
double fwhm_from(double lag_mm, double r) {
  return 2.3548 * lag_mm / std::sqrt(-2.0 * std::log(r));
}

TEST(Goal7, SpeckleIsAsWideAsTheBeam) {
  for (UltrasoundView view : {lossless(curved_view()), lossless(straight_view())}) {
    view.beams = 512;
    const Fan fan = fan_of(view);
    for (const double share : {0.2, 0.5, 0.85}) {
      const double depth_mm = share * view.depth_mm;
      const BeamWidth width = beam_width(view.probe, view.probe.frequency_mhz, 0, depth_mm);
      const int middle = sample_at(view, depth_mm), half = 60;
      // Lags of about one σ.
      const int down = std::max(1, static_cast<int>(std::lround(width.axial_sigma_mm / fan.sample_mm)));
      const int across =
          std::max(1, static_cast<int>(std::lround(width.lateral_sigma_mm / fan.beam_spacing_mm(depth_mm))));
      const double out_mm = width.elevation_sigma_mm;
      std::vector<double> here, below, beside, away;
      for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        view.seed = seed;
        view.origin_lps_mm = {0, 0, 0};
        const PolarPicture picture = polar_of(liver(), view);
        view.origin_lps_mm = {0, 0, out_mm};
        const PolarPicture other = polar_of(liver(), view);
        for (int b = 0; b + across < view.beams; ++b)
          for (int k = middle - half; k < middle + half; ++k) {
            const auto squared = [](float v) { return double{v} * v; };
            here.push_back(squared(at(picture, b, k)));
            below.push_back(squared(at(picture, b, k + down)));
            beside.push_back(squared(at(picture, b + across, k)));
            away.push_back(squared(at(other, b, k)));
          }
      }
      const double axial =
                       fwhm_from(down * fan.sample_mm, covariance(here, below)) / (2.3548 * width.axial_sigma_mm),
                   lateral = fwhm_from(across * fan.beam_spacing_mm(depth_mm), covariance(here, beside)) /
                             (2.3548 * width.lateral_sigma_mm),
                   elevation = fwhm_from(out_mm, covariance(here, away)) / (2.3548 * width.elevation_sigma_mm);
      printf("goal 7: %s at %.0f mm: axial %.3f, lateral %.3f, elevation %.3f of the PSF\n", view.probe.name.data(),
             depth_mm, axial, lateral, elevation);
      EXPECT_NEAR(axial, 1.0, 0.1);
      EXPECT_NEAR(lateral, 1.0, 0.1);
      EXPECT_NEAR(elevation, 1.0, 0.1);
    }
  }
}

// Rows of one picture around a depth, `beams_off` further on.
std::vector<double> window(const PolarPicture& picture, int middle, int beams_off, int samples_off = 0) {
  std::vector<double> values;
  for (int b = 20; b < picture.beams - 20; ++b)
    for (int k = middle - 60; k < middle + 60; ++k) values.push_back(at(picture, b + beams_off, k + samples_off));
  return values;
}

TEST(Goal8, SpeckleStaysWithTheTissueWhenTheProbeMovesAcross) {
  UltrasoundView view = lossless(straight_view());
  view.beams = 512;  // 0.075 mm apart
  const PolarPicture still = polar_of(liver(), view);
  double worst = 1.0;
  for (const int beams : {1, 2, 3}) {
    view.origin_lps_mm = {beams * 0.075, 0, 0};
    const PolarPicture moved = polar_of(liver(), view);
    for (const double share : {0.1, 0.3, 0.5, 0.7, 0.9}) {
      const int middle = static_cast<int>(share * view.samples);
      const double r = correlation(window(still, middle, beams), window(moved, middle, 0));
      worst = std::min(worst, r);
      EXPECT_GE(r, 0.98) << beams << " beams, " << share;
    }
  }
  printf("goal 8: lateral shift, r at least %.4f\n", worst);
}

TEST(Goal8, SpeckleStaysWithTheTissueWhenTheProbeIsPressedIn) {
  UltrasoundView view = lossless(straight_view());
  const TissueAt tissue_at(liver().tissue(), {});
  const ScattererField field(view, tissue_at);
  const PolarPicture still = polar_of(liver(), view);
  view.origin_lps_mm = {0, 4.0 * view.depth_mm / view.samples, 0};
  const PolarPicture moved = polar_of(liver(), view);
  int windows = 0;
  for (int middle = 80; middle < view.samples - 80; middle += 40) {
    const double r = correlation(window(still, middle, 0, 4), window(moved, middle, 0)),
                 spacing_mm = field.lattice_at((middle - 70) * view.depth_mm / view.samples).spacing_mm;
    // Where one lattice takes over from another, a strip as thick as the movement is new.
    bool one_lattice = true;
    for (int k = middle - 70; k <= middle + 70; ++k)
      one_lattice =
          one_lattice && field.lattice_at((k + 0.5) * view.depth_mm / view.samples).spacing_mm == spacing_mm;
    windows += one_lattice;
    EXPECT_GE(r, one_lattice ? 0.98 : 0.85) << middle;
  }
  EXPECT_GE(windows, 3);
}

TEST(Goal8, OutOfThePlaneItChangesAsTheBeamIsThick) {
  double worst = 0.0;
  for (UltrasoundView view : {lossless(curved_view()), lossless(straight_view())}) {
    std::vector<PolarPicture> still;
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
      view.seed = seed;
      still.push_back(polar_of(liver(), view));
    }
    for (const double depth_mm : {0.15 * view.depth_mm, 0.4 * view.depth_mm, 0.8 * view.depth_mm})
      for (const double sigmas : {0.25, 0.5, 1.0, 2.0}) {
        const double sigma_mm = beam_width(view.probe, view.probe.frequency_mhz, 0, depth_mm).elevation_sigma_mm;
        double r = 0.0;
        for (std::uint64_t seed = 1; seed <= 2; ++seed) {
          view.seed = seed;
          view.origin_lps_mm = {0, 0, sigmas * sigma_mm};
          const PolarPicture moved = polar_of(liver(), view);
          std::vector<double> a = window(still[seed - 1], sample_at(view, depth_mm), 0),
                              b = window(moved, sample_at(view, depth_mm), 0);
          for (double& v : a) v *= v;
          for (double& v : b) v *= v;
          r += correlation(a, b) / 2.0;
        }
        const double off = std::abs(r - std::exp(-0.5 * sigmas * sigmas));
        worst = std::max(worst, off);
        EXPECT_LE(off, 0.10) << view.probe.name << " at " << depth_mm << ", " << sigmas;
      }
  }
  printf("goal 8: elevation, correlation off by at most %.3f\n", worst);
}

// The order in which cubes are gone through depends on the view's direction; which scatterers there are must not.
TEST(Goal8, TurningTheProbeChangesNoScatterer) {
  const auto turned = [](double degrees) {
    UltrasoundView view = lossless(straight_view());
    const double a = degrees * M_PI / 180.0;
    view.lateral = {std::cos(a), 0.0, std::sin(a)};
    return polar_of(liver(), view);
  };
  const PolarPicture one = turned(44.99), other = turned(45.01);
  for (const int middle : {200, 500, 800})
    EXPECT_GE(correlation(window(one, middle, 0), window(other, middle, 0)), 0.99) << middle;
}

TEST(Goal9, ContrastOfTissuesIsTheirScatter) {
  for (const TissueClass tissue :
       {TissueClass::spleen, TissueClass::fat, TissueClass::skin, TissueClass::connective}) {
    const Scene s =
        scene([=](const glm::dvec3& p) { return std::hypot(p.x, p.y - 25.0) < 10.0 ? tissue : TissueClass::liver; },
              {100, 180, 60}, 0.5);
    // Echoes at the cylinder's wall stay out: what is asked is speckle, inside and above.
    UltrasoundView view = lossless(straight_view(40.0));
    double inside = 0.0, outside = 0.0;
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
      view.seed = seed;
      const PolarPicture picture = polar_of(s, view);
      inside += level_db(picture, 50, 78, sample_at(view, 21.0), sample_at(view, 29.0)) / 6.0;
      outside += level_db(picture, 50, 78, sample_at(view, 5.0), sample_at(view, 13.0)) / 6.0;
    }
    const AcousticTable& table = acoustic_table();
    const double wall = line_of(s, view, 64).loss_db[static_cast<std::size_t>(sample_at(view, 25.0))];
    const double wanted = table[static_cast<std::size_t>(tissue)].scatter_db - wall;
    printf("goal 9: %.2f dB, expected %.2f\n", inside - outside, wanted);
    EXPECT_NEAR(inside - outside, wanted, 1.0);
  }
}

TEST(Goal15, TheSameBitsAgainAndForAnyNumberOfThreads) {
  UltrasoundView view = curved_view();
  view.threads = 1;
  const PolarPicture one = polar_of(liver(), view);
  for (const int threads : {1, 2, 3, 7}) {
    view.threads = threads;
    EXPECT_EQ(polar_of(liver(), view).envelope, one.envelope) << threads;  // also: a still picture does not flicker
  }
  view.seed = 2;
  EXPECT_NE(polar_of(liver(), view).envelope, one.envelope);
}

TEST(Goal15, BlocksOfBeamsAddUpToTheSameWholeNumbers) {
  const UltrasoundView view = curved_view();
  const TissueAt tissue_at(liver().tissue(), {});
  const ScattererField field(view, tissue_at);
  std::vector<std::int32_t> all, part;
  field.add_beams(40, 56, all);
  field.add_beams(44, 52, part);
  // The frame of a block rounds the places of scatterers: a few fall over a fine sample's border, the rest agree.
  const std::size_t row = static_cast<std::size_t>(view.samples * field.fine()) * 2;
  std::size_t far = 0;
  double scale = 0.0;
  for (const std::int32_t v : part) scale = std::max(scale, std::abs(double{static_cast<double>(v)}));
  ASSERT_GT(scale, 1e4);
  for (std::size_t i = 0; i < part.size(); ++i)
    far += std::abs(static_cast<double>(part[i]) - all[4 * row + i]) > 0.01 * scale;
  EXPECT_LE(static_cast<double>(far) / static_cast<double>(part.size()), 0.01);
}

}  // namespace
}  // namespace seldinger::imaging
