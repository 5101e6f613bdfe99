// Experts on CTs whose field of view cuts the patient: they come through true skin and nowhere else.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "assessment/metrics/quality.h"
#include "assessment/operators/lesion_site.h"
#include "assessment/score.h"
#include "casedb/import/import.h"
#include "casedb/import/skin/surface.h"
#include "session/attempt/simulated_attempt.h"
#include "session/attempt/simulation.h"
#include "sim/volume/body/body_mask.h"
#include "sim/volume/phantom.h"
#include "tests/casedb/import/cuts/cropped.h"
#include "tests/fixtures/shared_data.h"

namespace seldinger::session {
namespace {

// Every crop, the real CTs too, and 20 seeds in `./run test --long`.
const bool kAllCrops = std::getenv("SELDINGER_REPETITIONS") != nullptr;
const int kSeeds = kAllCrops ? std::atoi(std::getenv("SELDINGER_REPETITIONS")) : 2;

// The whole patient, of whom crops are made.
struct Patient {
  explicit Patient(volume::Volume of) : volume(std::move(of)), body(volume::body_mask(volume)) {
    auto skin = casedb::skin_surface(volume, {.decimate_share = 0.0});
    EXPECT_TRUE(skin);
    if (skin) skin_index = cases::MeshIndex(*skin);
  }
  volume::Volume volume;
  std::vector<std::uint8_t> body;
  cases::MeshIndex skin_index;
};

cases::Case scene_of(volume::Volume field) {
  cases::Case scene;
  scene.volume = std::move(field);
  auto skin = casedb::skin_surface(scene.volume);
  EXPECT_TRUE(skin);
  if (skin) scene.skin = std::move(*skin);
  scene.skin_index = cases::MeshIndex(scene.skin);
  return scene;
}

void expect_attempts_through_skin(const cases::Case& scene, const assessment::PuncturePlan& plan) {
  const auto expert = assessment::named_profile("expert");
  ASSERT_TRUE(expert);
  for (const SimulatedTrial& trial : simulated_trials(*expert, 1, 1, kSeeds)) {
    const auto scored = assessment::score(scene, run_attempt(scene, plan, trial.profile, trial.seed));
    ASSERT_TRUE(scored);
    std::map<std::string, double> value;
    for (const assessment::MetricValue& metric : scored->metrics)
      if (metric.value) value[metric.id] = *metric.value;
    EXPECT_GE(value["skin_punctures"], 1.0) << trial.seed;
    EXPECT_EQ(value.at("way_impossible"), 0.0) << trial.seed;
    EXPECT_EQ(assessment::why_not_gradable(scored->metrics), "") << trial.seed;
  }
}

// How many crops are practised; the others are refused, for no skin is within reach of a target.
int practised(const Patient& whole, const std::vector<volume::Crop>& crops) {
  int count = 0;
  for (const volume::Crop& crop : crops) {
    SCOPED_TRACE(crop.name);
    cases::Case scene = scene_of(volume::cropped(whole.volume, whole.body, crop));
    const auto site = assessment::find_lesion_site(scene.volume, scene.skin_index,
                                                   assessment::lesion_rule(scene.picture.modality, scene.position));
    if (kAllCrops) std::printf("%-24s %s\n", crop.name.c_str(), site ? "practised" : site.error().code.c_str());
    std::fflush(stdout);
    if (!site) continue;
    ++count;
    scene.lesions.push_back(site->lesion);
    const double voxel_mm =
        std::max({scene.volume.spacing_mm.x, scene.volume.spacing_mm.y, scene.volume.spacing_mm.z});
    EXPECT_LE(std::abs(whole.skin_index.closest_skin(site->plan.entry_lps_mm).distance_mm), voxel_mm);
    expect_attempts_through_skin(scene, site->plan);
  }
  return count;
}

TEST(CutCt, ExpertsComeThroughTrueSkin) {
  const Patient whole(volume::make_phantom({.spacing_mm = glm::dvec3(2, 2, 3)}).volume);
  const auto crops = kAllCrops ? volume::crops() : volume::crops({"left deep", "circle", "oblique right"});
  EXPECT_GE(practised(whole, crops), kAllCrops ? 30 : 2);
}

struct RealCt {
  const char* path;
  int least_practised;  // of all crops
};
class CutRealCt : public testing::TestWithParam<RealCt> {};

TEST_P(CutRealCt, ExpertsComeThroughTrueSkin) {
  SELDINGER_NEEDS_SHARED_DATA();
  const auto source = casedb::read_source(fixtures::shared_data_dir() / GetParam().path);
  ASSERT_TRUE(source);
  EXPECT_GE(practised(Patient(volume::coarser(source->volume, 3.0)),
                      kAllCrops ? volume::crops() : volume::crops({"left"})),
            kAllCrops ? GetParam().least_practised : 1);
}

std::vector<RealCt> real_cts() {
  std::vector<RealCt> all{{"ct-abdomen-contrast-dicom", 40}};
  if (kAllCrops)
    all.insert(all.end(), {{"ct-abdomen-pelvis/abdomen_pelvis_2x.mha", 40},
                           {"ct-neck/neck.nrrd", 40},
                           {"ct-thorax-inlet/thorax_inlet_1mm.mha", 25}});
  return all;
}
INSTANTIATE_TEST_SUITE_P(CutCt, CutRealCt, testing::ValuesIn(real_cts()));

}  // namespace
}  // namespace seldinger::session
