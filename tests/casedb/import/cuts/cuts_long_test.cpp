// Every crop of the torso and of the real CTs, fine and coarse.
#include <gtest/gtest.h>

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

TEST(CutSkinLong, OfTheTorsoAtEverySpacing) {
  const volume::Volume torso = volume::make_phantom({.spacing_mm = glm::dvec3(1, 1, 1)}).volume;
  for (const double spacing_mm : {1.0, 2.0, 3.0, 5.0}) {
    SCOPED_TRACE(spacing_mm);
    expect_every_crop(volume::coarser(torso, spacing_mm));
  }
}

TEST(CutSkinLong, OfTheRealCts) {
  SELDINGER_NEEDS_SHARED_DATA();
  for (const char* name : {"ct-abdomen-pelvis/abdomen_pelvis_2x.mha", "ct-abdomen-contrast-dicom",
                           "ct-thorax-inlet/thorax_inlet_1mm.mha", "ct-neck/neck.nrrd"}) {
    const auto source = read_source(fixtures::shared_data_dir() / name);
    ASSERT_TRUE(source);
    SCOPED_TRACE(name);
    for (const double spacing_mm : {2.0, 3.0, 5.0}) expect_every_crop(volume::coarser(source->volume, spacing_mm));
  }
}

}  // namespace
}  // namespace seldinger::casedb
