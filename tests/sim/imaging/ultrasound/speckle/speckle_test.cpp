// Statistics of speckle and how it moves (goals 6 to 9 and 15).
#include "sim/imaging/ultrasound/speckle/scatterers.h"

#include "app/measure/ultrasound_goals/speckle.h"
#include "tests/sim/imaging/ultrasound/ultrasound_scene.h"

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
  for (const Probe& probe : kRealProbes) {
    const measure::Setting setting = practised(probe);
    const auto at_depths = measure::speckle_statistics(setting);
    measure::Readings readings;
    measure::read_statistics(setting, at_depths, readings);
    ASSERT_EQ(readings.size(), 3U);
    for (const measure::Reading& reading : readings) expect_holds(setting, reading);
    for (const measure::SpeckleStatistics& found : at_depths) {
      EXPECT_GE(found.cells, measure::kLeastCells) << probe.name << " " << found.depth_mm;
      EXPECT_NEAR(found.mean_square, 1.0, 0.06) << probe.name << " " << found.depth_mm;  // unit energy of the PSF
    }
  }
}

TEST(Goal7, SpeckleIsAsWideAsTheBeam) {
  for (const Probe& probe : kRealProbes) expect_holds(practised(probe), &measure::measure_widths);
}

// Rows of one picture around a depth, `beams_off` further on.
std::vector<double> window(const PolarPicture& picture, int middle, int beams_off, int samples_off = 0) {
  std::vector<double> values;
  for (int b = 20; b < picture.beams - 20; ++b)
    for (int k = middle - 60; k < middle + 60; ++k) values.push_back(at(picture, b + beams_off, k + samples_off));
  return values;
}

TEST(Goal8, SpeckleStaysWithTheTissueAcrossAndChangesOutOfThePlaneAsTheBeamIsThick) {
  for (const Probe& probe : kRealProbes) expect_holds(practised(probe), &measure::measure_motion);
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
  for (const Probe& probe : kRealProbes) expect_holds(practised(probe), &measure::measure_contrast);
}

TEST(Goal15, TheSameBitsAgainAndForAnyNumberOfThreads) {
  for (const Probe& probe : kProbes) expect_holds(practised(probe), &measure::measure_bits);
}

TEST(Goal15, AnotherSeedIsAnotherTissue) {
  UltrasoundView view = curved_view();
  const PolarPicture one = polar_of(liver(), view);
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
