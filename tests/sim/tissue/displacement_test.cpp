// Needle, veins and everything together: what touch says is what tissue does, nothing folds, nothing is made that
// has no cause.
#include "sim/tissue/displacement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>
#include <vector>

#include "shaders/shared/displacement.glsl.h"
#include "sim/base/rng.h"
#include "sim/haptics/needle/needle_law.h"
#include "sim/tissue/cavity_wall.h"
#include "tests/fixtures/allocations.h"
#include "tests/sim/tissue/moved_by.h"

namespace seldinger::tissue {
namespace {

glm::dvec3 random_direction(base::Rng& rng) {
  return glm::normalize(glm::dvec3(rng.normal(), rng.normal(), rng.normal()));
}

NeedleDrag along_z(double cut_mm, double tip_n, double tip_mm, double shaft_mm) {
  return {.entry_lps_mm = glm::dvec3(0.0),
          .direction = {0.0, 0.0, 1.0},
          .radius_mm = 0.36,
          .cut_mm = cut_mm,
          .tip_n = tip_n,
          .tip_mm = tip_mm,
          .shaft_mm = shaft_mm};
}

TEST(SharedFunctions, AreTheLibrarysToTheDigitsStated) {
  for (int i = -500; i <= 500; ++i) {
    const double q = std::exp(0.025 * i);
    EXPECT_NEAR(shaders::atan_and_rest(q).x, std::atan(q), 1e-9 * std::atan(q)) << q;
    const double rest = q - std::atan(q);  // which loses digits itself below 1e-2
    const double expected = q > 1e-2 ? rest : q * q * q * (1.0 / 3.0 - q * q / 5.0);
    EXPECT_NEAR(shaders::atan_and_rest(q).y, expected, 1e-8 * expected) << q;
    if (q >= 1.0 && q <= 1e6) {
      EXPECT_NEAR(shaders::log_by_roots(q), std::log(q), 4e-6) << q;
    }
  }
}

// The ball: at its surface it goes as it is pushed, and far away it is Kelvin's point force of 6 π G b U.
TEST(Tip, IsABallNearAndAPointForceFar) {
  constexpr double kBallMm = 2.0, kMm = 1.0, kShear = 0.0045;
  const double force_n = 6.0 * std::numbers::pi * kShear * kBallMm * kMm;
  const Displacement displacement = displacement_of({.needle = along_z(50.0, force_n, kMm, 0.0)});
  ASSERT_EQ(count_sources(displacement), 1);
  base::Rng rng(1);
  for (int i = 0; i < 200; ++i) {
    const glm::dvec3 away = random_direction(rng), tip_mm(0.0, 0.0, 50.0);
    EXPECT_LT(glm::length(u_of(displacement, tip_mm + 0.999 * kBallMm * away) - glm::dvec3(0, 0, kMm)), 1e-6);
    const double far_mm = 400.0 * kBallMm;
    const glm::dvec3 kelvin_mm =
        force_n / (8.0 * std::numbers::pi * kShear * far_mm) * (glm::dvec3(0.0, 0.0, 1.0) + away.z * away);
    EXPECT_LT(glm::length(u_of(displacement, tip_mm + far_mm * away) - kelvin_mm),
              1e-4 * glm::length(kelvin_mm) + 1e-9);
  }
}

// The line's closed form against a sum of Kelvin's points.
TEST(Shaft, IsTheSumOfItsPoints) {
  constexpr double kLengthMm = 60.0, kRadiusMm = 0.36;
  for (const double along_mm : {-20.0, -0.5, 0.0, 0.7, 30.0, 59.0, 60.0, 61.0, 90.0})
    for (const double across_mm : {0.4, 1.0, 7.0, 40.0}) {
      double along = 0.0, across = 0.0;
      constexpr int kPoints = 200000;
      for (int i = 0; i < kPoints; ++i) {
        const double t = along_mm - kLengthMm * (i + 0.5) / kPoints;
        const double distance = std::hypot(t, across_mm);
        along += (1.0 / distance + t * t / (distance * distance * distance)) * kLengthMm / kPoints;
        across += t / (distance * distance * distance) * kLengthMm / kPoints;
      }
      const auto line = shaders::displacement_along_line(along_mm, across_mm, kRadiusMm, kLengthMm);
      EXPECT_NEAR(line.x, along, 2e-5) << along_mm << ' ' << across_mm;
      EXPECT_NEAR(line.y, across, 2e-5) << along_mm << ' ' << across_mm;
      // Nearer than its radius it is what it is there.
      EXPECT_EQ(shaders::displacement_along_line(along_mm, 0.1, kRadiusMm, kLengthMm).x,
                shaders::displacement_along_line(along_mm, kRadiusMm, kRadiusMm, kLengthMm).x);
    }
}

// Tissue at the tip goes as far as touch says, and half way along the shaft, too, where the tip does not push.
TEST(Needle, GoesAsFarAsTouchSays) {
  base::Rng rng(2);
  for (int i = 0; i < 300; ++i) {
    const double cut_mm = 8.0 + 110.0 * rng.uniform(), tip_mm = 0.05 + 10.0 * rng.uniform();
    const double shaft_mm = rng.uniform() < 0.2 ? 0.0 : std::min(0.5 * cut_mm, 12.0 * rng.uniform()) - 4.0;
    const Displacement both = displacement_of({.needle = along_z(cut_mm, 3.0 * rng.uniform(), tip_mm, shaft_mm)});
    EXPECT_NEAR(displaced(both, {0.0, 0.0, cut_mm}).z, cut_mm + tip_mm, 1e-4) << "tissue at the tip is at the tip";
    const Displacement shaft = displacement_of({.needle = along_z(cut_mm, 0.0, 0.0, shaft_mm)});
    EXPECT_NEAR(u_of(shaft, {0.0, 0.0, 0.5 * cut_mm}).z, shaft_mm, 1e-4);
  }
}

// A kidney under a needle goes along and turns as a whole, as far as its form says and no farther than is sound;
// where the wall is nothing moves; tissue at the tip stays at the tip.
TEST(Organ, GoesAlongAndTurnsAsAWhole) {
  constexpr double kRadiusMm = 33.0;
  base::Rng rng(8);
  for (int i = 0; i < 200; ++i) {
    const glm::dvec3 middle_mm(0.0, 0.0, 90.0), at_mm(25.0 * rng.uniform(), 0.0, 60.0);
    const double force_n = 0.1 + (i % 20 == 0 ? 60.0 : 2.9) * rng.uniform(), tip_mm = 8.0 + 6.0 * rng.uniform();
    NeedleDrag drag = along_z(60.0, force_n, tip_mm, i % 2 == 0 ? 2.0 : 0.0);
    drag.entry_lps_mm = at_mm - 60.0 * drag.direction;
    const PushedOrgan organ{middle_mm, kRadiusMm, at_mm, force_n * drag.direction};
    const Displacement alone = displacement_of({.organ = organ}),
                       both = displacement_of({.needle = drag, .organ = organ});
    ASSERT_EQ(count_sources(alone), 1);
    EXPECT_NEAR(glm::length(displaced(both, at_mm) - at_mm - tip_mm * drag.direction), 0.0, 1e-4);
    const glm::dvec3 middle_u = u_of(alone, middle_mm);
    if (force_n < 3.0) {
      EXPECT_NEAR(middle_u.z, force_n / (6.0 * std::numbers::pi * 0.001 * kRadiusMm), 1e-5);
      EXPECT_LT(middle_u.z, 5.0) << "a few millimetres";
    }
    for (int j = 0; j < 20; ++j) {
      const glm::dvec3 way = random_direction(rng);
      const glm::dvec3 a = middle_mm + kRadiusMm * rng.uniform() * way,
                       b = middle_mm + kRadiusMm * rng.uniform() * random_direction(rng);
      EXPECT_NEAR(glm::dot(u_of(alone, a) - u_of(alone, b), a - b), 0.0, 1e-3) << "nothing in it is stretched";
      EXPECT_EQ(u_of(alone, middle_mm + 2.001 * kRadiusMm * way), glm::dvec3(0.0)) << "the wall stays";
      EXPECT_GT(volume_ratio(alone, middle_mm + (1.0 + rng.uniform()) * kRadiusMm * way), 0.2);
      const glm::dvec3 about = middle_mm + 2.0 * kRadiusMm * rng.uniform() * way;
      EXPECT_NEAR(glm::length(rest_of(alone, displaced(alone, about)) - about), 0.0, 0.01);
    }
  }
  // Pressed in the middle it only goes along; beside it, the pressed side goes farther.
  const auto turned = [](double x_mm) {
    return displacement_of({.organ = PushedOrgan{{0, 0, 90}, kRadiusMm, {x_mm, 0, 60}, {0, 0, 2.6}}});
  };
  EXPECT_EQ(u_of(turned(0.0), {20, 0, 90}), u_of(turned(0.0), {-20, 0, 90}));
  EXPECT_GT(u_of(turned(20.0), {20, 0, 90}).z, u_of(turned(20.0), {-20, 0, 90}).z + 1.0);
}

// From no shaft to a long one without a jump.
TEST(Needle, BeginsToDragWithoutAJump) {
  double last_mm = 0.0;
  for (double cut_mm = 0.0; cut_mm < 20.0; cut_mm += 0.01) {
    const Displacement shaft = displacement_of({.needle = along_z(cut_mm, 0.0, 0.0, 3.0)});
    const double here_mm = u_of(shaft, {0.0, 0.0, 0.5 * cut_mm}).z;
    EXPECT_NEAR(here_mm, last_mm, 0.02) << cut_mm;
    last_mm = here_mm;
  }
  EXPECT_NEAR(last_mm, 3.0, 1e-4);
}

TEST(Needle, FoldsNothing) {
  base::Rng rng(3);
  double least = 1.0;
  for (int i = 0; i < 150; ++i) {
    const NeedleDrag drag =
        along_z(5.0 + 110.0 * rng.uniform(), 3.0 * rng.uniform(), 12.0 * rng.uniform(), 12.0 * rng.uniform() - 4.0);
    const Displacement displacement = displacement_of({.needle = drag});
    for (int j = 0; j < 3000; ++j) {
      const double near_mm = j % 2 == 0 ? 3.0 : 15.0;
      glm::dvec3 at_mm(near_mm * (2.0 * rng.uniform() - 1.0), near_mm * (2.0 * rng.uniform() - 1.0),
                       drag.cut_mm + near_mm * (2.0 * rng.uniform() - 1.0));
      if (j % 5 == 0) at_mm.z = drag.cut_mm * rng.uniform();
      least = std::min(least, volume_ratio(displacement, at_mm));
    }
  }
  EXPECT_GT(least, 0.0);
  RecordProperty("least_volume", std::to_string(least));
}

// The needle law drives it: while the needle pushes on a capsule, tissue at its tip goes along (sticks); at the
// puncture it goes back at once, and the shaft then drags what slid back.
TEST(Needle, TissueSticksAndSnapsBackAtThePuncture) {
  const haptics::NeedleTissue kidney = haptics::needle_tissue(volume::TissueClass::kidney);
  const std::array<haptics::NeedleLayer, 1> path{{{0.0, kidney}}};
  const haptics::NeedleLaw law({});
  haptics::NeedleTrack track;
  double before_mm = 0.0, after_mm = 0.0, pushed_mm = 0.0;
  const glm::dvec3 ahead_mm(3.0, 0.0, 4.0);  // beside the way, where a picture would see it
  for (int tick = 0; tick < 3000; ++tick) {
    const double depth_mm = 0.008 * tick;
    const haptics::NeedleForce force = law.advance(path, depth_mm, track);
    const double tip_mm = std::max(0.0, depth_mm - track.cut_mm);
    const double length_mm = haptics::inserted_mm(path, depth_mm, track);
    const double shaft_mm = length_mm > 0.0 ? force.shaft_n / (haptics::kShaftStiffnessNMm2 * length_mm) : 0.0;
    const Displacement displacement =
        displacement_of({.needle = along_z(track.cut_mm, force.tip_n, tip_mm, shaft_mm)});
    after_mm = u_of(displacement, ahead_mm).z;
    if (force.ruptured) {
      pushed_mm = before_mm;
      break;
    }
    EXPECT_GE(after_mm, before_mm - 1e-6) << "until the puncture it is only pushed";
    before_mm = after_mm;
  }
  EXPECT_GT(pushed_mm, 2.0);
  EXPECT_LT(after_mm, pushed_mm - 1.0) << "it came back";
}

TEST(Vein, LosesTheAreaItIsToldAndNothingElse) {
  const SqueezedVein vein{{0, 0, 0}, {0, 0, 120}, 6.0, 0.25};
  const Displacement displacement = displacement_of({.veins = {&vein, 1}});
  ASSERT_EQ(count_sources(displacement), 1);
  for (const double angle : {0.0, 1.0, 2.5}) {
    const glm::dvec3 wall_mm(6.0 * std::cos(angle), 6.0 * std::sin(angle), 60.0);
    const glm::dvec3 now_mm = displaced(displacement, wall_mm);
    EXPECT_NEAR(glm::length(glm::dvec2(now_mm)), 3.0, 1e-5) << "half as wide: a quarter of the area";
    EXPECT_NEAR(now_mm.z, 60.0, 1e-9);
  }
  // Rings around it keep their area; the blood that is gone went along the vein.
  for (const double radius_mm : {6.5, 8.0, 15.0, 40.0})
    EXPECT_NEAR(volume_ratio(displacement, {radius_mm, 0.0, 60.0}), 1.0, 0.01) << radius_mm;
  EXPECT_NEAR(volume_ratio(displacement, {2.0, 1.0, 60.0}), 0.25, 1e-3);
  // Its ends are where they were.
  EXPECT_EQ(u_of(displacement, {6.0, 0.0, 0.0}), glm::dvec3(0.0));
  base::Rng rng(4);
  for (int i = 0; i < 3000; ++i) {
    const glm::dvec3 rest_mm(40.0 * rng.uniform() - 20.0, 40.0 * rng.uniform() - 20.0, 130.0 * rng.uniform() - 5.0);
    EXPECT_GT(volume_ratio(displacement, rest_mm), 0.05);
    EXPECT_LT(glm::length(rest_of(displacement, displaced(displacement, rest_mm)) - rest_mm), 0.1);
  }
}

TEST(Vein, GivesWayOnceThePressureOutsideIsHigher) {
  EXPECT_EQ(vein_area_share(0.0, 0.001), 1.0);
  EXPECT_EQ(vein_area_share(0.001, 0.001), 1.0);
  double last = 1.0;
  for (double outside = 0.001; outside < 0.0013; outside += 2e-8) {
    const double share = vein_area_share(outside, 0.001);
    EXPECT_LE(share, last);
    EXPECT_LT(last - share, 0.05) << "and no step";
    EXPECT_GE(share, 0.03) << "its wall has a thickness";
    last = share;
  }
  // 10 mmHg of blood (1.33 kPa) under a probe pressed 8 mm in, 15 mm deep: nearly closed; untouched: open.
  const SkinPress press{.at_lps_mm = glm::dvec3(0.0), .inward = {0, 0, 1}, .radius_mm = 20.0, .depth_mm = 8.0};
  const double added = pressure_n_mm2(press, {0.0, 0.0, 8.0}, 0.0033);
  EXPECT_LT(vein_area_share(added, 0.00133), 0.5) << added;
}

// No cause, no source: and then every place is where it was, to the bit.
TEST(Causes, ThatMoveNothingMakeNoSource) {
  const SkinPress lifted{.depth_mm = -2.0};
  const SqueezedVein open{{0, 0, 0}, {0, 0, 50}, 5.0, 1.0};
  const Causes causes{.presses = {&lifted, 1},
                      .needle = along_z(30.0, 0.0, 0.0, 0.0),
                      .veins = {&open, 1},
                      .breath = Breath{{}, glm::dvec3(0.0)}};
  for (const Displacement& still : {displacement_of({}), displacement_of(causes)}) {
    EXPECT_EQ(count_sources(still), 0);
    base::Rng rng(5);
    for (int i = 0; i < 100; ++i) {
      const glm::dvec3 at_mm = 1000.0 * random_direction(rng);
      EXPECT_EQ(displaced(still, at_mm), at_mm);
      EXPECT_EQ(rest_of(still, at_mm), at_mm);
    }
  }
}

Causes everything(std::array<SkinPress, 2>& presses, std::array<SqueezedVein, 11>& veins) {
  presses[0] = {.at_lps_mm = {0, -110, -60},
                .inward = {0, 1, 0},
                .radius_mm = 20.0,
                .depth_mm = 8.0,
                .per_bone_mm = 1.0 / 35.0};
  presses[1] = {.at_lps_mm = {70, -90, -90}, .inward = {-0.6, 0.8, 0}, .radius_mm = 9.0, .depth_mm = 3.0};
  for (std::size_t i = 0; i < veins.size(); ++i) {
    const double x = -60.0 + 12.0 * static_cast<double>(i);
    veins[i] = {{x, 20, -40}, {x, 25, -160}, 3.0, 0.5};
  }
  NeedleDrag drag = along_z(60.0, 1.2, 4.0, 3.0);
  drag.entry_lps_mm = {40, -105, -60};
  drag.direction = glm::normalize(glm::dvec3(-0.3, 1.0, 0.1));
  return {presses, drag, veins, Breath{{}, {2.0, 15.0, 16.0}}};
}

TEST(Causes, AreAtMostSixteenAndAddUp) {
  std::array<SkinPress, 2> presses;
  std::array<SqueezedVein, 11> veins;
  const Causes causes = everything(presses, veins);
  const long before = fixtures::allocations_of_this_thread();
  const Displacement all = displacement_of(causes);
  EXPECT_EQ(count_sources(all), 16);
  const Displacement parts[] = {displacement_of({.presses = presses}), displacement_of({.needle = causes.needle}),
                                displacement_of({.veins = veins}), displacement_of({.breath = causes.breath})};
  base::Rng rng(6);
  double most = 0.0;
  for (int i = 0; i < 1000; ++i) {
    const glm::dvec3 rest_mm(200.0 * rng.uniform() - 100.0, 200.0 * rng.uniform() - 100.0, -200.0 * rng.uniform());
    glm::dvec3 sum(0.0);
    for (const Displacement& part : parts) sum += displaced(part, rest_mm) - rest_mm;
    most = std::max(most, glm::length(displaced(all, rest_mm) - rest_mm - sum));
  }
  EXPECT_LT(most, 1e-9);
  EXPECT_EQ(fixtures::allocations_of_this_thread(), before) << "nothing is allocated";
}

TEST(Causes, TogetherComeBackFromWhereTheyWent) {
  std::array<SkinPress, 2> presses;
  std::array<SqueezedVein, 11> veins;
  const Displacement all = displacement_of(everything(presses, veins));
  base::Rng rng(7);
  double squares = 0.0;
  constexpr int kPlaces = 20000;
  for (int i = 0; i < kPlaces; ++i) {
    const glm::dvec3 rest_mm(200.0 * rng.uniform() - 100.0, 200.0 * rng.uniform() - 110.0, -200.0 * rng.uniform());
    const double miss_mm = glm::length(rest_of(all, displaced(all, rest_mm)) - rest_mm);
    squares += miss_mm * miss_mm;
  }
  EXPECT_LT(std::sqrt(squares / kPlaces), 0.15);
}

// Many places side by side, so many beyond the last whole group as there can be, with every kind of source and with
// organs that slide.
TEST(Causes, ManyPlacesGoAndComeBackByTheBitsOfEach) {
  std::array<SkinPress, 2> presses;
  std::array<SqueezedVein, 11> veins;
  const Causes causes = everything(presses, veins);
  CavityWall wall;
  wall.axis_lps_mm = {0.0, 0.0, -230.0};
  wall.step_mm = 12.0;
  for (std::size_t i = 0; i < wall.radius_mm.size(); ++i) wall.radius_mm[i] = 95.0F + static_cast<float>(i % 7);
  const Breath slides{{}, {2.0, 15.0, 16.0}, &wall};
  const std::optional<PushedOrgan> organ = PushedOrgan{{-60, 0, -60}, 50.0, {-60, -40, -60}, {0.0, 3.0, 1.0}};
  const Displacement of[] = {displacement_of(causes), displacement_of({.needle = causes.needle, .organ = organ}),
                             displacement_of({.presses = presses, .breath = slides}), Displacement{}};
  base::Rng rng(8);
  for (const Displacement& displacement : of)
    for (const std::size_t count : {0U, 1U, 2U, 4U, 5U, 7U, 8U, 9U, 11U, 1003U}) {
      std::vector<glm::dvec3> at(count), rest(count);
      for (glm::dvec3& p : at)
        p = {200.0 * rng.uniform() - 100.0, 200.0 * rng.uniform() - 110.0, -200.0 * rng.uniform()};
      rest_of(displacement, at, 4, rest);
      for (std::size_t i = 0; i < count; ++i)
        ASSERT_EQ(rest[i], rest_of(displacement, at[i], {.fixed_point = 4, .newton = 0})) << i << " of " << count;
      displaced(displacement, at, rest);
      for (std::size_t i = 0; i < count; ++i)
        ASSERT_EQ(rest[i], displaced(displacement, at[i])) << i << " of " << count;
    }
}

// One value that is copied to shaders as it stands: no padding that differs from copy to copy.
TEST(Causes, MakeTheSameBytesEachTime) {
  std::array<SkinPress, 2> presses;
  std::array<SqueezedVein, 11> veins;
  const Causes causes = everything(presses, veins);
  const Displacement one = displacement_of(causes), other = displacement_of(causes);
  EXPECT_EQ(std::memcmp(&one, &other, sizeof one), 0);
  EXPECT_EQ(sizeof(Displacement), 32U + 16U * 64U + 768U * 4U);
}

}  // namespace
}  // namespace seldinger::tissue
