// Every crop of the torso and of the real CTs, fine and coarse.
#include <gtest/gtest.h>

#include <tuple>

#include "casedb/import/import.h"
#include "sim/volume/phantom.h"
#include "tests/casedb/import/cuts/cropped.h"
#include "tests/casedb/import/cuts/cut_score.h"
#include "tests/fixtures/shared_data.h"

namespace seldinger::casedb {
namespace {

void expect_every_crop(const volume::Volume& volume) {
  const WholePatient whole(volume);
  for (const volume::Crop& crop : volume::crops()) expect_true_skin(whole, crop);
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
  expect_every_crop(volume::coarser(source->volume, spacing_mm));
}

INSTANTIATE_TEST_SUITE_P(
    OfTheRealCts, CutCtLong,
    testing::Combine(testing::Values("ct-abdomen-pelvis/abdomen_pelvis_2x.mha", "ct-abdomen-contrast-dicom",
                                     "ct-thorax-inlet/thorax_inlet_1mm.mha", "ct-neck/neck.nrrd"),
                     testing::Values(2.0, 3.0, 5.0)));

}  // namespace
}  // namespace seldinger::casedb
