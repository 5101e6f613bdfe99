// Every crop of the torso and of the real CTs, fine and coarse.
#include <gtest/gtest.h>

#include <string_view>
#include <tuple>

#include "casedb/import/import.h"
#include "sim/volume/phantom.h"
#include "tests/casedb/import/cuts/cropped.h"
#include "tests/casedb/import/cuts/cut_score.h"
#include "tests/fixtures/shared_data.h"

namespace seldinger::casedb {
namespace {

// `pocket_in_front`: a face in front shuts the room's air between neck and shoulder into a pocket, which is no
// other than a bowel's that it cuts (docs/decisions/0060).
void expect_every_crop(const volume::Volume& volume, bool pocket_in_front = false) {
  constexpr double kLost = 0.01, kLostInPockets = 0.45, kLostWhereItGrazes = 1.0;
  const WholePatient whole(volume);
  for (const volume::Crop& crop : volume::crops()) {
    const bool front = crop.faces[2] > 0.0 || (crop.beyond && crop.beyond->y < 0.0);
    const bool grazes = crop.name == "circle narrow";
    expect_true_skin(whole, crop, grazes ? kLostWhereItGrazes : pocket_in_front && front ? kLostInPockets : kLost);
  }
}

class CutTorsoLong : public testing::TestWithParam<double> {};

TEST_P(CutTorsoLong, EveryCropKeepsTrueSkin) {
  const volume::Volume torso = volume::make_phantom({.spacing_mm = glm::dvec3(1.0)}).volume;
  expect_every_crop(volume::coarser(torso, GetParam()));
}

INSTANTIATE_TEST_SUITE_P(Spacings, CutTorsoLong, testing::Values(1.0, 2.0, 3.0, 5.0));

class CutCtLong : public testing::TestWithParam<std::tuple<const char*, double>> {};

TEST_P(CutCtLong, EveryCropKeepsTrueSkin) {
  SELDINGER_NEEDS_SHARED_DATA();
  const auto& [name, spacing_mm] = GetParam();
  const auto source = read_source(fixtures::shared_data_dir() / name);
  ASSERT_TRUE(source);
  expect_every_crop(volume::coarser(source->volume, spacing_mm),
                    std::string_view(name) == "ct-thorax-inlet/thorax_inlet_1mm.mha");
}

INSTANTIATE_TEST_SUITE_P(
    OfTheRealCts, CutCtLong,
    testing::Combine(testing::Values("ct-abdomen-pelvis/abdomen_pelvis_2x.mha", "ct-abdomen-contrast-dicom",
                                     "ct-thorax-inlet/thorax_inlet_1mm.mha", "ct-neck/neck.nrrd"),
                     testing::Values(2.0, 3.0, 5.0)));

}  // namespace
}  // namespace seldinger::casedb
