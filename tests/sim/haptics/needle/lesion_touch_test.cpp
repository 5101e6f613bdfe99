// Tests of sim/haptics/needle: lesions are felt, by their kind's row, in whatever form they lie in the tissue.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>

#include "sim/haptics/needle/needle_path.h"

namespace seldinger::haptics {
namespace {

using volume::TissueClass;

// Liver below z = 0, and a lesion whose near side lies 40 mm deep.
struct LiverBlock {
  volume::Volume volume;
  std::vector<TissueClass> classes;
  LiverBlock() {
    volume = volume::make_volume({60, 60, 120}, {1.0, 1.0, 1.0}, glm::dmat3(1.0), {-30.0, -30.0, -110.0});
    classes.assign(volume.hu.size(), TissueClass::liver);
    for (int k = 111; k < 120; ++k)
      for (int j = 0; j < 60; ++j)
        for (int i = 0; i < 60; ++i) classes[volume.index(i, j, k)] = TissueClass::air;
  }
};

constexpr double kNearMm = 40.0, kLesionRadiusMm = 15.0;

cases::Lesion lesion_of_kind(cases::LesionKind kind) {
  cases::Lesion lesion;
  lesion.center_lps_mm = {0.0, 0.0, -(kNearMm + kLesionRadiusMm)};
  lesion.radius_mm = kLesionRadiusMm;
  lesion.hu = 40.0;
  lesion.kind = kind;
  return lesion;
}

struct Drive {
  NeedlePath path;
  double edge_n = 0.0;    // on the tip as the lesion opens
  double inside_n = 0.0;  // in its middle
  double away_n = 0.0;    // before it
  int opened = 0;
};

Drive drive(const LiverBlock& block, const cases::Lesion& lesion) {
  const TissueAlongNeedle tissue(block.volume, block.classes, *cases::gauge(kTableGauge), {&lesion, 1});
  const NeedleLaw law({});
  NeedleTrack track;
  Drive made;
  double last_tip_n = 0.0;
  for (int tick = 0; tick < 18'000; ++tick) {
    const double depth_mm = 0.005 * tick;
    tissue.look({0.3, 0.2, 0.0}, {0.0, 0.0, -1.0}, 100.0, depth_mm, track, made.path);
    const std::size_t before = track.opened;
    const NeedleForce force = law.advance(made.path.span(), depth_mm, track);
    if (force.ruptured && before == 2) made.edge_n = last_tip_n;
    if (std::abs(track.cut_mm - 38.0) < 0.01) made.away_n = force.tip_n;
    if (std::abs(track.cut_mm - (kNearMm + kLesionRadiusMm)) < 0.01) made.inside_n = force.tip_n;
    last_tip_n = force.tip_n;
  }
  made.opened = static_cast<int>(track.opened);
  return made;
}

// The tip's force where a row cuts: its line is measured at the hub, the shaft in tissue is shorter by the reach.
double cutting_n(const NeedleTissue& row) {
  return row.intercept_n > 0.0 ? row.intercept_n / (1.0 - row.slope_n_mm / row.tip_stiffness_n_mm) : 0.0;
}

TEST(LesionTouch, EveryKindIsFeltAtItsEdgeAndInside) {
  const LiverBlock block;
  const double liver_n = cutting_n(needle_tissue(TissueClass::liver));
  for (const cases::LesionKindRow& kind : cases::lesion_kinds()) {
    if (kind.kind == cases::LesionKind::by_hu) continue;
    const Drive felt = drive(block, lesion_of_kind(kind.kind));
    const NeedleTissue row = needle_tissue(lesion_of_kind(kind.kind));
    ASSERT_GE(felt.path.count, 4U) << kind.words;
    EXPECT_EQ(felt.path.tissues[1], TissueClass::liver) << kind.words;
    EXPECT_NEAR(felt.path.layers[2].start_mm, kNearMm, 0.6) << kind.words;
    EXPECT_NEAR(felt.path.layers[3].start_mm, kNearMm + 2.0 * kLesionRadiusMm, 0.6) << kind.words;
    EXPECT_NEAR(felt.edge_n, kind.touch.edge_n, 0.02) << kind.words;
    EXPECT_NEAR(felt.inside_n, cutting_n(row), 0.02) << kind.words;
    EXPECT_NEAR(felt.away_n, liver_n, 0.02) << kind.words;
    // Its far edge gives way as its near one, and behind it lies liver again.
    EXPECT_EQ(felt.path.layers[3].tissue.rupture_n, row.rupture_n) << kind.words;
    EXPECT_EQ(felt.path.layers[3].tissue.intercept_n, needle_tissue(TissueClass::liver).intercept_n) << kind.words;
    EXPECT_EQ(felt.opened, 4) << kind.words;
    printf("%-26s edge %.2f N, inside %.2f N (liver %.2f N)\n", kind.words, felt.edge_n, felt.inside_n,
           felt.away_n);
  }
}

TEST(LesionTouch, TheFormItLiesInDoesNotMatter) {
  const LiverBlock block;
  cases::Lesion sphere = lesion_of_kind(cases::LesionKind::hcc), ellipsoid = sphere;
  ellipsoid.shape =
      std::make_shared<const cases::Shape>(cases::Ellipsoid{sphere.center_lps_mm, {18.0, 16.0, kLesionRadiusMm}});
  const Drive of_sphere = drive(block, sphere), of_ellipsoid = drive(block, ellipsoid);
  EXPECT_NEAR(of_sphere.edge_n, of_ellipsoid.edge_n, 1e-9);
  EXPECT_NEAR(of_sphere.inside_n, of_ellipsoid.inside_n, 1e-9);
}

TEST(LesionTouch, ALesionByHuIsFeltAsItsTissue) {
  const LiverBlock block;
  const Drive felt = drive(block, lesion_of_kind(cases::LesionKind::by_hu));
  const NeedleTissue row = soft_tissue_of_hu(40.0);
  EXPECT_NEAR(felt.edge_n, row.rupture_n, 0.02);
  EXPECT_NEAR(felt.inside_n, cutting_n(row), 0.02);
  // One that was painted is in the classes, and is asked there.
  cases::Lesion painted = lesion_of_kind(cases::LesionKind::by_hu);
  painted.shape = std::make_shared<const cases::Shape>(cases::shape_of(painted));
  EXPECT_EQ(drive(block, painted).path.count, 2U) << "skin and liver";
}

TEST(LesionTouch, RowsArePhysicalAndSayWhereTheyComeFrom) {
  for (const cases::LesionKindRow& kind : cases::lesion_kinds()) {
    EXPECT_EQ(&cases::about(kind.kind), &kind);
    if (kind.kind == cases::LesionKind::by_hu) continue;
    EXPECT_GT(std::string(kind.look_source).size(), 10U) << kind.words;
    EXPECT_GT(std::string(kind.touch_source).size(), 10U) << kind.words;
    EXPECT_GT(kind.touch.edge_n, 0.0) << kind.words;
    EXPECT_GT(kind.touch.dent_mm, 0.0) << kind.words;
    if (kind.touch.cutting_n > 0.0) {
      EXPECT_GT(kind.touch.tip_stiffness_n_mm, kind.touch.slope_n_mm) << kind.words;
    }
  }
}

}  // namespace
}  // namespace seldinger::haptics
