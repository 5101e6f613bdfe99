// The console as it is turned at the desk, its calipers, and the picture that it keeps.
#include "app/window/hands/console_knobs.h"

#include <gtest/gtest.h>

#include <cmath>

#include "app/window/hands/console_picture.h"
#include "session/guidance/ultrasound_sight.h"
#include "sim/imaging/ultrasound/colour.h"
#include "sim/imaging/ultrasound/compound.h"
#include "sim/imaging/ultrasound/view/view.h"

namespace seldinger::app {
namespace {

using T = ConsoleTurn;

cases::Picture ultrasound(double target_below_skin_mm) {
  return session::ultrasound_picture(target_below_skin_mm);
}

ConsoleKnobs begun(const cases::Picture& picture) {
  ConsoleKnobs knobs;
  knobs.begin(picture);
  return knobs;
}

TEST(ConsoleKnobs, BeginAsTheCaseHasIt) {
  ConsoleKnobs knobs;
  knobs.begin(ultrasound(20.0));
  for (const T turn :
       {T::depth_more, T::focus_more, T::frequency_less, T::gain_more, T::range_less, T::next_map, T::flip})
    knobs.turn(turn, false);
  knobs.screen.tgc_db[3] = 7.0;
  EXPECT_NE(knobs.asked(), cases::ConsoleSetting{});
  EXPECT_EQ(knobs.preset(), -1);
  // The attempt after has a console of its own.
  const cases::Picture other = ultrasound(70.0);
  knobs.begin(other);
  EXPECT_EQ(knobs.asked(), cases::ConsoleSetting{});
  EXPECT_EQ(knobs.view().depth_mm, other.depth_mm);
  EXPECT_EQ(knobs.view().probe.name, "C5-2v");
  EXPECT_EQ(knobs.preset(), 0);
  EXPECT_EQ(knobs.screen.gain_db, 0.0);
  EXPECT_EQ(knobs.screen.dynamic_range_db, 60.0);
  EXPECT_EQ(knobs.screen.tgc_db[3], 0.0);
  EXPECT_EQ(knobs.screen.grey_map, imaging::GreyMap::linear);
  EXPECT_FALSE(knobs.screen.flip);
  imaging::Console console(*imaging::console_preset_named("liver"));
  console.set_gain_db(12.0);
  console.set_flip(true);
  knobs.apply(console);
  EXPECT_EQ(console.knobs().gain_db, 0.0);
  EXPECT_FALSE(console.knobs().flip);
}

TEST(ConsoleKnobs, KeysLeadToRoundNumbersWithinWhatTheProbeCan) {
  for (const double below_mm : {15.0, 80.0}) {
    ConsoleKnobs knobs = begun(ultrasound(below_mm));
    const imaging::Probe probe = knobs.view().probe;
    double before_mm = knobs.view().depth_mm;
    for (int i = 0; i < 60; ++i) {
      knobs.turn(T::depth_more, false);
      const double depth_mm = knobs.view().depth_mm;
      EXPECT_TRUE(depth_mm > before_mm || depth_mm == probe.most_depth_mm) << depth_mm;
      EXPECT_NEAR(std::remainder(depth_mm, depth_mm > 60.0 ? 10.0 : 5.0), 0.0, 1e-9);
      before_mm = depth_mm;
    }
    EXPECT_EQ(before_mm, probe.most_depth_mm);
    for (int i = 0; i < 60; ++i) knobs.turn(T::depth_less, false);
    EXPECT_EQ(knobs.view().depth_mm, probe.least_depth_mm);
    for (int i = 0; i < 60; ++i) knobs.turn(T::frequency_more, false);
    EXPECT_EQ(imaging::working_mhz(knobs.view()), probe.most_mhz);
    for (int i = 0; i < 60; ++i) knobs.turn(T::frequency_less, false);
    EXPECT_EQ(imaging::working_mhz(knobs.view()), probe.least_mhz);
    for (int i = 0; i < 60; ++i) knobs.turn(T::focus_more, false);
    EXPECT_EQ(knobs.view().focus_mm, knobs.view().depth_mm) << "not below the picture";
    for (int i = 0; i < 60 && knobs.asked().focus_mm > 0.0; ++i) knobs.turn(T::focus_less, false);
    EXPECT_EQ(knobs.view().focus_mm, 0.0) << "nearer than the nearest: at every depth";
    for (int i = 0; i < 60; ++i) knobs.turn(T::gain_more, false);
    EXPECT_EQ(knobs.screen.gain_db, imaging::kMostGainDb);
    for (int i = 0; i < 60; ++i) knobs.turn(T::range_less, false);
    EXPECT_EQ(knobs.screen.dynamic_range_db, imaging::kLeastRangeDb);
  }
}

TEST(ConsoleKnobs, ColourIsOnWithinWhatTheDepthAllowsOrOff) {
  ConsoleKnobs knobs = begun(ultrasound(70.0));
  knobs.turn(T::colour, true);
  EXPECT_EQ(knobs.asked().colour_mm_s, 0.0) << "frozen";
  knobs.turn(T::colour, false);
  EXPECT_EQ(knobs.asked().colour_mm_s, 200.0);
  EXPECT_EQ(knobs.preset(), 0) << "the picture below is the preset's still";
  knobs.set_colour_mm_s(1e9);
  EXPECT_EQ(knobs.asked().colour_mm_s, imaging::most_colour_mm_s(knobs.view()));
  knobs.turn(T::colour, false);
  EXPECT_EQ(knobs.asked(), cases::ConsoleSetting{});
  const std::vector<cases::Structure> vessels = {
      {"carotid", volume::TissueClass::vessel, cases::StructureRule::critical,
       cases::Tube{{{0, 0, 0}, {0, 0, 9}}, 3.0}},
      {"vessel 2", volume::TissueClass::vessel, cases::StructureRule::critical, cases::Sphere{{0, 0, 0}, 3.0}}};
  EXPECT_NE(colour_words(vessels).find("shows the flow in carotid"), std::string::npos);
  EXPECT_NE(colour_words(vessels).find("not known in vessel 2"), std::string::npos);
  EXPECT_NE(colour_words({}).find("not known in any vessel"), std::string::npos);
}

TEST(ConsoleKnobs, CompoundingIsOnOrOff) {
  ConsoleKnobs knobs = begun(ultrasound(70.0));
  knobs.turn(T::compound, false);
  EXPECT_EQ(knobs.asked().compound_deg, imaging::kCompoundDeg);
  EXPECT_EQ(knobs.view().compound_deg, imaging::kCompoundDeg);
  knobs.turn(T::compound, false);
  EXPECT_EQ(knobs.asked(), cases::ConsoleSetting{});
}

TEST(ConsoleKnobs, ColoursBeamsLeanFromAStraightFaceAndItsBoxIsPlaced) {
  ConsoleKnobs straight = begun(ultrasound(20.0)), curved = begun(ultrasound(70.0));
  straight.set_lean_deg(-99.0);
  curved.set_lean_deg(-99.0);
  EXPECT_EQ(straight.asked().lean_deg, -imaging::kMostLeanDeg);
  EXPECT_EQ(curved.asked().lean_deg, 0.0);
  curved.place_box(0.3, 7.0);
  EXPECT_EQ(curved.asked().box_across, 0.3);
  EXPECT_EQ(curved.asked().box_down, 1.0);
  curved.place_box(0.0, 0.0);
  EXPECT_EQ(curved.asked(), cases::ConsoleSetting{});
}

TEST(ConsoleKnobs, FrozenOnlyTheScreenCanBeTurned) {
  ConsoleKnobs knobs = begun(ultrasound(70.0));
  for (const T turn :
       {T::depth_less, T::depth_more, T::focus_more, T::frequency_less, T::next_preset, T::slice_on, T::compound})
    knobs.turn(turn, true);
  EXPECT_EQ(knobs.asked(), cases::ConsoleSetting{});
  knobs.turn(T::gain_more, true);
  EXPECT_GT(knobs.screen.gain_db, 0.0);
}

TEST(ConsoleKnobs, PresetsAreThoseOfTheProbeAndEndWhereTheyBegan) {
  ConsoleKnobs knobs = begun(ultrasound(70.0));
  ASSERT_EQ(knobs.presets().size(), 4U);
  for (const imaging::ConsolePreset& preset : knobs.presets()) EXPECT_EQ(preset.probe.name, "C5-2v");
  knobs.turn(T::flip, false);
  knobs.turn(T::gain_more, false);
  knobs.turn(T::next_preset, false);
  EXPECT_EQ(knobs.presets()[static_cast<std::size_t>(knobs.preset())].name, "liver");
  EXPECT_EQ(knobs.view().depth_mm, 150.0);
  EXPECT_EQ(knobs.view().focus_mm, 80.0);
  EXPECT_EQ(knobs.screen.gain_db, 0.0) << "sliders go to the middle";
  EXPECT_TRUE(knobs.screen.flip) << "but nobody walks round the patient";
  for (int i = 0; i < 2; ++i) knobs.turn(T::next_preset, false);
  EXPECT_EQ(knobs.view().frequency_mhz, 2.5) << "deep";
  knobs.turn(T::next_preset, false);
  EXPECT_EQ(knobs.asked(), cases::ConsoleSetting{});
  EXPECT_EQ(begun(ultrasound(20.0)).presets().size(), 3U);
}

TEST(ConsoleKnobs, SlicesAreScrolledAndWindowed) {
  cases::Picture picture;
  ConsoleKnobs knobs = begun(picture);
  EXPECT_TRUE(knobs.presets().empty());
  knobs.turn(T::slice_on, false);
  knobs.turn(T::slice_on, false);
  knobs.turn(T::slice_back, false);
  EXPECT_EQ(knobs.asked().slice_mm, 1.0);
  for (int i = 0; i < 200; ++i) knobs.turn(T::slice_back, false);
  EXPECT_EQ(knobs.asked().slice_mm, -session::kMostSliceMm);
  for (std::size_t i = 1; i <= session::kHuWindows.size(); ++i) {
    knobs.turn(T::next_window, false);
    EXPECT_EQ(knobs.window, i % session::kHuWindows.size());
  }
}

TEST(Calipers, AreTwoWhoseEndsCanBeMended) {
  Calipers calipers;
  EXPECT_TRUE(calipers.words().empty());
  const auto click = [&](double x_mm, double y_mm) {
    calipers.press({x_mm, y_mm}, 1.0);
    calipers.release();
  };
  click(0, 10);
  EXPECT_FALSE(calipers.length_mm(0));
  click(30, 50);
  EXPECT_DOUBLE_EQ(*calipers.length_mm(0), 50.0);
  // An end that is near is taken, goes along while it is held, and stays when it is let go.
  calipers.press({30.5, 50.0}, 1.0);
  calipers.drag({0.0, 30.0});
  calipers.release();
  calipers.drag({90.0, 90.0});
  EXPECT_DOUBLE_EQ(*calipers.length_mm(0), 20.0);
  click(-5, 20);
  click(5, 20);
  EXPECT_EQ(calipers.words(), (std::vector<std::string>{"A 20.0 mm", "B 10.0 mm", "ellipse 157 mm2"}));
  click(40, 40);
  EXPECT_EQ(calipers.ends_mm().size(), 1U) << "a third begins anew";
}

TEST(Calipers, MeasureADepthFromTheFaceDown) {
  struct Pair {
    glm::dvec2 from_mm, to_mm;
    std::optional<double> depth_mm;
  };
  const Pair pairs[] = {{{0, 2}, {0, 60}, 60.0},   {{10, 70.5}, {0, 0}, 70.5},  // either way, and at a slant
                        {{0, 7.9}, {5, 60}, 60.0}, {{0, 8.1}, {0, 60}, {}},     // begins too deep
                        {{-20, 30}, {20, 30}, {}}, {{0, 0}, {20, 2}, {}},       // across; along the face
                        {{0, -30}, {0, 60}, {}}};
  for (const Pair& pair : pairs) {
    Calipers calipers;
    calipers.press(pair.from_mm, 1.0);
    EXPECT_EQ(calipers.held(), 0U);
    EXPECT_FALSE(calipers.depth_mm(0)) << "one end";
    calipers.release();
    EXPECT_FALSE(calipers.held());
    calipers.press(pair.to_mm, 1.0);
    calipers.release();
    EXPECT_EQ(calipers.depth_mm(0), pair.depth_mm) << pair.from_mm.y << " to " << pair.to_mm.y;
    EXPECT_FALSE(calipers.depth_mm(1));
    calipers.press({40, 40}, 1.0);
    EXPECT_EQ(calipers.held(), 1U);
  }
}

session::ShownPicture shown_at(double depth_mm) {
  session::ShownPicture shown;
  shown.picture = {std::vector<unsigned char>(400 * 300, 90), 400, 300};
  shown.pixel_mm = depth_mm / 290.0;
  shown.top_mm = -10.0 * shown.pixel_mm;
  shown.console.depth_mm = depth_mm;
  return shown;
}

TEST(ConsolePicture, PlacesAreMillimetresWhateverTheDepthAndSide) {
  for (const double depth_mm : {60.0, 145.0})
    for (const bool flip : {false, true}) {
      const session::ShownPicture shown = shown_at(depth_mm);
      const glm::dvec2 at_mm(12.0, 30.0), pixel = pixel_of(shown, flip, at_mm), back = mm_of(shown, flip, pixel);
      EXPECT_NEAR(back.x, at_mm.x, 1e-9);
      EXPECT_NEAR(back.y, at_mm.y, 1e-9);
      EXPECT_EQ(pixel.x > 199.5, !flip);
      EXPECT_NEAR(pixel.y + 0.5, 10.0 + 30.0 / shown.pixel_mm, 1e-9);
    }
  EXPECT_EQ(depth_marks_mm(shown_at(60.0)).size(), 7U);
  EXPECT_EQ(depth_marks_mm(shown_at(145.0)).back(), 140.0);
  EXPECT_EQ(numbered_every(40.0), 1);
  EXPECT_EQ(numbered_every(17.0), 2);
  EXPECT_EQ(numbered_every(8.0), 5);
}

int lit_right_of(const Canvas& canvas, int column, const std::function<bool(int, int, int)>& is) {
  int count = 0;
  for (int y = 0; y < canvas.height_px(); ++y)
    for (int x = column; x < canvas.width_px(); ++x) {
      const std::size_t at = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(canvas.width_px()) +
                                  static_cast<std::size_t>(x));
      if (is(canvas.rgb()[at], canvas.rgb()[at + 1], canvas.rgb()[at + 2])) ++count;
    }
  return count;
}

TEST(ConsolePicture, HasItsScaleItsFocusAndItsCalipers) {
  session::ShownPicture shown = shown_at(100.0);
  Calipers none, two;
  for (const glm::dvec2& end : {glm::dvec2(-20, 40), glm::dvec2(20, 40)}) two.press(end, 1.0), two.release();
  const Canvas plain = console_picture(shown, false, none, {"C5-2v"});
  EXPECT_GE(plain.width_px(), 640) << "small pictures are shown larger";
  const auto yellow = [](int red, int green, int blue) { return red > 200 && green > 160 && blue < 120; };
  const auto ink = [](int red, int, int blue) { return red > 150 && blue > 180; };
  EXPECT_GT(lit_right_of(plain, plain.width_px() - 70, ink), 100) << "marks and numbers";
  EXPECT_EQ(lit_right_of(plain, 0, yellow), 0);
  shown.console.focus_mm = 50.0;
  const Canvas focused = console_picture(shown, false, none, {"C5-2v"});
  EXPECT_GT(lit_right_of(focused, focused.width_px() - 80, yellow), 10);
  const Canvas measured = console_picture(shown, false, two, {"C5-2v"});
  EXPECT_GT(lit_right_of(measured, 0, yellow), lit_right_of(focused, 0, yellow) + 100);
  EXPECT_GT(measured.height_px(), focused.height_px()) << "and a line that says how long";
  shown.pixel_mm = 0.0;  // fluoroscopy
  const Canvas bare = console_picture(shown, false, two, {"LAO 0"});
  EXPECT_EQ(lit_right_of(bare, 0, yellow), 0);
  EXPECT_LT(bare.width_px(), plain.width_px());
}

}  // namespace
}  // namespace seldinger::app
