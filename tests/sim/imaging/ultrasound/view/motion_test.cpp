// Pictures of tissue that moves: what moves as one is seen as by a probe that moves the other way, what is pressed
// or dragged is where the displacement puts it, and who lies still is drawn as ever.
#include "sim/imaging/ultrasound/view/motion.h"

#include "sim/imaging/ultrasound/speckle/lattice.h"
#include "sim/imaging/ultrasound/speckle/scatterers.h"
#include "sim/imaging/ultrasound/visible.h"
#include "tests/sim/imaging/ultrasound/ultrasound_scene.h"

namespace seldinger::imaging {
namespace {

constexpr UltrasoundMethod kMethods[] = {UltrasoundMethod::scatterers, UltrasoundMethod::lattice,
                                         UltrasoundMethod::thesis};

// A breath of a trunk so large that all of a picture moves by u, as one: at 0.7 of the way to the front, where
// organs go all the way and the wall eased(0.7) of it.
tissue::Displacement all_by(const glm::dvec3& u_mm) {
  constexpr double kLarge = 1e7;
  return tissue::displacement_of({.breath = tissue::Breath{.region = {.middle_x_mm = 0.0,
                                                                      .half_width_mm = kLarge,
                                                                      .back_y_mm = 0.7 * kLarge,
                                                                      .depth_mm = kLarge,
                                                                      .above_mm = kLarge,
                                                                      .below_mm = kLarge},
                                                           .amount_mm = {-u_mm.x, -u_mm.y / 0.784, -u_mm.z}}});
}
tissue::Displacement pressed(double depth_mm) {
  const tissue::SkinPress press{
      .at_lps_mm = {0, 0, 0}, .inward = {0, 1, 0}, .radius_mm = 20.0, .depth_mm = depth_mm};
  return tissue::displacement_of({.presses = {&press, 1}});
}
// In the picture's plane, from the left of the face down to the middle.
constexpr glm::dvec3 kEntry{-25.0, 0.0, 0.0};
tissue::NeedleDrag needle(double shaft_mm) {
  return {.entry_lps_mm = kEntry,
          .direction = glm::normalize(glm::dvec3(0.5, 1.0, 0.0)),
          .cut_mm = 50.0,
          .shaft_mm = shaft_mm};
}
tissue::Displacement dragged(double shaft_mm) {
  return tissue::displacement_of({.needle = needle(shaft_mm)});
}

PolarPicture moved(const Scene& s, const UltrasoundView& view, const tissue::Displacement& displacement,
                   const Inserted& inserted = {}) {
  PolarPicture picture;
  ultrasound_polar(s.tissue(), view, inserted, {}, picture, displacement);
  return picture;
}

// Fat over liver with a cyst, a slanted border between, no air above the face.
Scene layers() {
  return scene([](const glm::dvec3& p) {
    if (glm::length(p - glm::dvec3(8.0, 34.0, 2.0)) < 7.0) return TissueClass::fluid;
    return p.y < 14.0 + 0.2 * p.x ? TissueClass::fat : TissueClass::liver;
  });
}
std::vector<UltrasoundView> views() {
  std::vector<UltrasoundView> all;
  for (UltrasoundView view : {curved_view(100.0), straight_view(45.0)})
    for (const UltrasoundMethod method : kMethods) {
      view.method = method;
      view.beams = 64;
      view.samples = 700;
      all.push_back(view);
    }
  return all;
}

std::vector<double> all_db(const PolarPicture& picture) {
  std::vector<double> levels;
  for (const float amplitude : picture.envelope)
    levels.push_back(static_cast<double>(std::max(-60.0F, level_db_of(amplitude))));
  return levels;
}

TEST(UltrasoundMotion, WithoutSourcesThePictureHasTheSameBits) {
  const Scene s = layers();
  for (const UltrasoundView& view : views()) {
    const PolarPicture still = polar_of(s, view);
    EXPECT_EQ(moved(s, view, tissue::Displacement{}).envelope, still.envelope);
    EXPECT_EQ(moved(s, view, tissue::displacement_of({})).envelope, still.envelope);
    EXPECT_FALSE(motion_of(view, tissue::displacement_of({})).has_value());
  }
}

TEST(UltrasoundMotion, WhatMovesAsOneIsSeenAsByAProbeThatMovesTheOtherWay) {
  const Scene s = layers();
  for (const glm::dvec3& u : {glm::dvec3(1.37, -2.11, 3.73), glm::dvec3(0.0, 0.0, -9.13),
                              glm::dvec3(-4.11, 3.07, 0.03)})  // off the faces of voxels
    for (UltrasoundView view : views()) {
      const auto by_tissue = all_db(moved(s, view, all_by(u)));
      const auto at_first = all_db(polar_of(s, view));
      view.origin_lps_mm -= u;
      const double alike = correlation(by_tissue, all_db(polar_of(s, view)));
      EXPECT_GT(alike, 0.9995) << u.x << " " << view.probe.name << " " << static_cast<int>(view.method);
      EXPECT_LT(correlation(by_tissue, at_first), 0.9) << "it did move";
    }
}

// A short vessel that is squeezed moves nothing beyond its ends: there scatterers are laid by the bits of tissue
// that lies still.
TEST(UltrasoundMotion, WhereNothingMovesScatterersLieAsInAStillPicture) {
  const Scene s = layers();
  const TissueAt tissue_at(s.tissue(), {});
  const tissue::SqueezedVein vein{
      .from_lps_mm = {-14.0, 22.0, 0.0}, .to_lps_mm = {-6.0, 22.0, 0.0}, .radius_mm = 3.0, .area_share = 0.6};
  const tissue::Displacement squeezed = tissue::displacement_of({.veins = {&vein, 1}});
  for (UltrasoundView view : {curved_view(100.0), straight_view(45.0)}) {
    view.beams = 64;
    view.samples = 700;
    const auto motion = motion_of(view, squeezed);
    ASSERT_TRUE(motion.has_value());
    const ScattererField lying(view, tissue_at), moving(view, tissue_at, &*motion);
    std::vector<std::int32_t> of_lying, of_moving;
    int alike = 0, other = 0;
    for (int b = 0; b < view.beams; b += 4) {
      lying.add_beams(b, b + 4, of_lying);
      moving.add_beams(b, b + 4, of_moving);
      const double left_mm = std::min(point_of(view, b, 0.0).x, point_of(view, b + 3, 0.0).x);
      if (left_mm > 4.0) {
        EXPECT_EQ(of_lying, of_moving) << view.probe.name << ' ' << b;
      }
      ++(of_lying == of_moving ? alike : other);
    }
    EXPECT_GT(alike, 4) << view.probe.name;
    EXPECT_GT(other, 2) << view.probe.name;
  }
}

TEST(UltrasoundMotion, ATurnedProbeSeesItToo) {
  const Scene s = layers();
  const glm::dvec3 u(2.0, -1.0, 5.0);
  for (UltrasoundView view : views()) {
    view.axial = glm::normalize(glm::dvec3(0.2, 1.0, -0.15));
    view.lateral = glm::normalize(glm::cross(view.axial, glm::dvec3(-0.7, 0.1, 0.9)));
    const auto by_tissue = all_db(moved(s, view, all_by(u)));
    view.origin_lps_mm -= u;
    EXPECT_GT(correlation(by_tissue, all_db(polar_of(s, view))), 0.9995)
        << view.probe.name << " " << static_cast<int>(view.method);
  }
}

TEST(UltrasoundMotion, TilesLeaveNoSeamsAndLoseNoScatterers) {
  // The same beams alone and in blocks: each tiling cuts the tissue at rest elsewhere.
  const Scene s = all_of(TissueClass::liver);
  const TissueAt tissue_at(s.tissue(), {});
  const tissue::SkinPress press{.at_lps_mm = {5, 0, 1}, .inward = {0, 1, 0}, .radius_mm = 20.0, .depth_mm = 9.0};
  const tissue::Breath breath{{.half_width_mm = 80.0, .back_y_mm = 120.0, .depth_mm = 150.0, .dome_z_mm = 10.0},
                              {2.0, 6.0, 15.0}};
  const auto displacement =
      tissue::displacement_of({.presses = {&press, 1}, .needle = needle(3.0), .breath = breath});
  for (UltrasoundView view : {curved_view(110.0), straight_view(45.0)}) {
    view.beams = 64;
    view.samples = 500;
    view.origin_lps_mm = {0.0, 9.0, 0.0};
    const auto motion = motion_of(view, displacement);
    const ScattererField field(view, tissue_at, &*motion);
    const std::size_t of_beam = static_cast<std::size_t>(view.samples) * static_cast<std::size_t>(field.fine()) * 2;
    std::vector<std::int32_t> block, one;
    field.add_beams(16, 48, block);
    double squares = 0.0, miss = 0.0;
    // A scatterer may fall into the next fine sample; over a pulse that says nothing.
    const std::size_t pulse = 2 * static_cast<std::size_t>(field.fine()) * 8;
    for (int b = 16; b < 48; ++b) {
      field.add_beams(b, b + 1, one);
      for (std::size_t k = 0; k + pulse <= of_beam; k += pulse)
        for (std::size_t part = 0; part < 2; ++part) {
          double in_block = 0.0, alone = 0.0;
          for (std::size_t n = part; n < pulse; n += 2) {
            in_block += block[static_cast<std::size_t>(b - 16) * of_beam + k + n];
            alone += one[k + n];
          }
          squares += alone * alone;
          miss += (in_block - alone) * (in_block - alone);
        }
    }
    EXPECT_GT(squares, 0.0);
    EXPECT_LT(miss, 1e-4 * squares) << view.probe.name;
  }
}

TEST(UltrasoundMotion, SpeckleIsAsBrightAsEverWhereTissueMoves) {
  const Scene s = all_of(TissueClass::liver);
  for (UltrasoundView view : {curved_view(110.0), straight_view(45.0)}) {
    view.attenuation_db_cm_mhz = 0.0;
    const PolarPicture still = polar_of(s, view), moving = moved(s, view, pressed(8.0));
    // Pressed tissue is told at rest from the face on: the face stands on the skin that it moved.
    for (const double depth_mm : {0.3, 0.5, 0.8}) {
      const int k = sample_at(view, depth_mm * view.depth_mm);
      EXPECT_NEAR(level_db(moving, 20, 108, k - 60, k + 60), level_db(still, 20, 108, k - 60, k + 60), 1.0);
    }
  }
}

TEST(UltrasoundMotion, UnderAPressedProbeAnInterfaceIsNearerByWhatTheTissueGaveWay) {
  const Scene s = scene([](const glm::dvec3& p) { return p.y < 30.0 ? TissueClass::fluid : TissueClass::bone; },
                        {100, 120, 40}, 1.0);
  for (UltrasoundView view : {straight_view(60.0), curved_view(60.0)})
    for (const double press_mm : {3.0, 8.0}) {
      const tissue::Displacement displacement = pressed(press_mm);
      view.origin_lps_mm = {0.0, press_mm, 0.0};
      const PolarPicture picture = moved(s, view, displacement);
      const double expected_mm = tissue::displaced(displacement, {0.0, 30.0, 0.0}).y - press_mm;
      const auto peak = measure::peak_of(picture, view, view.beams / 2);
      EXPECT_NEAR(peak.depth_mm, expected_mm, 0.3) << view.probe.name << ' ' << press_mm;
      EXPECT_GT(30.0 - expected_mm, 0.6 * press_mm) << "nearer than at rest";
    }
}

TEST(UltrasoundMotion, ALesionIsWhereTheBreathPutsIt) {
  const Scene s = all_of(TissueClass::liver);
  UltrasoundView view = curved_view(100.0);
  view.samples = 1000;
  Inserted inserted;
  inserted.lesions.push_back({{3.0, 50.0, 1.0}, 6.0, 0.0});  // a cyst
  const glm::dvec3 u(0.0, 7.0, 4.0);
  EXPECT_NEAR(target_level(s.tissue(), view, inserted, {}, all_by(u)).off_plane_mm, -5.0, 1e-6);
  EXPECT_TRUE(ultrasound_visible(s.tissue(), view, inserted, {}).visible.target);
  EXPECT_TRUE(ultrasound_visible(s.tissue(), view, inserted, {}, all_by({0.0, 7.0, 0.0})).visible.target);
  EXPECT_FALSE(ultrasound_visible(s.tissue(), view, inserted, {}, all_by({0.0, 7.0, 30.0})).visible.target);
  // In the picture: darker where it is now, as bright as liver where it was.
  const PolarPicture still = polar_of(s, view), moving = moved(s, view, all_by({0.0, 14.0, 0.0}), inserted);
  const auto beam =
      static_cast<int>(std::lround(beam_and_depth(view, 3.0 * glm::dot(view.lateral, {1, 0, 0}), 64.0).beam));
  const auto fall_db = [&](double depth_mm) {
    const int k = sample_at(view, depth_mm);
    return level_db(still, beam - 2, beam + 3, k - 25, k + 25) -
           level_db(moving, beam - 2, beam + 3, k - 25, k + 25);
  };
  EXPECT_GT(fall_db(64.0), 15.0);
  EXPECT_LT(std::abs(fall_db(50.0)), 4.0);
}

TEST(UltrasoundMotion, NeedleAndProbeStayWhereTheyAre) {
  const Scene s = all_of(TissueClass::fluid);  // little else to be seen
  for (const UltrasoundView& view : {curved_view(80.0), straight_view(50.0)}) {
    Inserted inserted;
    inserted.needle = NeedlePose{.tip_lps_mm = {0, 30, 0}, .direction = {1, 0, 0}};
    const PolarPicture still = polar_of(s, view, inserted),
                       moving = moved(s, view, all_by({5.0, 6.0, 7.0}), inserted);
    int loud = 0;
    for (std::size_t i = 0; i < still.envelope.size(); ++i) {
      if (!(still.envelope[i] > 1.0F)) continue;
      ++loud;
      EXPECT_NEAR(moving.envelope[i], still.envelope[i], 0.02F * still.envelope[i]);
    }
    EXPECT_GT(loud, 100);
  }
}

TEST(UltrasoundMotion, AJiggledNeedleShowsAroundItAndLessFartherAway) {
  const Scene s = all_of(TissueClass::liver);
  for (const UltrasoundView& view : {curved_view(80.0), straight_view(50.0)}) {
    const PolarPicture one = moved(s, view, dragged(0.03)), other = moved(s, view, dragged(-0.03));
    const tissue::NeedleDrag drag = needle(0.0);
    struct Ring {
      double from_mm, to_mm, sum_db = 0.0;
      int n = 0;
      double mean_db() const { return sum_db / n; }
    } rings[] = {{0.0, 2.0}, {6.0, 9.0}, {16.0, 30.0}};
    for (int b = 0; b < view.beams; ++b)
      for (int k = 100; k < view.samples; k += 3) {
        const glm::dvec3 p = point_of(view, b, (k + 0.5) * view.depth_mm / view.samples);
        const double along_mm = glm::dot(p - drag.entry_lps_mm, drag.direction);
        if (along_mm < 15.0 || along_mm > 35.0) continue;
        const double apart_mm = glm::length(p - drag.entry_lps_mm - along_mm * drag.direction);
        for (Ring& ring : rings)
          if (apart_mm >= ring.from_mm && apart_mm < ring.to_mm) {
            ring.sum_db += std::abs(decibels(static_cast<double>(at(one, b, k))) -
                                    decibels(static_cast<double>(at(other, b, k))));
            ++ring.n;
          }
      }
    // As slowly as the logarithm that a line's drag is, and a slice of some mm hides the steepest of it.
    EXPECT_GT(rings[0].mean_db(), 0.5) << view.probe.name;
    EXPECT_GT(rings[0].mean_db(), 1.15 * rings[1].mean_db()) << view.probe.name;
    EXPECT_GT(rings[1].mean_db(), 1.3 * rings[2].mean_db()) << view.probe.name;
  }
}

// What is told asks for a few beams of a fan: node by node it has the bits of all of it.
TEST(UltrasoundMotion, AFanThatIsAskedHasTheBitsOfAWholeOne) {
  const auto displacement = pressed(8.0);
  for (const UltrasoundView& view : {curved_view(110.0), straight_view(45.0)}) {
    int asked = 0, all = 0;
    const RestFan whole(view, 5.0, 0.0, [&](const glm::dvec3& at_lps_mm, const glm::dvec3&) {
      ++all;
      return tissue::rest_of(displacement, at_lps_mm, {.fixed_point = 4, .newton = 0});
    });
    const auto that_counts = [&](int& count) {
      return RestFan::when_asked(view, 5.0, 0.0,
                                 [&](std::span<const glm::dvec3> at_lps_mm, std::span<glm::dvec3> rest_lps_mm) {
                                   count += static_cast<int>(at_lps_mm.size());
                                   tissue::rest_of(displacement, at_lps_mm, 4, rest_lps_mm);
                                 });
    };
    const RestFan fan = that_counts(asked);
    EXPECT_EQ(asked, 0);
    for (const double beam : {-0.4, 31.0, 33.7, view.beams - 0.6})
      for (const double depth_mm : {0.0, 2.9, 0.31 * view.depth_mm, view.depth_mm}) {
        EXPECT_EQ(fan.rest_of(beam, depth_mm), whole.rest_of(beam, depth_mm));
        const BeamPath down = fan.path_down_to(fan_of(view).way(beam), beam, depth_mm), path = whole.path(beam);
        for (double z_mm = 0.0; z_mm <= depth_mm; z_mm += 0.37) EXPECT_EQ(down.at(z_mm), path.at(z_mm));
        EXPECT_EQ(down.at(depth_mm), path.at(depth_mm));
      }
    EXPECT_GT(asked, 0);
    EXPECT_LT(asked, all);
    int before = asked;
    static_cast<void>(fan.path(31.0));
    EXPECT_EQ(asked, before) << "nothing is found twice";
    const RestFan::Box boxes[] = {{50.0, 60.0, 20.0, 25.0}, {55.0, 70.0, 22.0, 30.0}};  // that overlap
    fan.ask(boxes);
    EXPECT_GT(asked, before);
    before = asked;
    for (const double beam : {50.0, 57.3, 60.0})
      for (const double depth_mm : {20.0, 23.4, 25.0})
        EXPECT_EQ(fan.rest_of(beam, depth_mm), whole.rest_of(beam, depth_mm));
    EXPECT_EQ(asked, before) << "all that is between was asked for";
    for (const double beam : {55.0, 63.0, 70.0})
      EXPECT_EQ(fan.rest_of(beam, 29.0), whole.rest_of(beam, 29.0)) << "of the other box, too";
    fan.ask(boxes);
    EXPECT_EQ(asked, before) << "and nothing is asked for twice";
    // Nor in one question: the boxes overlap.
    int one_by_one = 0, at_once = 0;
    const RestFan first = that_counts(one_by_one), second = that_counts(at_once);
    for (const RestFan::Box& box : boxes) first.ask({&box, 1});
    second.ask(boxes);
    EXPECT_EQ(at_once, one_by_one);
  }
}

// A layer reaches as far to both sides where it was pressed, too.
TEST(UltrasoundMotion, ALayerThatIsMovedCastsNoShadow) {
  const Scene s = scene([](const glm::dvec3& p) {
    if (p.y < 15.0 + p.x) return TissueClass::muscle;
    return p.y < 30.0 + p.x ? TissueClass::fluid : TissueClass::liver;
  });
  const UltrasoundView view = straight_view(60.0);
  const Inserted none;
  const TissueAt tissue_at(s.tissue(), none);
  const std::optional<PictureMotion> motion = motion_of(view, pressed(5.0));
  ASSERT_TRUE(motion);
  const LineWalker walker(view, tissue_at, s.volume, none, &*motion);
  Line line;
  for (int b = 0; b < view.beams; ++b) {
    walker.walk(b, true, line);
    for (const LineEcho& echo : line.echoes) EXPECT_EQ(echo.parting_per_mm, 0.0) << b;
  }
}

TEST(UltrasoundMotion, ThreadsDoNotMatter) {
  const Scene s = layers();
  for (UltrasoundView view : views()) {
    view.threads = 1;
    const PolarPicture one = moved(s, view, pressed(6.0));
    view.threads = 5;
    EXPECT_EQ(one.envelope, moved(s, view, pressed(6.0)).envelope);
  }
}

}  // namespace
}  // namespace seldinger::imaging
