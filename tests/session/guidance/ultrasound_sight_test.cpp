// Tests of session/guidance/ultrasound_sight and of attempts under ultrasound: a ball of tissue with a cyst.
#include "session/guidance/ultrasound_sight.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

#include "app/attempts/this_program.h"
#include "assessment/operators/plan.h"
#include "assessment/score.h"
#include "session/attempt/endpoint_picture.h"
#include "session/attempt/replayed_attempt.h"
#include "session/attempt/simulated_attempt.h"
#include "session/guidance/guidance.h"
#include "session/guidance/picture_clock.h"
#include "session/monitor/guidance_screen.h"
#include "sim/case/paint.h"
#include "sim/case/probe_depths.h"
#include "sim/imaging/ultrasound/colour_screen.h"
#include "sim/imaging/ultrasound/view/echogenicity.h"
#include "sim/volume/tissue/find_tissue.h"
#include "tests/fixtures/ball_case.h"
#include "tests/session/guidance/stored_picture.h"

namespace seldinger::session {
namespace {

constexpr double kBallMm = 100.0;

// With a cyst 55 mm below the skin; a plate of bone, as wide as asked for, 25 mm above it.
cases::Case make_ball(double bone_half_mm) {
  fixtures::Ball made{88, 2.5, kBallMm, 50.0, 5};
  if (bone_half_mm > 0.0)
    made.inside = {
        {volume::Box{{-bone_half_mm, -74, -bone_half_mm}, {bone_half_mm, -66, bone_half_mm}}, 900.0, ""}};
  cases::Case scene = fixtures::ball_case(made);
  scene.classes = volume::tissue_classes(scene.volume);
  scene.echogenicity = imaging::echogenicity(scene.volume, scene.classes);
  scene.lesions.push_back({{0.0, -45.0, 0.0}, 6.0, 5.0});
  scene.picture.modality = cases::Modality::ultrasound;
  return scene;
}

const cases::Case& still_ball() {
  static const cases::Case kBall = make_ball(0.0);
  return kBall;
}

base::Result<assessment::PuncturePlan> plan_of(const cases::Case& scene, bool looks_everywhere = false) {
  const UltrasoundSight sight(scene);
  assessment::PathLimits limits =
      assessment::path_limits(cases::Modality::ultrasound, cases::PatientPosition::supine);
  limits.looks_from = [&](const assessment::PuncturePlan& plan, const assessment::WorthTaking& worth) {
    return sight.looks_from(plan, looks_everywhere ? nullptr : worth, scene.lesions[0]);
  };
  return assessment::plan_puncture(scene.volume, scene.skin_index, scene.lesions[0].center_lps_mm, limits);
}

// The ball with the plan's picture.
struct Planned {
  cases::Case scene = make_ball(0.0);
  assessment::PuncturePlan plan;
  Planned() {
    const auto found = plan_of(scene);
    EXPECT_TRUE(found.has_value());
    if (!found) return;
    plan = *found;
    scene.picture = *plan.picture;
  }
};
Planned& planned() {
  static Planned made;
  return made;
}

imaging::UltrasoundView view_at(const cases::ToolPose& probe, const imaging::Probe& of) {
  imaging::UltrasoundView view;
  view.probe = of;
  view.origin_lps_mm = probe.position_lps_mm;
  view.axial = probe.axis;
  view.lateral = probe.side;
  return view;
}

TEST(ElementDepths, AreThoseBelowASphere) {
  for (const imaging::Probe& probe : {imaging::kC52v, imaging::kL115v}) {
    const auto view = view_at({{0, -kBallMm + 8.0, 0}, {0, 1, 0}, {1, 0, 0}}, probe);
    const auto exact = element_depths(still_ball().skin_index, view),
               few = element_depths(still_ball().skin_index, view, kContactStride);
    ASSERT_EQ(exact.size(), static_cast<std::size_t>(probe.elements));
    ASSERT_EQ(few.size(), exact.size());
    for (int element = 0; element < probe.elements; ++element) {
      const double from_middle_mm = (element - 63.5) * probe.pitch_mm;
      glm::dvec3 place(from_middle_mm, -92.0, 0);
      if (probe.radius_mm > 0.0) {
        const double angle = from_middle_mm / probe.radius_mm;
        place = {probe.radius_mm * std::sin(angle), -92.0 - probe.radius_mm * (1.0 - std::cos(angle)), 0};
      }
      const auto i = static_cast<std::size_t>(element);
      EXPECT_NEAR(exact[i], kBallMm - glm::length(place), 0.2) << probe.name << " " << element;  // a faceted ball
      EXPECT_NEAR(few[i], exact[i], 0.25) << probe.name << " " << element;
    }
  }
  for (const float depth : element_depths(cases::MeshIndex(), view_at({}, imaging::kC52v)))
    EXPECT_LT(depth, -100.0F);
}

TEST(UltrasoundPicture, ChoosesProbeAndDepthByTheTarget) {
  for (double below_mm = 12.0; below_mm <= 130.0; below_mm += 1.0) {
    const cases::Picture picture = ultrasound_picture(below_mm);
    EXPECT_EQ(picture.modality, cases::Modality::ultrasound);
    EXPECT_EQ(picture.probe, below_mm <= 35.0 ? "L11-5v" : "C5-2v");
    const double share = (below_mm - (below_mm <= 35.0 ? 3.0 : 10.0)) / picture.depth_mm;
    if (picture.depth_mm > 30.0) {
      EXPECT_GE(share, 0.5) << below_mm;
      EXPECT_LE(share, 2.0 / 3.0) << below_mm;
    } else {
      EXPECT_LE(share, 2.0 / 3.0) << below_mm;
    }
    // 1540 m/s, there and back, 128 lines; 60 Hz is the screen's.
    EXPECT_NEAR(picture.rate_hz, std::min(60.0, 1540e3 / (2.0 * picture.depth_mm * 128)), 1e-9);
  }
}

// The other probe shows the target too, as far as it reaches; back again the picture is the one of before.
TEST(UltrasoundPicture, ByAnotherProbeShowsTheTargetWhereItWas) {
  for (double below_mm = 12.0; below_mm <= 130.0; below_mm += 1.0) {
    const cases::Picture picture = ultrasound_picture(below_mm);
    for (const imaging::Probe* probe : offered_probes()) {
      const cases::Picture other = by_probe(picture, *probe);
      EXPECT_EQ(other.probe, probe->name);
      const auto suits = cases::depths_that_suit(probe->name);
      ASSERT_TRUE(suits.has_value());
      EXPECT_EQ(suits->from_mm > 0.0, probe->radius_mm > 0.0) << "only a curved one may be too near";
      EXPECT_EQ(other.modality, cases::Modality::ultrasound);
      EXPECT_GE(other.depth_mm, probe->least_depth_mm);
      EXPECT_LE(other.depth_mm, probe->most_depth_mm);
      EXPECT_GT(other.depth_mm, std::min(below_mm, probe->most_depth_mm - 1.0)) << probe->name << " " << below_mm;
      EXPECT_NEAR(other.rate_hz, std::min(60.0, 1540e3 / (2.0 * other.depth_mm * 128)), 1e-9);
      if (other.probe == picture.probe) {
        EXPECT_EQ(other.depth_mm, picture.depth_mm);
      }
    }
  }
}

TEST(UltrasoundPlan, SeesTargetAndTipFromItsProbe) {
  const assessment::PuncturePlan& plan = planned().plan;
  const cases::Case& scene = planned().scene;
  const UltrasoundSight sight(scene);
  const cases::Instrument needle;
  const auto seen = sight.see(
      plan.probe, {},
      {plan.target_lps_mm, plan.direction, needle.length_mm, needle.radius_mm, needle.inner_radius_mm, needle.hu});
  EXPECT_TRUE(seen.visible.joint);
  EXPECT_TRUE(seen.near_plane.tip_2_mm && seen.near_plane.target_2_mm) << "needle and target lie in its plane";
  EXPECT_LE(plan.tip_shows_from_mm, 4.0) << "the needle enters beside a face whose end touches";
  // Beside the face, not through it; the probe pressed into the skin.
  EXPECT_GT(std::abs(glm::dot(plan.entry_lps_mm - plan.probe.position_lps_mm, plan.probe.side)), 30.0);
  const double pressed_mm = -scene.skin_index.closest(plan.probe.position_lps_mm).distance_mm;
  EXPECT_GE(pressed_mm, 8.0);
  EXPECT_LE(pressed_mm, 10.0 + plan.pressed_mm + 0.1) << "along its axis, which may lean";
  EXPECT_NEAR(glm::dot(plan.probe.axis, plan.probe.side), 0.0, 1e-9);
}

// What is left out because it could not be better changes no plan, to the bit.
TEST(UltrasoundPlan, IsThatOfLookingEverywhere) {
  const cases::Case scene = make_ball(14.0);
  const auto plan = plan_of(scene), everywhere = plan_of(scene, true);
  ASSERT_TRUE(plan.has_value() && everywhere.has_value());
  EXPECT_EQ(plan->entry_lps_mm, everywhere->entry_lps_mm);
  for (const auto& [a, b] :
       {std::pair{plan->probe, everywhere->probe}, {plan->probe_first, everywhere->probe_first}}) {
    EXPECT_EQ(a.position_lps_mm, b.position_lps_mm);
    EXPECT_EQ(a.axis, b.axis);
    EXPECT_EQ(a.side, b.side);
  }
  EXPECT_EQ(plan->pressed_mm, everywhere->pressed_mm);
  EXPECT_EQ(plan->tip_shows_from_mm, everywhere->tip_shows_from_mm);
  EXPECT_EQ(plan->picture->depth_mm, everywhere->picture->depth_mm);
}

TEST(UltrasoundPlan, LooksPastAPlateOfBone) {
  const cases::Case screened = make_ball(14.0);
  ASSERT_GT(volume::count_classes(screened.classes)[static_cast<std::size_t>(volume::TissueClass::bone)], 50U);
  // Straight from above nothing is seen.
  assessment::PuncturePlan above;
  above.target_lps_mm = screened.lesions[0].center_lps_mm;
  above.direction = glm::normalize(glm::dvec3(1.0, 0.6, 0.0));
  above.depth_mm = 60.0;
  above.entry_lps_mm = above.target_lps_mm - above.depth_mm * above.direction;
  above.probe = above.probe_first = {{0, -kBallMm, 0}, {0, 1, 0}, {1, 0, 0}};
  EXPECT_FALSE(UltrasoundSight(screened).looks_from(above, {}, screened.lesions[0]).has_value());
  EXPECT_TRUE(UltrasoundSight(still_ball()).looks_from(above, {}, still_ball().lesions[0]).has_value());
  const auto plan = plan_of(screened);
  ASSERT_TRUE(plan.has_value()) << "from the side it is";
  EXPECT_LT(glm::dot(plan->probe.axis, glm::dvec3(0, 1, 0)), 0.95);
}

TEST(UltrasoundPlan, ATargetThatSoundCannotTellHasNone) {
  cases::Case same = make_ball(0.0);
  same.lesions[0].hu = 50.0;
  const auto plan = plan_of(same);
  ASSERT_FALSE(plan.has_value());
  EXPECT_EQ(plan.error().code, "no_path");
}

// Mean difference of two envelopes, as a share of the first's mean.
double mean_difference(const imaging::PolarPicture& a, const imaging::PolarPicture& b) {
  EXPECT_EQ(a.envelope.size(), b.envelope.size());
  double apart = 0.0, all = 0.0;
  for (std::size_t i = 0; i < a.envelope.size(); ++i) {
    apart += std::abs(static_cast<double>(a.envelope[i]) - static_cast<double>(b.envelope[i]));
    all += a.envelope[i];
  }
  return apart / all;
}

TEST(UltrasoundSightBackends, GlDrawsWhatTheCpuDrawsByEitherMethodAndMayBeLeftAgain) {
  cases::Case scene = still_ball();
  scene.picture = ultrasound_picture(55.0);
  scene.yields = true;
  const cases::ToolPose probe{{0.0, 12.0 - kBallMm, 0.0}, {0.0, 1.0, 0.0}, {1.0, 0.0, 0.0}};  // all of it touches
  const imaging::NeedlePose aside{{300.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, 100.0, 0.5, 0.3, 4000.0};
  const tissue::SkinPress press{{0.0, -kBallMm, 0.0}, {0.0, 1.0, 0.0}, 40.0, 8.0, 0.0};
  UltrasoundSight sight(scene), by_gl(scene);
  gpu::Context context;
  by_gl.draw_on(context);
  for (const tissue::Displacement& displacement :
       {tissue::Displacement{}, tissue::displacement_of({{&press, 1}, {}, {}, {}})}) {
    imaging::PolarPicture fine, fast, other;
    for (UltrasoundSight* one : {&sight, &by_gl}) one->set_method(imaging::UltrasoundMethod::scatterers);
    sight.polar(probe, {}, aside, 1, 1, fine, displacement);
    by_gl.polar(probe, {}, aside, 1, 1, other, displacement);
    EXPECT_LT(mean_difference(fine, other), 0.01);
    for (UltrasoundSight* one : {&sight, &by_gl}) one->set_method(imaging::UltrasoundMethod::lattice);
    sight.polar(probe, {}, aside, 1, 1, fast, displacement);
    by_gl.polar(probe, {}, aside, 1, 1, other, displacement);
    EXPECT_LT(mean_difference(fast, other), 0.01);
    EXPECT_GT(mean_difference(fine, fast), 0.2) << "another grain";
  }
  by_gl.draw_on_cpu();
  imaging::PolarPicture again, as_before;
  sight.polar(probe, {}, aside, 1, 1, again);
  by_gl.polar(probe, {}, aside, 1, 1, as_before);
  EXPECT_EQ(again.envelope, as_before.envelope);
}

TEST(UltrasoundAttempt, IsRecordedAtTheRateOfSoundAndReplayable) {
  const Planned& p = planned();
  const auto recording = run_attempt(p.scene, p.plan, *assessment::named_profile("expert"), 3);
  ASSERT_TRUE(recording.endpoint.has_value());
  const double seconds = static_cast<double>(recording.inputs.size()) * recording.dt_s;
  EXPECT_NEAR(static_cast<double>(recording.frames.size()), seconds * p.scene.picture.rate_hz, 2.0);
  std::size_t tips = 0;
  for (const cases::FrameTruth& frame : recording.frames) {
    ASSERT_TRUE(frame.near_plane.has_value());
    tips += frame.needle_tip ? 1 : 0;
  }
  EXPECT_GT(tips, recording.frames.size() / 10);
  // Replay needs no tissue.
  cases::Case bare = p.scene;
  bare.classes.clear();
  bare.echogenicity.clear();
  EXPECT_TRUE(replay(bare, recording).same);
  const auto stored = cases::recording_from_chunks(cases::chunks_from_recording(recording));
  ASSERT_TRUE(stored.has_value());
  const auto a = assessment::measure(p.scene, recording), b = assessment::measure(bare, *stored);
  ASSERT_TRUE(a.has_value() && b.has_value());
  for (std::size_t i = 0; i < a->size(); ++i) EXPECT_EQ((*a)[i].value, (*b)[i].value) << (*a)[i].id;
}

// At the plan's end, with the probe where the plan has it.
cases::State at_target(const Planned& p) {
  cases::State state;
  state.t_s = 1.0;
  state.needle.tip_lps_mm = p.plan.target_lps_mm;
  state.needle.direction = p.plan.direction;
  state.probe.origin_lps_mm = p.plan.probe.position_lps_mm;
  state.probe.axial = p.plan.probe.axis;
  state.probe.lateral = p.plan.probe.side;
  return state;
}

TEST(UltrasoundConsole, WhatIsSaidToShowIsOfThePictureAsItStands) {
  const Planned& p = planned();
  const auto guidance = guidance_of(p.scene);
  const auto see = [&](const cases::State& now, const tissue::Displacement& displacement) {
    return guidance->see(now, displacement);
  };
  cases::State state = at_target(p);
  EXPECT_TRUE(see(state, {}).joint());
  // Pressed no deeper than it takes to touch, so that the target lies below the shallowest picture.
  state.probe.origin_lps_mm -= (p.plan.pressed_mm + 8.0) * state.probe.axial;
  EXPECT_TRUE(see(state, {}).target);
  state.probe.console.depth_mm = imaging::kC52v.least_depth_mm;
  const double below_mm = glm::dot(p.scene.lesions[0].center_lps_mm - state.probe.origin_lps_mm, state.probe.axial);
  ASSERT_GT(below_mm, state.probe.console.depth_mm);
  const cases::FrameTruth shallow = see(state, {});
  EXPECT_FALSE(shallow.target || shallow.needle_tip) << "both lie below the picture";
  EXPECT_FALSE(shallow.near_plane->target_5_mm) << "which is told of the field, too";
  EXPECT_LT(shallow.needle_length_mm, see(at_target(p), {}).needle_length_mm);
  state = at_target(p);
  state.probe.console.depth_mm = p.scene.picture.depth_mm + 40.0;
  EXPECT_TRUE(see(state, {}).joint());
  // The tip's echo is weaker where the beam is wide: far out of focus, and by waves that are longer.
  const auto told = [&](const cases::ConsoleSetting& console) {
    imaging::UltrasoundView view = console_view(p.scene.picture, console);
    view.origin_lps_mm = state.probe.origin_lps_mm;
    view.axial = state.probe.axial;
    view.lateral = state.probe.lateral;
    return view;
  };
  for (const cases::ConsoleSetting& console :
       {cases::ConsoleSetting{70.0, 0.0, 0.0}, cases::ConsoleSetting{0.0, 20.0, 0.0},
        cases::ConsoleSetting{0.0, 0.0, 5.0}, cases::ConsoleSetting{300.0, 299.0, 2.0}}) {
    state.probe.console = console;
    const imaging::UltrasoundView view = told(console);
    const cases::Instrument& needle = p.scene.instrument;
    const imaging::NeedlePose pose{state.needle.tip_lps_mm, state.needle.direction, needle.length_mm,
                                   needle.radius_mm,        needle.inner_radius_mm, needle.hu};
    const auto expected = imaging::ultrasound_visible({&p.scene.volume, p.scene.classes, p.scene.echogenicity},
                                                      view, {pose, p.scene.lesions},
                                                      element_depths(p.scene.skin_index, view, kContactStride));
    const cases::FrameTruth seen = see(state, {});
    EXPECT_EQ(seen.needle_tip, expected.visible.needle_tip);
    EXPECT_EQ(seen.target, expected.visible.target);
    EXPECT_EQ(seen.needle_length_mm, expected.visible.needle_length_mm);
  }
}

TEST(UltrasoundConsole, IsThatOfTheCaseUntilItIsTurned) {
  const cases::Picture& picture = planned().scene.picture;
  const imaging::UltrasoundView own = console_view(picture, {});
  EXPECT_EQ(own.depth_mm, picture.depth_mm);
  EXPECT_EQ(own.focus_mm, 0.0);
  EXPECT_EQ(own.frequency_mhz, 0.0);
  EXPECT_EQ(picture_rate_hz(picture, {}), picture.rate_hz);
  EXPECT_EQ(picture_rate_hz(picture, {0.0, 40.0, 3.0}), picture.rate_hz) << "the way of sound is the same";
  EXPECT_NEAR(picture_rate_hz(picture, {200.0, 0.0, 0.0}), 1540e3 / (2.0 * 200.0 * 128), 1e-9);
  EXPECT_EQ(picture_rate_hz(picture, {40.0, 0.0, 0.0}), 60.0) << "the screen's";
  EXPECT_EQ(picture_rate_hz(picture, {9e9, 0.0, 0.0}), picture_rate_hz(picture, {300.0, 0.0, 0.0}));
}

TEST(UltrasoundConsole, TheStoredPictureIsAsItStoodWhenTheTriggerFell) {
  const Planned& p = planned();
  auto recording = run_attempt(p.scene, p.plan, *assessment::named_profile("expert"), 4);
  ASSERT_TRUE(recording.endpoint.has_value());
  const auto plain = stored_picture(p.scene, recording);
  const auto fired = static_cast<std::size_t>(std::lround(recording.endpoint->t_s / recording.dt_s));
  ASSERT_LT(fired, recording.inputs.size());
  ASSERT_TRUE(recording.inputs[fired - 1].fire && !recording.inputs[fired - 2].fire);
  auto turned = recording;
  for (std::size_t i = fired; i < turned.inputs.size(); ++i) turned.inputs[i].console.depth_mm = 120.0;
  EXPECT_EQ(stored_picture(p.scene, turned), plain) << "afterwards";
  turned.inputs[fired - 1].console.depth_mm = 120.0;
  const auto deep = stored_picture(p.scene, turned);
  EXPECT_NE(deep, plain) << "in the same tick";
  // The same inputs by another picture: the same motion, other hashes from the turn on.
  EXPECT_EQ(replay(p.scene, turned).first_difference_tick, fired);
}

TEST(UltrasoundConsole, AScreenThatIsWatchedShowsWhatWasTurned) {
  const Planned& p = planned();
  GuidanceScreen screen(p.scene, 7);
  cases::State state = at_target(p);
  const auto after = [&](double seconds) {
    for (int i = 0; i < static_cast<int>(seconds * 1000.0); ++i) {
      state.t_s += 0.001;
      screen.tick(state, {});
    }
    return screen.picture();
  };
  const GreyPicture own = after(0.1);
  ASSERT_GT(own.width_px, 0);
  state.probe.console.depth_mm = p.scene.picture.depth_mm + 60.0;
  const GreyPicture deep = after(0.1);
  EXPECT_NE(deep.grey, own.grey);
  // Of a picture that is deeper more lies above the target: it comes to lie higher.
  state.probe.frozen = true;
  state.probe.console = {};
  EXPECT_EQ(after(0.1).grey, deep.grey) << "frozen it stays, whatever is turned";
  state.probe.frozen = false;
  EXPECT_EQ(after(0.1).height_px, own.height_px);
}

// The ball with a carotid that rises through it towards the probe, and one of which nothing is known.
TEST(UltrasoundConsole, ColourShowsFlowOverTheSameGrey) {
  cases::Case scene = planned().scene;
  const cases::State still = at_target(planned());
  const glm::dvec3 middle = still.probe.origin_lps_mm + 40.0 * still.probe.axial;
  const glm::dvec3 half = 15.0 * (glm::dvec3(0.0, 0.0, 1.0) - still.probe.axial);  // to the head, up to the probe
  scene.structures = {{"carotid", volume::TissueClass::vessel, cases::StructureRule::critical,
                       cases::Tube{{middle + half, middle - half}, 4.0}},
                      {"vessel 2", volume::TissueClass::vessel, cases::StructureRule::critical,
                       cases::Sphere{middle + glm::dvec3(0.0, 0.0, 30.0), 4.0}}};
  for (const cases::Structure& one : scene.structures)
    cases::paint_class(one.shape, one.tissue, scene.volume, scene.classes);
  const auto guidance = guidance_of(scene);
  cases::State state = still;
  state.t_s = 0.15;
  const GreyPicture plain = guidance->picture(state, {}, {7, 1});
  EXPECT_TRUE(plain.colour.empty());
  state.probe.console.colour_mm_s = 500.0;
  const GreyPicture flow = guidance->picture(state, {}, {7, 1});
  EXPECT_EQ(flow.grey, plain.grey);
  ASSERT_EQ(flow.colour.size(), flow.grey.size());
  const auto counts = [](const GreyPicture& picture) {
    int towards = 0, away = 0;
    for (int y = 0; y < picture.height_px; ++y)
      for (int x = 0; x < picture.width_px - 40; ++x) {  // without the bar
        const unsigned char number = picture.colour[static_cast<std::size_t>(y * picture.width_px + x)];
        towards += number > imaging::kColourStill ? 1 : 0;
        away += number > imaging::kColourEdge && number < imaging::kColourStill ? 1 : 0;
      }
    return std::pair{towards, away};
  };
  EXPECT_GT(counts(flow).first, 200) << "it comes towards the probe";
  EXPECT_EQ(counts(flow).second, 0);
  EXPECT_EQ(guidance->picture(state, {}, {7, 1}).colour, flow.colour) << "the same bits again";
  EXPECT_EQ(rgba_of(flow).size(), 4 * flow.grey.size());
  state.t_s = 0.15 + 0.4;
  EXPECT_NE(guidance->picture(state, {}, {7, 1}).colour, flow.colour) << "it beats";
  state.t_s = 0.15 + 3.0 * tissue::kBeatS;
  EXPECT_EQ(guidance->picture(state, {}, {7, 1}).colour, flow.colour);
  // Walls follow the beat: under the newest law of sight alone, and in grey as well.
  state.probe.console = {};
  state.t_s = 0.0;
  const GreyPicture narrow = guidance->picture(state, {}, {7, 1});
  state.t_s = 0.2;
  EXPECT_NE(guidance->picture(state, {}, {7, 1}).grey, narrow.grey);
  scene.sight_law = cases::SightLaw::echo;
  const auto before = guidance_of(scene);
  const GreyPicture wide_before = before->picture(state, {}, {7, 1});
  state.t_s = 0.0;
  EXPECT_EQ(before->picture(state, {}, {7, 1}).grey, wide_before.grey);
  scene.sight_law = cases::kNewestSightLaw;
  state.probe.console.colour_mm_s = 500.0;
  // What a picture tells asks for neither.
  cases::State off = state;
  off.probe.console = {};
  EXPECT_EQ(guidance->see(state, {}), guidance->see(off, {}));
}

// Clutter is a case's of the newest law; compounding the console's, and off it costs no bit.
TEST(UltrasoundConsole, CompoundsWhereItIsTurnedOn) {
  cases::Case scene = planned().scene;
  const cases::ToolPose probe = probe_in(at_target(planned()));
  const auto envelope = [&](double compound_deg, LooksOf looks = LooksOf::one_moment, std::uint64_t frames = 1) {
    UltrasoundSight sight(scene);
    cases::ConsoleSetting console;
    console.compound_deg = compound_deg;
    imaging::PolarPicture picture;
    for (std::uint64_t frame = 1; frame <= frames; ++frame)
      sight.polar(probe, console, {}, 1, frame, picture, {}, 0.0, looks);
    return picture.envelope;
  };
  const auto plain = envelope(0.0), of_one_moment = envelope(12.0);
  ASSERT_EQ(of_one_moment.size(), plain.size());
  EXPECT_NE(of_one_moment, plain);
  EXPECT_EQ(envelope(0.0, LooksOf::last_frames, 1), plain);
  EXPECT_EQ(envelope(12.0, LooksOf::last_frames, 1), of_one_moment) << "the first picture has all its looks";
  // Of a still scene the fourth shows what the first does, but for the receiver's noise.
  const auto fourth = envelope(12.0, LooksOf::last_frames, 4);
  EXPECT_NE(fourth, of_one_moment);
  double worst = 0.0;
  for (std::size_t i = 0; i < fourth.size(); ++i)
    worst = std::max(worst, static_cast<double>(std::abs(fourth[i] - of_one_moment[i])));
  EXPECT_LT(worst, 0.01);
  // Of what was before a leap nothing is left.
  cases::ToolPose elsewhere = probe;
  elsewhere.position_lps_mm += 15.0 * probe.side;
  cases::ConsoleSetting on;
  on.compound_deg = 12.0;
  imaging::PolarPicture leapt, whole;
  UltrasoundSight sight(scene);
  sight.polar(probe, on, {}, 1, 5, leapt, {}, 1.0, LooksOf::last_frames);
  sight.polar(elsewhere, on, {}, 1, 6, leapt, {}, 60.0, LooksOf::last_frames);
  sight.polar(elsewhere, on, {}, 1, 6, whole, {}, 60.0, LooksOf::one_moment);
  EXPECT_EQ(leapt.envelope, whole.envelope);
  // The cyst is filled by clutter under the newest law alone.
  scene.sight_law = cases::SightLaw::scatter;
  EXPECT_NE(envelope(0.0), plain);
}

TEST(UltrasoundConsole, WhatIsToldOfACompoundedPictureIsOfItsLooks) {
  const cases::Case& scene = planned().scene;
  const UltrasoundSight sight(scene);
  const cases::ToolPose probe = probe_in(at_target(planned()));
  cases::ConsoleSetting on;
  on.compound_deg = 12.0;
  EXPECT_TRUE(sight.see(probe, {}, {}).visible.target);
  EXPECT_TRUE(sight.see(probe, on, {}).visible.target);
  // Steep shafts, of which a look from the side shows more.
  double shows_mm = 0.0, compounded_mm = 0.0;
  for (double tilt_deg = 50.0; tilt_deg <= 80.0; tilt_deg += 5.0) {
    const double tilt = tilt_deg * std::numbers::pi / 180.0;
    const glm::dvec3 direction = std::sin(tilt) * probe.axis + std::cos(tilt) * probe.side;
    const imaging::NeedlePose needle{probe.position_lps_mm + 60.0 * probe.axis, direction, 150.0, 0.5, 0.3, 4000.0};
    shows_mm += sight.see(probe, {}, needle).visible.needle_length_mm;
    compounded_mm += sight.see(probe, on, needle).visible.needle_length_mm;
  }
  EXPECT_GT(compounded_mm, shows_mm);
}

TEST(PictureClock, KeepsItsRateAndGoesOnFromTheLastPictureAtAnother) {
  PictureClock clock;
  std::vector<int> due_ms;
  for (int ms = 1; ms <= 2000; ++ms)
    if (clock.due(0.001 * ms, ms <= 1000 ? 40.0 : 10.0)) due_ms.push_back(ms);
  ASSERT_EQ(due_ms.size(), 41U + 10U);
  EXPECT_EQ(due_ms.front(), 1);
  EXPECT_EQ(clock.count(), 51);
  for (std::size_t i = 1; i < due_ms.size(); ++i)
    EXPECT_NEAR(due_ms[i] - due_ms[i - 1], due_ms[i - 1] < 1000 ? 25.0 : 100.0, 1.001) << due_ms[i];
  // A knob that is turned without end makes no more pictures than either rate.
  PictureClock turned;
  int pictures = 0;
  for (int ms = 1; ms <= 1000; ++ms) pictures += turned.due(0.001 * ms, 20.0 + 0.01 * (ms % 100)) ? 1 : 0;
  EXPECT_NEAR(pictures, 21, 2);
}

TEST(UltrasoundAttempt, HasThePictureOfItsEndpoint) {
  const Planned& p = planned();
  const auto recording = run_attempt(p.scene, p.plan, *assessment::named_profile("expert"), 4);
  const auto png = stored_picture(p.scene, recording);
  ASSERT_GT(png.size(), 10'000U);
  EXPECT_EQ(png[1], std::byte{'P'});
  EXPECT_EQ(png, stored_picture(p.scene, recording)) << "noise is the attempt's own";
}

}  // namespace
}  // namespace seldinger::session
