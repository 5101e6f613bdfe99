// Contrast through the needle under a fluoroscope: a collecting system that fills and is rinsed, and what the
// picture shows where the needle is somewhere else. The frames are kept in test-out/nephrostogram.png.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "session/attempt/replayed_attempt.h"
#include "session/guidance/fluoroscopy.h"
#include "sim/case/form/shape.h"
#include "sim/engine/needle_flow.h"
#include "sim/engine/step.h"
#include "sim/engine/tick.h"
#include "sim/imaging/xray/c_arm.h"
#include "sim/volume/phantom.h"
#include "tests/fixtures/coarse_picture.h"
#include "tests/fixtures/meshes.h"
#include "tests/fixtures/places.h"

namespace seldinger::session {
namespace {

using cases::EventKind;

// The built-in torso's right kidney, its lower calyx dilated (15 mm), without contrast.
const glm::dvec3 kLowerCalyx{-68.0, 40.0, -50.0}, kUpperCalyx{-60.0, 44.0, 2.0}, kPelvis{-48.0, 38.0, -27.0},
    kArtery{-62.0, 52.0, -41.0}, kPerirenal{-100.0, 60.0, -50.0}, kBeside{-85.0, 40.0, -5.0};

const cases::Case& kidney_torso() {
  static const cases::Case kTorso = [] {
    volume::PhantomOptions options;
    options.calyces = volume::Calyces::dilated;
    options.spacing_mm = glm::dvec3(1.5, 1.5, 2.0);
    volume::Phantom phantom = volume::make_phantom(options);
    cases::Case scene;
    const auto names = phantom.labels.names;
    const auto urine = std::find(names.begin(), names.end(), "collecting_system") - names.begin();
    scene.structures = {
        {"collecting_system", volume::TissueClass::fluid, cases::StructureRule::target,
         cases::Shape{cases::voxels_with(phantom.volume, phantom.labels.label, static_cast<std::uint8_t>(urine))}},
        {"interlobar_artery", volume::TissueClass::vessel, cases::StructureRule::critical,
         cases::Tube{{{-52.0, 45.0, -36.0}, kArtery, {-72.0, 54.0, -42.0}}, 1.5}}};
    scene.volume = std::move(phantom.volume);
    scene.skin = fixtures::sphere_mesh({-60, 40, -40}, 90.0, 5);
    scene.skin_index = cases::MeshIndex(scene.skin);
    scene.picture.modality = cases::Modality::xray;
    scene.position = cases::PatientPosition::prone;
    scene.instrument.radius_mm = 0.635;
    scene.fluoroscope.start.isocentre_lps_mm = {-55.0, 40.0, -35.0};
    return scene;
  }();
  return kTorso;
}

// The needle lies still with its tip somewhere, from the back; contrast is pushed through it.
class KidneyPatient {
 public:
  explicit KidneyPatient(const glm::dvec3& tip_lps_mm) : flows_(kidney_torso()), sight_(kidney_torso()) {
    cases::Inputs inputs;
    inputs.needle = {tip_lps_mm, {0.0, -1.0, 0.0}, {1.0, 0.0, 0.0}};
    inputs.fluoroscope.magnification = 2;
    inputs.fluoroscope.pedal = true;
    engine::step(kidney_torso(), inputs, base::kTickS, state_);
    EXPECT_TRUE(state_.fluoroscopy.frame_due);
    state_.needle.skin.tip_lps_mm = tip_lps_mm;
    state_.needle.skin.in_body = true;
  }
  void push(int times) {
    cases::Inputs inputs;
    inputs.event = EventKind::inject;
    for (int i = 0; i < times; ++i) flows_.advance(inputs, state_.needle, base::kTickS, state_.flow);
  }
  void wait(double seconds) {
    for (int i = 0; i < static_cast<int>(seconds / base::kTickS + 0.5); ++i)
      flows_.advance({}, state_.needle, base::kTickS, state_.flow);
  }
  // As the screen shows it.
  GreyPicture picture() { return sight_.picture(state_, 7, {}); }
  // How much darker it is where a place's shadow falls than beside the kidney: the window follows what is in the
  // field.
  double dark_at(const GreyPicture& picture, const glm::dvec3& place_lps_mm) const {
    return grey_at(picture, kBeside) - grey_at(picture, place_lps_mm);
  }
  const cases::State& state() const { return state_; }
  FluoroscopySight& sight() { return sight_; }

 private:
  double grey_at(const GreyPicture& picture, const glm::dvec3& place_lps_mm) const {
    const auto at = imaging::pixel_of(
        imaging::c_arm_geometry(kidney_torso().fluoroscope, state_.fluoroscopy.arm,
                                state_.fluoroscopy.magnification, picture.width_px, kidney_torso().position),
        place_lps_mm);
    double sum = 0.0;
    int count = 0;
    for (int dy = -6; dy <= 6; ++dy)
      for (int dx = -6; dx <= 6; ++dx, ++count)
        sum += picture.grey[static_cast<std::size_t>(std::lround(at->y) + dy) *
                                static_cast<std::size_t>(picture.width_px) +
                            static_cast<std::size_t>(std::lround(at->x) + dx)];
    return sum / count;
  }
  engine::NeedleFlows flows_;
  FluoroscopySight sight_;
  cases::State state_;
};

void lay_into(const GreyPicture& picture, int column, int row, fixtures::RgbPicture& sheet) {
  for (int y = 0; y < picture.height_px; ++y)
    for (int x = 0; x < picture.width_px; ++x)
      for (int c = 0; c < 3; ++c)
        sheet.rgb[3 * static_cast<std::size_t>((row * picture.height_px + y) * sheet.width_px +
                                               column * picture.width_px + x) +
                  static_cast<std::size_t>(c)] = picture.grey[static_cast<std::size_t>(y * picture.width_px + x)];
}

TEST(Nephrostogram, FillsFromTheNeedleOnAndIsRinsed) {
  KidneyPatient patient(kLowerCalyx);
  std::vector<GreyPicture> frames = {patient.picture()};
  patient.push(6);
  for (const double wait_s : {1.0, 2.0, 3.0, 3.0, 3.0}) {
    patient.wait(wait_s);
    frames.push_back(patient.picture());
  }
  EXPECT_NEAR(patient.state().flow.injected_ml, 12.0, 1e-6);
  for (const double wait_s : {900.0, 2700.0}) {
    patient.wait(wait_s);
    frames.push_back(patient.picture());
  }
  const auto gained = [&](std::size_t frame, const glm::dvec3& place) {
    return patient.dark_at(frames[frame], place) - patient.dark_at(frames[0], place);
  };
  // The calyx that the needle is in first, the one above last.
  EXPECT_GT(gained(1, kLowerCalyx), 60.0);
  EXPECT_NEAR(gained(1, kUpperCalyx), 0.0, 15.0);
  for (const glm::dvec3& place : {kLowerCalyx, kPelvis, kUpperCalyx}) {
    EXPECT_GT(gained(5, place), 60.0);
    EXPECT_LT(gained(6, place), gained(5, place));
    EXPECT_LT(gained(7, place), 0.3 * gained(5, place)) << "rinsed by urine, within the hour";
  }
  fixtures::RgbPicture sheet;
  sheet.width_px = 4 * frames[0].width_px;
  sheet.height_px = 2 * frames[0].height_px;
  sheet.rgb.resize(3 * static_cast<std::size_t>(sheet.width_px) * static_cast<std::size_t>(sheet.height_px));
  for (int i = 0; i < 8; ++i) lay_into(frames[static_cast<std::size_t>(i)], i % 4, i / 4, sheet);
  fixtures::write_png(sheet, fixtures::test_out_dir() / "nephrostogram.png");
}

// Open and closed field, without and with what the patient scatters (test-out/scatter.png): once it counts, the
// closed one takes more current for the same signal at the panel.
TEST(Nephrostogram, ACollimatedPictureIsClearer) {
  cases::Case older = kidney_torso();
  older.sight_law = cases::SightLaw::echo;
  KidneyPatient patient(kLowerCalyx);
  patient.push(6);
  patient.wait(12.0);
  fixtures::RgbPicture sheet;
  double ma[2][2] = {};
  int row = 0;
  for (const cases::Case* scene : {&std::as_const(older), &kidney_torso()}) {
    FluoroscopySight sight(*scene);
    for (const int column : {0, 1}) {
      cases::State state = patient.state();
      state.fluoroscopy.magnification = 0;
      if (column == 1) state.fluoroscopy.collimator = {0.35, 0.35};
      for (int i = 0; i < 6; ++i) state.fluoroscopy.last_technique = sight.expose(state, {}).report.next;
      ma[row][column] = state.fluoroscopy.last_technique.ma;
      const GreyPicture picture = sight.picture(state, 7, {});
      sheet.width_px = 2 * picture.width_px;
      sheet.height_px = 2 * picture.height_px;
      sheet.rgb.resize(3 * static_cast<std::size_t>(sheet.width_px) * static_cast<std::size_t>(sheet.height_px));
      lay_into(picture, column, row, sheet);
    }
    ++row;
  }
  EXPECT_GT(ma[1][1] / ma[1][0], 1.1 * ma[0][1] / ma[0][0]);
  fixtures::write_png(sheet, fixtures::test_out_dir() / "scatter.png");
}

// An artery carries contrast off in a moment, fat about the kidney keeps it where it is; the calyx stays as it was.
TEST(Nephrostogram, TheWrongPlaceShowsTheWrongPicture) {
  const auto gained = [](KidneyPatient& patient, const GreyPicture& before, const glm::dvec3& at) {
    return patient.dark_at(patient.picture(), at) - patient.dark_at(before, at);
  };
  const glm::dvec3 along_artery = kArtery + glm::dvec3(-6.0, 1.0, -1.0);
  KidneyPatient artery(kArtery);
  const GreyPicture before = artery.picture();
  artery.push(2);
  artery.wait(3.0);
  const double filled = gained(artery, before, along_artery);
  EXPECT_GT(filled, 8.0) << "as long as it is pushed";
  EXPECT_NEAR(gained(artery, before, kUpperCalyx), 0.0, 15.0);
  artery.wait(4.0);
  EXPECT_NEAR(gained(artery, before, along_artery), 0.0, 0.3 * filled);
  KidneyPatient fat(kPerirenal);
  const GreyPicture empty = fat.picture();
  fat.push(2);
  fat.wait(60.0);
  EXPECT_GT(gained(fat, empty, kPerirenal + glm::dvec3(5.0, 0.0, 0.0)), 60.0);
  EXPECT_NEAR(gained(fat, empty, kUpperCalyx), 0.0, 20.0);
}

// A calyx of urine shows nothing under X-rays, filled it does; and automatic exposure sees what there is.
TEST(Nephrostogram, ATargetShowsOnceItIsFilled) {
  cases::Case scene = kidney_torso();
  scene.lesions.push_back({kUpperCalyx, 4.0, 5.0});
  FluoroscopySight sight(scene);
  KidneyPatient patient(kLowerCalyx);
  const auto before = sight.expose(patient.state(), {});
  EXPECT_FALSE(before.truth.target);
  patient.push(6);
  patient.wait(12.0);
  const auto after = sight.expose(patient.state(), {});
  EXPECT_TRUE(after.truth.target);
  EXPECT_NE(after.report.next, before.report.next);
}

// An attempt in which urine comes back and contrast goes in is recorded, and comes out again tick by tick.
TEST(Nephrostogram, AnAccessWithReturnIsReplayed) {
  const cases::Case& scene = kidney_torso();
  const engine::Tick tick(scene);
  engine::TickState now;
  cases::Recording recording;
  recording.step_version = engine::kStepVersion;
  recording.events.emplace();
  for (int i = 0; i < 12000; ++i) {
    cases::Inputs inputs;
    inputs.needle = {kLowerCalyx + glm::dvec3(0.0, std::max(0.0, 100.0 - 0.02 * i), 0.0), {0, -1, 0}, {1, 0, 0}};
    inputs.fluoroscope.pedal = i > 5500;
    if (i == 4000) inputs.event = EventKind::stylet_out;
    if (i == 8000) inputs.event = EventKind::aspirate;
    if (i == 8000) inputs.event_tenths_mm = cases::tenths_of(now.state.needle.inserted_mm);
    if (i == 8500 || i == 8501) inputs.event = EventKind::inject;
    const cases::RecordedTick made = tick.advance(inputs, recording.dt_s, now);
    recording.inputs.push_back(made.inputs);
    recording.hashes.push_back(made.hash);
    if (made.pose) recording.poses.push_back(*made.pose);
    cases::add_events(now.state.t_s, made, *recording.events);
  }
  EXPECT_EQ(now.state.flow.aspirated, cases::LumenContent::urine);
  EXPECT_NEAR(now.state.flow.injected_ml, 3.5, 0.01);
  EXPECT_EQ(std::count_if(recording.events->begin(), recording.events->end(),
                          [](const cases::Event& event) { return event.kind == EventKind::urine_returns; }),
            1);
  const auto stored = cases::recording_from_chunks(cases::chunks_from_recording(recording));
  ASSERT_TRUE(stored.has_value());
  EXPECT_TRUE(replay(scene, *stored).same);
  cases::Recording other = *stored;
  for (cases::Inputs& inputs : other.inputs)
    if (inputs.event == EventKind::inject) inputs.event = EventKind::none;
  const Replay replayed = replay(scene, other);
  EXPECT_FALSE(replayed.same);
  EXPECT_LT(replayed.first_difference_tick, 8600U) << "from the push on it is another attempt";
}

}  // namespace
}  // namespace seldinger::session
