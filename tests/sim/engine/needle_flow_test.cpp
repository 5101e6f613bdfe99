// Tests of sim/engine/needle_flow and sim/tissue/lumens: what runs back through an open needle, and where contrast
// goes.
#include "sim/engine/needle_flow.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "sim/engine/tick.h"
#include "tests/fixtures/allocations.h"
#include "tests/fixtures/meshes.h"

namespace seldinger::engine {
namespace {

using cases::EventKind;
using cases::LumenContent;
using volume::TissueClass;

// A body 200 mm across: a calyx that a duct joins to a pelvis, a vein, an artery and a gallbladder apart from them.
cases::Case body_with_lumens() {
  cases::Case scene;
  scene.skin = fixtures::sphere_mesh({0, 0, 0}, 100.0, 5);
  scene.skin_index = cases::MeshIndex(scene.skin);
  scene.volume = volume::make_volume({121, 121, 121}, glm::dvec3(1.0), glm::dmat3(1.0), glm::dvec3(-60.0));
  scene.instrument.radius_mm = 0.635;  // 18 gauge: a bore of 0.838 mm
  scene.structures = {
      {"calyx", TissueClass::fluid, cases::StructureRule::target, cases::Sphere{{0, -20, 0}, 6.0}},
      {"renal_pelvis", TissueClass::fluid, cases::StructureRule::major, cases::Sphere{{0, 10, 0}, 10.0}},
      {"collecting_system", TissueClass::fluid, cases::StructureRule::advisory,
       cases::Tube{{{0, -16, 0}, {0, 4, 0}}, 2.0}},
      {"portal_vein", TissueClass::vessel, cases::StructureRule::critical,
       cases::Tube{{{40, -40, 0}, {40, 40, 0}}, 5.0}},
      {"interlobar_artery", TissueClass::vessel, cases::StructureRule::critical,
       cases::Tube{{{-40, -20, 0}, {-40, 20, 0}}, 3.0}},
      {"gallbladder", TissueClass::fluid, cases::StructureRule::critical, cases::Sphere{{0, 0, 40}, 12.0}},
      {"liver", TissueClass::liver, cases::StructureRule::organ, cases::Sphere{{0, 0, 40}, 18.0}},
  };
  return scene;
}

const glm::dvec3 kInCalyx{0, -20, 0}, kInVein{40, 0, 0}, kInArtery{-40, 0, 0}, kInGallbladder{0, 0, 40},
    kInTissue{20, 30, -30};

// Holds the needle's tip somewhere.
struct FlowTrial {
  explicit FlowTrial(const cases::Case& scene) : flows(scene) {}
  void tick(EventKind event = EventKind::none, double length_mm = 0.0) {
    cases::Inputs inputs;
    inputs.event = event;
    inputs.event_tenths_mm = cases::tenths_of(length_mm);
    flows.advance(inputs, needle, 0.001, flow);
  }
  void wait(double seconds) {
    for (int i = 0; i < static_cast<int>(seconds * 1000.0 + 0.5); ++i) tick();
  }
  FlowTrial& at(const glm::dvec3& tip_lps_mm) {
    needle.skin.tip_lps_mm = tip_lps_mm;
    needle.skin.in_body = true;
    return *this;
  }
  // Until something new is at the hub; +∞: not within so many seconds.
  double flash_s(LumenContent content, double most_s) {
    for (int i = 1; i <= static_cast<int>(most_s * 1000.0); ++i) {
      tick();
      if (flow.at_hub == content) return 0.001 * i;
    }
    return INFINITY;
  }
  double in_pools_ml() const {
    double sum = 0.0;
    for (const cases::ContrastPool& pool : flow.pools) sum += pool.contrast_ml;
    return sum;
  }
  NeedleFlows flows;
  cases::NeedleState needle;
  cases::NeedleFlow flow;
};

TEST(Lumens, AreToldByClassAndName) {
  using tissue::content_of;
  EXPECT_EQ(content_of(TissueClass::fluid, "Lower calyx"), LumenContent::urine);
  EXPECT_EQ(content_of(TissueClass::fluid, "bladder"), LumenContent::urine);
  EXPECT_EQ(content_of(TissueClass::fluid, "gallbladder"), LumenContent::bile);
  EXPECT_EQ(content_of(TissueClass::fluid, "common_bile_duct"), LumenContent::bile);
  EXPECT_EQ(content_of(TissueClass::fluid, "bilateral renal pelvis"), LumenContent::urine);
  EXPECT_EQ(content_of(TissueClass::fluid, "abscess"), LumenContent::fluid);
  EXPECT_EQ(content_of(TissueClass::vessel, "vena_cava"), LumenContent::venous_blood);
  EXPECT_EQ(content_of(TissueClass::vessel, "carotid"), LumenContent::arterial_blood);
  EXPECT_EQ(content_of(TissueClass::kidney, "calyx"), LumenContent::none);
}

TEST(Lumens, OfOneContentThatTouchAreOneOfTheirVolume) {
  const cases::Case scene = body_with_lumens();
  const tissue::Lumens lumens(scene);
  EXPECT_EQ(lumens.all().size(), 4U);
  EXPECT_EQ(lumens.at(kInCalyx), lumens.at({0, 10, 0}));
  EXPECT_EQ(lumens.at(kInTissue), -1);
  EXPECT_EQ(lumens.at({500, 0, 0}), -1);
  const tissue::Lumen* urine = lumens.find(lumens.at(kInCalyx));
  ASSERT_NE(urine, nullptr);
  // Two balls and the duct between them, to a percent of voxels.
  const double pi = std::numbers::pi;
  const double expected_ml = (4.0 / 3.0 * pi * (6.0 * 6.0 * 6.0 + 1000.0) + pi * 4.0 * 14.2) / 1000.0;
  EXPECT_NEAR(urine->volume_ml, expected_ml, 0.02 * expected_ml);
  EXPECT_EQ(lumens.find(99), nullptr);
}

TEST(NeedleFlow, NothingHappensUntilTheNeedleIsOpened) {
  const cases::Case scene = body_with_lumens();
  FlowTrial trial(scene);
  trial.at(kInArtery).wait(2.0);
  trial.tick(EventKind::aspirate);  // of before it had a length
  EXPECT_FALSE(trial.flow.in_use);
  cases::Case core = body_with_lumens();
  core.instrument.kind = cases::InstrumentKind::core;
  FlowTrial closed(core);
  closed.at(kInArtery).tick(EventKind::stylet_out);
  closed.tick(EventKind::inject);
  EXPECT_FALSE(closed.flow.in_use);
  closed.tick(EventKind::aspirate, 60.0);
  EXPECT_EQ(closed.flow.aspirated, LumenContent::arterial_blood) << "through a needle of its own";
}

// The closed form: the bore's volume over what Hagen and Poiseuille let through.
TEST(NeedleFlow, TheLumenIsToldByWhatReturnsAndWhen) {
  const cases::Case scene = body_with_lumens();
  const double r_m = 0.419e-3, l_m = 0.2, pi = std::numbers::pi;
  const auto expected_s = [&](double pressure_pa, double viscosity_pa_s) {
    return pi * r_m * r_m * l_m / (pi * r_m * r_m * r_m * r_m * pressure_pa / (8.0 * viscosity_pa_s * l_m));
  };
  struct Row {
    glm::dvec3 at;
    LumenContent content;
    double pressure_pa, viscosity_pa_s;
  };
  for (const Row& row : {Row{kInCalyx, LumenContent::urine, 980.665, 0.69e-3},
                         Row{kInGallbladder, LumenContent::bile, 980.665, 0.69e-3},
                         Row{kInVein, LumenContent::venous_blood, 666.61, 3.0e-3},
                         Row{kInArtery, LumenContent::arterial_blood, 12398.9, 3.0e-3}}) {
    FlowTrial trial(scene);
    trial.at(row.at).tick(EventKind::stylet_out);
    EXPECT_NEAR(trial.flash_s(row.content, 30.0), expected_s(row.pressure_pa, row.viscosity_pa_s), 0.01);
  }
  FlowTrial dry(scene);
  dry.at(kInTissue).tick(EventKind::stylet_out);
  dry.wait(5.0);
  EXPECT_EQ(dry.flow.at_hub, LumenContent::none);
  dry.at(kInCalyx);
  EXPECT_LT(dry.flash_s(LumenContent::urine, 5.0), 3.0);
  dry.tick(EventKind::stylet_in);
  EXPECT_EQ(dry.flow.at_hub, LumenContent::none);
}

TEST(NeedleFlow, ContrastIsConservedAndFillsTheLumenFromTheTipOn) {
  const cases::Case scene = body_with_lumens();
  for (const glm::dvec3& place : {kInCalyx, kInVein, kInArtery, kInGallbladder, kInTissue}) {
    FlowTrial trial(scene);
    trial.at(place).tick(EventKind::inject);
    trial.tick(EventKind::inject);
    for (int i = 0; i < 20; ++i) {
      trial.wait(0.5);
      EXPECT_NEAR(trial.in_pools_ml() + trial.flow.carried_away_ml, trial.flow.injected_ml, 1e-9);
    }
    EXPECT_NEAR(trial.flow.injected_ml, 4.0, 1e-9);
    EXPECT_EQ(trial.flow.syringe_ml, 0.0);
  }
  // The system holds 5.3 ml: what was injected is in it, but for what urine carries on.
  FlowTrial calyx(scene);
  calyx.at(kInCalyx).tick(EventKind::inject);
  calyx.wait(2.0);
  EXPECT_NEAR(calyx.in_pools_ml(), 2.0, 0.02);
  EXPECT_NEAR(calyx.flow.pools[0].spread_ml, 2.0, 0.02);
  EXPECT_GT(concentration(calyx.flow.pools[0]), 0.98);
}

// The tank's closed form, once it is full: exponential, by inflow over volume.
TEST(NeedleFlow, AFullLumenIsRinsedExponentially) {
  const cases::Case scene = body_with_lumens();
  FlowTrial trial(scene);
  trial.at(kInCalyx);
  for (int i = 0; i < 5; ++i) trial.tick(EventKind::inject);
  trial.wait(10.0);
  const double full_ml = trial.in_pools_ml();
  const tissue::Lumen& lumen = *trial.flows.lumens().find(trial.flow.pools[0].lumen);
  EXPECT_NEAR(trial.flow.pools[0].spread_ml, lumen.volume_ml, 1e-9);
  trial.wait(300.0);
  EXPECT_NEAR(trial.in_pools_ml() / full_ml, std::exp(-300.0 * lumen.inflow_ml_s / lumen.volume_ml), 1e-3);
}

TEST(NeedleFlow, BloodTakesContrastAlongAndTissueKeepsIt) {
  const cases::Case scene = body_with_lumens();
  FlowTrial vein(scene);
  vein.at(kInVein).tick(EventKind::inject);
  vein.wait(1.5);
  EXPECT_GT(vein.in_pools_ml(), 0.1);
  EXPECT_LT(concentration(vein.flow.pools[0]), 0.15) << "thinned by what flows by";
  vein.wait(5.0);
  EXPECT_EQ(vein.in_pools_ml(), 0.0) << "gone five seconds later";
  FlowTrial tissue(scene);
  tissue.at(kInTissue).tick(EventKind::inject);
  tissue.wait(60.0);
  EXPECT_NEAR(tissue.in_pools_ml(), 2.0, 1e-9);
  EXPECT_EQ(tissue.flow.pools[0].lumen, -1);
}

TEST(NeedleFlow, OutsideTheBodyContrastDripsAway) {
  const cases::Case scene = body_with_lumens();
  FlowTrial trial(scene);
  trial.tick(EventKind::inject);
  trial.wait(3.0);
  EXPECT_EQ(trial.flow.injected_ml, 0.0);
  EXPECT_EQ(trial.in_pools_ml(), 0.0);
}

// The weakest makes room for a fifth.
TEST(NeedleFlow, FourDepotsAreRemembered) {
  const cases::Case scene = body_with_lumens();
  FlowTrial trial(scene);
  for (int i = 0; i < 6; ++i) {
    trial.at({-30.0 + 12.0 * i, 45.0, -30.0}).tick(EventKind::inject);
    trial.wait(3.0);
  }
  EXPECT_NEAR(trial.in_pools_ml(), 8.0, 1e-9);
  EXPECT_NEAR(trial.flow.carried_away_ml, 4.0, 1e-9);
}

// The whole tick: return is told as the patient's, the same again for the same inputs, and an attempt goes on from
// what was saved of it.
TEST(NeedleFlow, IsToldSavedAndReplayed) {
  const cases::Case scene = body_with_lumens();
  const Tick tick(scene);
  const auto inputs_at = [](int i) {
    cases::Inputs inputs;
    inputs.needle = {{0.0, std::min(-20.0, -110.0 + 0.05 * i), 0.0}, {0, 1, 0}, {1, 0, 0}};
    if (i == 2500) inputs.event = EventKind::stylet_out;
    if (i == 6000) inputs.event = EventKind::inject;
    return inputs;
  };
  const auto run = [&](TickState now, int from, int to, std::vector<EventKind>& told) {
    for (int i = from; i < to; ++i) {
      const cases::RecordedTick made = tick.advance(inputs_at(i), 0.001, now);
      if (made.reaction != EventKind::none) told.push_back(made.reaction);
    }
    return now;
  };
  std::vector<EventKind> told, again, rest;
  const TickState whole = run({}, 0, 9000, told);
  EXPECT_EQ(told, (std::vector<EventKind>{EventKind::pain_skin, EventKind::urine_returns}));
  EXPECT_NEAR(whole.state.flow.injected_ml, 2.0, 1e-9);
  const auto half = restored(saved(run({}, 0, 7000, again)));
  ASSERT_TRUE(half.has_value());
  const TickState resumed = run(*half, 7000, 9000, rest);
  EXPECT_EQ(resumed.hash, whole.hash);
  EXPECT_EQ(tick_state_hash(resumed), tick_state_hash(whole));
}

TEST(NeedleFlow, AllocatesNothing) {
  const cases::Case scene = body_with_lumens();
  FlowTrial trial(scene);
  trial.at(kInCalyx);
  const long before = fixtures::allocations();
  trial.tick(EventKind::inject);
  trial.wait(3.0);
  trial.tick(EventKind::aspirate, 80.0);
  EXPECT_EQ(fixtures::allocations(), before);
}

}  // namespace
}  // namespace seldinger::engine
