// A case with a target, labels and a drawn structure at home, an empty library away, and a file between them.
#pragma once

#include <string>

#include "casedb/cases/authoring.h"
#include "casedb/keeping/bundle.h"
#include "tests/casedb/bundle_samples.h"
#include "tests/casedb/library_samples.h"

namespace seldinger::casedb {

class BundleTest : public testing::Test {
 protected:
  std::filesystem::path scratch_ = fresh_folder();
  std::filesystem::path file_ = scratch_ / "a.sdbundle";
  Library home_ = open_library(scratch_ / "home"), away_ = open_library(scratch_ / "away");
  std::string case_id_, lesion_id_;

  void SetUp() override {
    NewCase labelled = sample_case();
    labelled.labels = sample_labels();
    case_id_ = add_case(home_, labelled);
    lesion_id_ = add_lesion(home_, case_id_, sample_lesion()).value();
    StructureRow vein;
    vein.case_id = case_id_;
    vein.name = "vein";
    vein.tissue = volume::TissueClass::vessel;
    vein.drawn = cases::Sphere{sample_lesion().center_lps_mm, 0.25};
    vein.hu = 43.0;
    static_cast<void>(add_structure(home_, vein).value());
  }
  void publish() { home_.database().run("UPDATE training_case SET state = 'published'"); }
  void write() { ASSERT_TRUE(write_bundle(home_, {case_id_}, file_, "0.1.0").has_value()); }
  std::string refusal() {
    const auto cases = import_bundle(away_, file_);
    return cases ? "none" : cases.error().code;
  }
};

}  // namespace seldinger::casedb
