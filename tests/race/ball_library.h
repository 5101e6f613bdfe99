// A library that is made in a moment and practised quickly, since everything is ten times slower where races are
// looked for: a ball of soft tissue, once for each modality, and a mentor who may practise it.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "app/case_check.h"
#include "casedb/store.h"
#include "casedb/versions.h"
#include "sim/volume/analytic.h"
#include "tests/fixtures/meshes.h"

namespace seldinger::fixtures {

inline constexpr const char* kBallPassword = "a long password";  // of "mona"
inline constexpr double kBallRadiusMm = 50.0, kBallDepthMm = 25.0;

// Case ids, in the order of the modalities. The folder must not exist.
inline std::vector<std::string> make_ball_library(const std::filesystem::path& folder,
                                                  const std::vector<cases::Modality>& modalities) {
  casedb::Library library = std::move(casedb::Library::open_or_create(folder).value());
  EXPECT_TRUE(casedb::add_user(library, "mona", casedb::Role::mentor, kBallPassword));
  std::vector<std::string> ids;
  for (const cases::Modality modality : modalities) {
    volume::AnalyticVolume analytic;
    analytic.size_voxels = {60, 60, 60};
    analytic.spacing_mm = {2, 2, 2};
    analytic.origin_mm = {-59, -59, -59};
    analytic.shapes.push_back({volume::Sphere{{0, 0, 0}, kBallRadiusMm}, 50.0, ""});
    casedb::NewCase made;
    made.title = "Ball";
    made.origin = "import";
    made.no_burned_in_text = true;
    made.volume = volume::rasterize(analytic);
    made.skin = sphere_mesh({0, 0, 0}, kBallRadiusMm, 4);
    made.modality = modality;
    made.instrument.kind = cases::InstrumentKind::core;
    made.planned_entry_lps_mm = glm::dvec3(0.0, -kBallRadiusMm, 0.0);
    made.difficulty = casedb::Difficulty::easy;
    assessment::Criterion hit;
    hit.metric = "hit";
    hit.value = 1.0;
    made.rule.criteria = {hit};
    ids.push_back(casedb::add_case(library, made));
    cases::Lesion lesion;
    lesion.center_lps_mm = {0.0, kBallDepthMm - kBallRadiusMm, 0.0};
    lesion.radius_mm = 6.0;
    lesion.hu = 20.0;
    EXPECT_TRUE(casedb::add_lesion(library, ids.back(), lesion));
    const auto published =
        casedb::publish_case(library, ids.back(), app::check_case(library, ids.back()).value(), "mona", true);
    EXPECT_TRUE(published) << published.error().text;
  }
  return ids;
}

}  // namespace seldinger::fixtures
