// Colour Doppler against its closed form: the angle's law, where speeds wrap, which way is which colour.
#include "sim/imaging/ultrasound/colour_screen.h"

#include <glm/vec3.hpp>
#include <numbers>

#include "sim/imaging/ultrasound/view/view.h"
#include "tests/sim/imaging/ultrasound/ultrasound_scene.h"

namespace seldinger::imaging {
namespace {

// A vessel of 10 mm at a depth of 30 mm, in the picture's plane, that falls by an angle from one side to the other.
constexpr double kDeepMm = 30.0, kRadiusMm = 5.0, kFarMm = 60.0;
glm::dvec3 axis_at(double degrees) {
  const double rad = degrees * std::numbers::pi / 180.0;  // to the beams, which run along y
  return {std::sin(rad), std::cos(rad), 0.0};
}
cases::Structure vessel(const char* name, const glm::dvec3& flow) {
  const glm::dvec3 middle(0.0, kDeepMm, 0.0);
  return {name, TissueClass::vessel, cases::StructureRule::critical,
          cases::Tube{{middle - kFarMm * flow, middle + kFarMm * flow}, kRadiusMm}};
}
Scene around(const cases::Structure& one) {
  return scene(
      [&](const glm::dvec3& p) {
        return cases::signed_distance_mm(one.shape, p, 100.0) < 0.5 ? TissueClass::vessel : TissueClass::liver;
      },
      {60, 100, 20}, 1.0);
}

struct Colour {
  UltrasoundView view;
  ColourPicture picture;
  // Towards the probe, at a place of the picture's plane; 0 where no colour is.
  double speed_mm_s(double x_mm, double y_mm) const {
    const BeamAndDepth at = beam_and_depth(view, x_mm, y_mm);
    const double row_mm = (picture.box.to_mm - picture.box.from_mm) / picture.rows;
    const double leaned = at.beam - picture.box.grey_beam(0.0, at.depth_mm);
    const auto beam = static_cast<std::size_t>(std::lround(leaned) - picture.box.first_beam),
               row = static_cast<std::size_t>((at.depth_mm - picture.box.from_mm) / row_mm);
    const glm::vec2 cell = picture.cells.at(beam * static_cast<std::size_t>(picture.rows) + row);
    return picture.scale_mm_s * std::atan2(cell.y, cell.x) / std::numbers::pi;
  }
  double sure() const {
    double most = 0.0;
    for (const glm::vec2& cell : picture.cells) most = std::max(most, static_cast<double>(glm::length(cell)));
    return most;
  }
};
Colour colour_as(const Scene& s, const cases::Structure& one, const cases::ConsoleSetting& console,
                 double t_s = 0.15, std::span<const float> depths = {}) {
  Colour made{straight_view(), {}};
  made.view.probe.elements = 128;
  const tissue::BloodFlow flow(std::span(&one, 1));
  colour_polar(s.tissue(), made.view, {}, depths, flow, console, t_s, made.picture);
  return made;
}
Colour colour_of(const Scene& s, const cases::Structure& one, double scale_mm_s, double t_s = 0.15,
                 std::span<const float> depths = {}) {
  cases::ConsoleSetting console;
  console.colour_mm_s = scale_mm_s;
  return colour_as(s, one, console, t_s, depths);
}
double middle_mm_s(const char* name, double t_s = 0.15) {
  return tissue::middle_speed_mm_s(*tissue::flow_law_of(TissueClass::vessel, name), t_s);
}

// Flow of a portal vein goes towards x < 0 whatever its slope here, so at less than 90° it comes up, beyond it goes
// down; cos of the angle to the way up.
TEST(ColourDoppler, FollowsTheAnglesCosine) {
  for (const double degrees : {40.0, 60.0, 75.0, 105.0, 130.0}) {
    const glm::dvec3 flow = -axis_at(degrees);
    const cases::Structure one = vessel("portal_vein", flow);
    const Colour colour = colour_of(around(one), one, 400.0);
    EXPECT_NEAR(colour.speed_mm_s(0.0, kDeepMm),
                middle_mm_s("portal_vein") * std::cos(degrees * std::numbers::pi / 180.0),
                0.02 * middle_mm_s("portal_vein"))
        << degrees;
  }
}

TEST(ColourDoppler, ShowsNothingAcrossTheBeam) {
  const cases::Structure one = vessel("portal_vein", {-1.0, 0.0, 0.0});
  const Colour colour = colour_of(around(one), one, 200.0);
  EXPECT_LT(colour.sure(), 0.01);
}

// What lies along the face shows by the sine of the lean, and in the other colour to the other side.
TEST(ColourDoppler, LeansSoThatFlowAlongTheFaceShows) {
  const cases::Structure one = vessel("portal_vein", {-1.0, 0.0, 0.0});
  const Scene s = around(one);
  for (const double lean_deg : {-20.0, -10.0, 10.0, 20.0, 45.0}) {
    cases::ConsoleSetting console;
    console.colour_mm_s = 200.0;
    console.lean_deg = lean_deg;
    const double leans_deg = std::clamp(lean_deg, -kMostLeanDeg, kMostLeanDeg);
    for (const double x_mm : {-4.0, 0.0, 4.0})
      EXPECT_NEAR(colour_as(s, one, console).speed_mm_s(x_mm, kDeepMm),
                  middle_mm_s("portal_vein") * std::sin(leans_deg * std::numbers::pi / 180.0),
                  0.03 * middle_mm_s("portal_vein"))
          << lean_deg << " at " << x_mm;
  }
  cases::ConsoleSetting console;
  console.lean_deg = 20.0;
  EXPECT_EQ(colour_box(curved_view(), console).lean_deg, 0.0) << "the beams of a curved face differ anyway";
}

TEST(ColourDoppler, ItsBoxIsWhereItIsPutAndWithinThePicture) {
  const UltrasoundView view = straight_view();
  const ColourBox whole = colour_box(view, {});
  for (const auto& [across, down] : {std::pair{0.5, 0.5}, {0.01, 0.01}, {1.0, 1.0}, {0.3, 0.7}}) {
    cases::ConsoleSetting console;
    console.box_across = across;
    console.box_down = down;
    const ColourBox box = colour_box(view, console);
    EXPECT_GE(box.first_beam, 0);
    EXPECT_LE(box.end_beam, view.beams);
    EXPECT_GE(box.from_mm, 0.0);
    EXPECT_LE(box.to_mm, view.depth_mm + 1e-9);
    EXPECT_LT(box.end_beam - box.first_beam, whole.end_beam - whole.first_beam);
    if (across != 0.3) continue;
    EXPECT_NEAR(0.5 * (box.first_beam + box.end_beam), 0.3 * view.beams, 1.0);
    EXPECT_NEAR(0.5 * (box.from_mm + box.to_mm), 0.7 * view.depth_mm, 1e-9);
  }
}

TEST(ColourDoppler, WrapsAtItsScale) {
  for (const double v : {-950.0, -310.0, -290.0, 0.0, 290.0, 310.0, 640.0}) {
    double wanted = v;
    while (wanted >= 300.0) wanted -= 600.0;
    while (wanted < -300.0) wanted += 600.0;
    EXPECT_NEAR(aliased_mm_s(v, 300.0), wanted, 1e-9);
  }
  const cases::Structure one = vessel("portal_vein", -axis_at(40.0));
  const Scene s = around(one);
  const double true_mm_s = middle_mm_s("portal_vein") * std::cos(40.0 * std::numbers::pi / 180.0);
  EXPECT_NEAR(colour_of(s, one, 0.8 * true_mm_s).speed_mm_s(0.0, kDeepMm), true_mm_s - 1.6 * true_mm_s,
              0.02 * true_mm_s)
      << "towards the probe, and yet shown as away";
  EXPECT_NEAR(colour_of(s, one, 1.25 * true_mm_s).speed_mm_s(0.0, kDeepMm), true_mm_s, 0.02 * true_mm_s);
}

TEST(ColourDoppler, DepthBoundsItsScale) {
  UltrasoundView view = curved_view(150.0);
  const double f_hz = 1e6 * working_mhz(view);
  EXPECT_NEAR(most_colour_mm_s(view), 1e3 * 1540.0 * 1540.0 / (8.0 * f_hz * 0.150), 1e-6);
  EXPECT_EQ(colour_scale_mm_s(view, 1e9), most_colour_mm_s(view));
  EXPECT_EQ(colour_scale_mm_s(view, 1.0), kLeastColourMmS);
}

TEST(ColourDoppler, OfArteryAndVeinIsOfOppositeColours) {
  // Both rise towards the head, which here is up to the probe.
  const glm::dvec3 up(0.0, -std::sqrt(0.75), 0.5);
  for (const auto& [name, sign] : {std::pair{"carotid", 1.0}, std::pair{"jugular_vein", -1.0}}) {
    const cases::Structure one = vessel(name, up);
    const Colour colour = colour_of(around(one), one, 700.0);
    EXPECT_GT(sign * colour.speed_mm_s(0.0, kDeepMm), 50.0) << name;
  }
}

TEST(ColourDoppler, NeedsAFaceThatTouchesAndSoundThatGetsThere) {
  const cases::Structure one = vessel("portal_vein", -axis_at(40.0));
  Scene s = around(one);
  EXPECT_GT(colour_of(s, one, 300.0).sure(), 0.9);
  const std::vector<float> in_air(128, -20.0F);
  EXPECT_EQ(colour_of(s, one, 300.0, 0.15, in_air).sure(), 0.0);
  const Scene under_bone = scene(
      [&](const glm::dvec3& p) {
        if (p.y > 0.0 && p.y < 10.0) return TissueClass::bone;
        return cases::signed_distance_mm(one.shape, p, 100.0) < 0.5 ? TissueClass::vessel : TissueClass::liver;
      },
      {60, 100, 20}, 1.0);
  EXPECT_LT(colour_of(under_bone, one, 300.0).sure(), 0.5);
}

TEST(ColourDoppler, EachSpeedHasItsNumber) {
  const UltrasoundView view = straight_view(40.0);
  const ScanConverter converter(view, {40, 40, 0.0});
  ColourPicture picture;
  picture.box = colour_box(view, {});
  picture.rows = 2;
  std::vector<unsigned char> numbers;
  std::array<int, 256> met{};
  for (int i = -4000; i <= 4000; ++i) {
    const double share = i / 4000.3;  // of the scale
    const double angle = std::numbers::pi * share;
    picture.cells.assign(static_cast<std::size_t>(2 * (picture.box.end_beam - picture.box.first_beam)),
                         glm::vec2(0.8 * std::cos(angle), 0.8 * std::sin(angle)));
    colour_numbers(converter, {}, picture, numbers);
    const int number = numbers[static_cast<std::size_t>(40 * 20 + 8)],
              expected = kColourStill + static_cast<int>(std::lround(kColourSteps * share));
    const double beside =
        kColourSteps * share + 0.5 - std::floor(kColourSteps * share + 0.5);  // cells are in float
    if (std::min(beside, 1.0 - beside) > 1e-4) {
      ASSERT_EQ(number, expected) << share;
    }
    ++met[static_cast<std::size_t>(number)];
  }
  for (int number = kColourStill - kColourSteps; number <= kColourStill + kColourSteps; ++number)
    EXPECT_GT(met[static_cast<std::size_t>(number)], 0) << number;
}

TEST(ColourDoppler, IsDrawnWithinItsBoxAndVessel) {
  const cases::Structure one = vessel("portal_vein", -axis_at(40.0));
  cases::ConsoleSetting console;
  console.colour_mm_s = 300.0;
  console.lean_deg = 15.0;
  const Colour colour = colour_as(around(one), one, console);
  const ScanConverter converter(colour.view, {300, 400, 0.0});
  std::vector<unsigned char> numbers, flipped;
  colour_numbers(converter, {}, colour.picture, numbers);
  int coloured = 0;
  for (int r = 0; r < 400; ++r)
    for (int c = 0; c < 250; ++c) {  // left of the bar
      const unsigned char number = numbers[static_cast<std::size_t>(300 * r + c)];
      if (number == kNoColour || number == kColourEdge) continue;
      ++coloured;
      const glm::dvec3 p((c - 149.5) * converter.pixel_mm(), (r + 0.5) * converter.pixel_mm(), 0.0);
      EXPECT_LT(cases::signed_distance_mm(one.shape, p, 100.0), 1.0);
      EXPECT_GT(number, kColourStill) << "all of it comes towards the probe";
    }
  EXPECT_GT(coloured, 1000);
  const auto& table = colour_table();
  EXPECT_GT(table[kColourStill + 60][0], table[kColourStill + 60][2]) << "towards the probe is red";
  EXPECT_GT(table[kColourStill - 60][2], table[kColourStill - 60][0]) << "away is blue";
  // A box's edge is where a pixel of the box has one beside it that is none: told from the places alone.
  const ColourBox& box = colour.picture.box;
  const auto inside = [&](int c, int r) {
    const auto at = converter.place(c, r);
    if (!at) return false;
    const double beam = at->beam - box.grey_beam(box.first_beam, at->depth_mm);
    return beam >= 0.0 && beam <= box.end_beam - box.first_beam - 1.0 && at->depth_mm >= box.from_mm &&
           at->depth_mm <= box.to_mm;
  };
  int edge = 0;
  for (int r = 1; r < 399; ++r)
    for (int c = 1; c < 250; ++c) {
      const bool is_edge =
          inside(c, r) && !(inside(c - 1, r) && inside(c + 1, r) && inside(c, r - 1) && inside(c, r + 1));
      ASSERT_EQ(numbers[static_cast<std::size_t>(300 * r + c)] == kColourEdge, is_edge) << c << ", " << r;
      edge += is_edge ? 1 : 0;
    }
  EXPECT_GT(edge, 500);
  // Kept from picture to picture, and made anew where the box is another.
  std::optional<ColourScreen> kept;
  std::vector<unsigned char> by_kept, anew;
  for (const double lean_deg : {15.0, 15.0, -10.0, 15.0}) {
    console.lean_deg = lean_deg;
    const Colour other = colour_as(around(one), one, console);
    for (const bool flip : {false, true}) {
      UltrasoundKnobs knobs;
      knobs.flip = flip;
      colour_numbers(kept, converter, knobs, other.picture, by_kept);
      colour_numbers(converter, knobs, other.picture, anew);
      EXPECT_EQ(by_kept, anew) << lean_deg;
    }
  }
  const std::vector<unsigned char> grey(numbers.size(), 77);
  const std::vector<unsigned char> rgb = in_colour(grey, numbers);
  EXPECT_EQ(rgb[0], 77);
  EXPECT_EQ(rgb.size(), 3 * grey.size());
}

}  // namespace
}  // namespace seldinger::imaging
