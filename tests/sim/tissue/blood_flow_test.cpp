// Tests of sim/tissue/blood_flow: which way blood flows, how fast across a vessel and over a beat.
#include "sim/tissue/blood_flow.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

namespace seldinger::tissue {
namespace {

using volume::TissueClass;

cases::Structure tube(const char* name, const glm::dvec3& from, const glm::dvec3& to, double radius_mm = 5.0) {
  return {name, TissueClass::vessel, cases::StructureRule::critical, cases::Tube{{from, to}, radius_mm}};
}

TEST(BloodFlow, RunsWithinItsVesselAsAParabola) {
  const std::vector<cases::Structure> neck = {tube("Carotid_artery", {0, 0, 100}, {0, 0, 0}, 4.0)};
  const BloodFlow flow(neck);
  const FlowLaw* law = flow_law_of(TissueClass::vessel, "Carotid_artery");
  ASSERT_NE(law, nullptr);
  for (const double t_s : {0.0, 0.13, 0.3, 0.8}) {
    const double middle = middle_speed_mm_s(*law, t_s);
    double sum = 0.0;
    for (double off_mm = 0.05; off_mm < 4.0; off_mm += 0.1) {
      const glm::dvec3 v = flow.velocity_mm_s({off_mm, 0.0, 50.0}, t_s);
      EXPECT_NEAR(v.z, middle * (1.0 - off_mm * off_mm / 16.0), 1e-9);
      EXPECT_EQ(v.x, 0.0);
      EXPECT_EQ(v.y, 0.0);
      sum += v.z * 2.0 * off_mm * 0.1 / 16.0;
    }
    EXPECT_NEAR(sum, 0.5 * middle, 2e-3 * std::abs(middle)) << "the mean over the lumen is half the middle's";
  }
  EXPECT_EQ(flow.velocity_mm_s({4.01, 0.0, 50.0}, 0.1), glm::dvec3(0.0));
  EXPECT_EQ(flow.velocity_mm_s({0.0, 0.0, 105.0}, 0.1), glm::dvec3(0.0));
}

// Whichever end it was drawn from.
TEST(BloodFlow, GoesWhereAnatomySendsIt) {
  struct Way {
    const char* name;
    glm::dvec3 towards;
  };
  for (const Way& way :
       {Way{"carotid", {0, 0, 1}}, Way{"common_carotid_artery_left", {0, 0, 1}}, Way{"jugular_vein", {0, 0, -1}},
        Way{"aorta", {0, 0, -1}}, Way{"femoral_artery", {0, 0, -1}}, Way{"femoral_vein", {0, 0, 1}},
        Way{"iliac_vena_right", {0, 0, 1}}, Way{"inferior_vena_cava", {0, 0, 1}},
        Way{"superior_vena_cava", {0, 0, -1}}, Way{"portal_vein", {-1, 0, 0}},
        Way{"hepatic_portal_vein", {-1, 0, 0}}})
    for (const double turned : {-1.0, 1.0}) {
      const std::vector<cases::Structure> one = {
          tube(way.name, -30.0 * turned * way.towards, 30.0 * turned * way.towards)};
      EXPECT_GT(glm::dot(BloodFlow(one).velocity_mm_s(glm::dvec3(0.0), 0.15), way.towards), 100.0) << way.name;
    }
}

TEST(BloodFlow, BeatsInArteriesOnly) {
  for (const char* name : {"carotid", "femoral_artery", "aorta"}) {
    const FlowLaw& law = *flow_law_of(TissueClass::vessel, name);
    double highest = 0.0, lowest = 1e9;
    for (int i = 0; i < 1000; ++i) {
      const double speed = middle_speed_mm_s(law, kBeatS * i / 1000.0);
      EXPECT_NEAR(speed, middle_speed_mm_s(law, kBeatS * (7.0 + i / 1000.0)), 1e-6);
      highest = std::max(highest, speed);
      lowest = std::min(lowest, speed);
    }
    EXPECT_NEAR(highest, law.systole_mm_s, 1.0) << name;
    EXPECT_EQ(lowest<0.0, law.back_share> 0.0) << name;
  }
  const FlowLaw& vein = *flow_law_of(TissueClass::vessel, "jugular_vein");
  EXPECT_EQ(middle_speed_mm_s(vein, 0.1), middle_speed_mm_s(vein, 0.7));
}

// What lies at the wall moves with it, what lies further out less, so that areas around stay what they were.
TEST(BloodFlow, WidensArteriesWithTheBeatAndWhatLiesOnThem) {
  const std::vector<cases::Structure> neck = {tube("carotid", {0, 0, -80}, {0, 0, 80}, 3.5),
                                              tube("jugular_vein", {15, 0, -80}, {15, 0, 80}, 6.0)};
  const BloodFlow flow(neck);
  EXPECT_TRUE(flow.pulsates());
  const Displacement still{};
  EXPECT_EQ(count_sources(flow.with_pulse(still, {0, 0, 5}, 0.0)), 0) << "a beat begins with the CT's";
  double widest = 0.0;
  for (double t_s = 0.02; t_s < kBeatS; t_s += 0.02) {
    const double wider = pulse_share(*flow_law_of(TissueClass::vessel, "carotid"), t_s);
    widest = std::max(widest, wider);
    const Displacement moved = flow.with_pulse(still, {0, 0, 5}, t_s);
    ASSERT_EQ(count_sources(moved), 1) << "the vein does not";
    EXPECT_NEAR(displaced(moved, {0.0, 3.5, 5.0}).y, 3.5 * (1.0 + wider), 1e-5);
    const double out_mm = displaced(moved, {0.0, -9.0, 5.0}).y;
    EXPECT_NEAR(out_mm * out_mm, 81.0 + 3.5 * 3.5 * ((1.0 + wider) * (1.0 + wider) - 1.0), 1e-4);
    EXPECT_NEAR(glm::length(rest_of(moved, displaced(moved, {2.0, 4.0, 0.0})) - glm::dvec3(2.0, 4.0, 0.0)), 0.0,
                1e-3);
  }
  EXPECT_GE(widest, 0.05) << "of a carotid's diameter";
  EXPECT_LE(widest, 0.13);
  EXPECT_EQ(count_sources(flow.with_pulse(still, {0, 0, 300}, 0.2)), 0) << "far away";
  const std::vector<cases::Structure> vein = {neck[1]};
  EXPECT_FALSE(BloodFlow(vein).pulsates());
  // Beside what moves it otherwise: the kinds keep their order, and breath comes last.
  Displacement breathing{};
  breathing.breath_end = 1;
  breathing.source[0].amount.x = 7.0F;
  const Displacement both = flow.with_pulse(breathing, {0, 0, 5}, 0.2);
  EXPECT_EQ(both.shaft_end, 0);
  EXPECT_EQ(both.vein_end, 1);
  EXPECT_EQ(both.breath_end, 2);
  EXPECT_EQ(both.source[1].amount.x, 7.0F);
  // No more than there is room for.
  Displacement full{};
  full.vein_end = full.breath_end = shaders::kMostDisplacementSources;
  EXPECT_EQ(count_sources(flow.with_pulse(full, {0, 0, 5}, 0.2)), shaders::kMostDisplacementSources);
}

TEST(BloodFlow, SaysOfWhichVesselsItKnowsNothing) {
  std::vector<cases::Structure> scene = {tube("carotid", {0, 0, 0}, {0, 0, 50}),
                                         tube("vessel 3", {9, 0, 0}, {9, 0, 50}),
                                         tube("calyx", {20, 0, 0}, {20, 0, 50})};
  scene[2].tissue = TissueClass::fluid;
  scene.push_back({"aorta", TissueClass::vessel, cases::StructureRule::major, cases::Sphere{{0, 50, 0}, 9.0}});
  const BloodFlow flow(scene);
  EXPECT_EQ(flow.names(), std::vector<std::string>{"carotid"});
  EXPECT_EQ(std::vector<std::string>(flow.unknown().begin(), flow.unknown().end()),
            (std::vector<std::string>{"vessel 3", "aorta"}));
  EXPECT_EQ(flow.velocity_mm_s({9, 0, 25}, 0.1), glm::dvec3(0.0));
  EXPECT_EQ(flow_law_of(TissueClass::vessel, "renal_artery"), nullptr);
}

TEST(BloodFlow, OfVesselsThatCrossTheLastDrawnCounts) {
  std::vector<cases::Structure> scene = {tube("carotid", {0, 0, -50}, {0, 0, 50}),
                                         tube("jugular_vein", {0, 0, -50}, {0, 0, 50})};
  EXPECT_LT(BloodFlow(scene).velocity_mm_s(glm::dvec3(0.0), 0.1).z, 0.0);
  std::swap(scene[0], scene[1]);
  EXPECT_GT(BloodFlow(scene).velocity_mm_s(glm::dvec3(0.0), 0.1).z, 0.0);
}

}  // namespace
}  // namespace seldinger::tissue
