// Skin of CTs whose field of view cuts the patient, against the skin of the whole patient.
#include <gtest/gtest.h>

#include <cstdio>

#include "casedb/import/import.h"
#include "casedb/import/skin/surface.h"
#include "sim/volume/body_mask.h"
#include "sim/volume/phantom.h"
#include "tests/casedb/import/cuts/cropped.h"
#include "tests/casedb/import/cuts/cut_score.h"
#include "tests/fixtures/shared_data.h"

namespace seldinger::casedb {
namespace {

void expect_true_skin(const std::string& patient, const volume::Volume& whole,
                      const std::vector<volume::Crop>& crops) {
  const auto body = volume::body_mask(whole);
  const auto skin = skin_surface(whole, {.decimate_share = 0.0});
  ASSERT_TRUE(skin);
  const cases::MeshIndex index(*skin);
  for (const volume::Crop& crop : crops) {
    if (getenv("ONLY") && crop.name != getenv("ONLY")) continue;
    const volume::Volume field = volume::cropped(whole, body, crop);
    const auto cut = skin_surface(field);
    ASSERT_TRUE(cut);
    const CutScore score = score_cut(*skin, index, *cut, field);
    std::printf("%-14s %-20s %7zu triangles, skin %8.0f mm2, cut %8.0f, false %6.0f (%.1f mm), lost %.3f\n",
                patient.c_str(), crop.name.c_str(), score.triangles, score.skin_mm2, score.cut_mm2,
                score.false_skin_mm2, score.farthest_mm, score.lost_share);
    std::fflush(stdout);
  }
}

TEST(CutSkin, Torso) {
  expect_true_skin("torso", volume::make_phantom({.spacing_mm = {2, 2, 3}}).volume, volume::crops());
}

TEST(CutSkin, Real) {
  SELDINGER_NEEDS_SHARED_DATA();
  for (const char* name : {"ct-abdomen-pelvis/abdomen_pelvis_2x.mha", "ct-abdomen-contrast-dicom",
                           "ct-thorax-inlet/thorax_inlet_1mm.mha", "ct-neck/neck.nrrd"}) {
    const auto source = read_source(fixtures::shared_data_dir() / name);
    ASSERT_TRUE(source);
    expect_true_skin(std::string(name).substr(0, 14), volume::coarser(source->volume, 2.0), volume::crops());
  }
}

}  // namespace
}  // namespace seldinger::casedb
