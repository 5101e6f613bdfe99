// Experts on CTs whose field of view cuts the patient: they come through true skin and nowhere else.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <string>

#include "assessment/metrics/quality.h"
#include "assessment/operators/lesion_site.h"
#include "assessment/score.h"
#include "casedb/import/skin/surface.h"
#include "session/attempt/simulated_attempt.h"
#include "session/attempt/simulation.h"
#include "sim/volume/body/body_mask.h"
#include "sim/volume/phantom.h"
#include "tests/casedb/import/cuts/cropped.h"

namespace seldinger::session {
namespace {

// Every crop and 20 seeds in `./run test --long`.
const bool kAllCrops = std::getenv("SELDINGER_REPETITIONS") != nullptr;

TEST(CutCt, ExpertsComeThroughTrueSkin) {
  const volume::Volume torso = volume::make_phantom({.spacing_mm = glm::dvec3(2, 2, 3)}).volume;
  const auto body = volume::body_mask(torso);
  const auto whole = casedb::skin_surface(torso, {.decimate_share = 0.0});
  ASSERT_TRUE(whole);
  const cases::MeshIndex whole_index(*whole);
  const auto expert = assessment::named_profile("expert");
  ASSERT_TRUE(expert);
  int practised = 0;
  for (const volume::Crop& crop :
       kAllCrops ? volume::crops() : volume::crops({"left deep", "front", "circle", "oblique right"})) {
    SCOPED_TRACE(crop.name);
    cases::Case scene;
    scene.volume = volume::cropped(torso, body, crop);
    auto skin = casedb::skin_surface(scene.volume);
    ASSERT_TRUE(skin);
    scene.skin = std::move(*skin);
    scene.skin_index = cases::MeshIndex(scene.skin);
    const auto site = assessment::find_lesion_site(scene.volume, scene.skin_index,
                                                   assessment::lesion_rule(scene.picture.modality, scene.position));
    if (!site) continue;  // refused, with what was found
    ++practised;
    scene.lesions.push_back(site->lesion);
    EXPECT_LT(std::abs(whole_index.closest_skin(site->plan.entry_lps_mm).distance_mm), 3.0);
    for (const SimulatedTrial& trial : simulated_trials(*expert, 1, 1, kAllCrops ? 20 : 2)) {
      const auto scored = assessment::score(scene, run_attempt(scene, site->plan, trial.profile, trial.seed));
      ASSERT_TRUE(scored);
      std::map<std::string, double> value;
      for (const assessment::MetricValue& metric : scored->metrics)
        if (metric.value) value[metric.id] = *metric.value;
      EXPECT_GE(value["skin_punctures"], 1.0);
      EXPECT_EQ(value.at("way_impossible"), 0.0);
      EXPECT_EQ(assessment::why_not_gradable(scored->metrics), "");
    }
  }
  EXPECT_GE(practised, kAllCrops ? 15 : 3);
}

}  // namespace
}  // namespace seldinger::session
