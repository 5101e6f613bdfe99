// A case that a mentor makes, and who may decide about it.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "casedb/cases/authoring.h"
#include "casedb/cases/versions.h"
#include "casedb/people/people.h"
#include "tests/casedb/library_samples.h"
#include "tests/fixtures/sound_check.h"

namespace seldinger::casedb {

class AuthoringTest : public testing::Test {
 protected:
  std::filesystem::path folder_ = fresh_folder() / "library";
  Library library_ = open_library(folder_);
  std::string case_id_ = add_case(library_, sample_case());

  glm::dvec3 middle() const { return sample_lesion().center_lps_mm; }
  StructureRow drawn(const std::string& name, cases::Shape shape) const {
    StructureRow row;
    row.case_id = case_id_;
    row.name = name;
    row.tissue = volume::TissueClass::vessel;
    row.rule = cases::StructureRule::critical;
    row.drawn = std::move(shape);
    row.hu = 43.0;
    return row;
  }
  void add_users() {
    for (const auto& [name, role] : {std::pair{"ann", Role::mentor},
                                     {"ben", Role::mentor},
                                     {"dora", Role::director},
                                     {"adam", Role::admin},
                                     {"tim", Role::trainee}})
      static_cast<void>(add_user(library_, name, role, "a password").value());
  }
  base::Result<void> publish(const char* by, bool own_cohort) {
    return publish_case(library_, case_id_, fixtures::sound_check(library_, case_id_), by, own_cohort);
  }
  CaseState state() { return find_case(library_, case_id_).value().state; }
  void refuse(const std::string& sql) {
    EXPECT_TRUE(refused_by_constraint([&] { library_.database().run(sql); })) << sql;
  }
};

inline std::string code(const base::Result<void>& result) {
  return result ? "none" : result.error().code;
}
inline std::string code(const base::Result<std::string>& result) {
  return result ? "none" : result.error().code;
}

// With every field other than a new case has it.
inline CaseSetting full_setting() {
  CaseSetting setting;
  setting.modality = cases::Modality::ultrasound;
  setting.further_modalities = {cases::Modality::mpr, cases::Modality::xray};
  setting.position = cases::PatientPosition::lateral_left;
  setting.approach = cases::Approach::out_of_plane;
  setting.probe_is_chosen = true;
  setting.touch.tip = cases::NeedleTip::trocar;
  setting.instrument = {cases::InstrumentKind::core, 160.5, 0.635, 0.4, 2900.0, 21.5, 17.5, 3.5};
  setting.clinic = {1.3, 187.0, "latex", "lesion of the liver", true};
  setting.planned_entry_lps_mm = glm::dvec3(1.0 / 3.0, -2.0, 3e-3);
  setting.difficulty = Difficulty::hard;
  setting.time_limit_s = 300.5;
  setting.attempt_limit = 5;
  setting.rule.criteria = {{"core_in_target", 1, assessment::Comparison::at_least, 10.25, false},
                           {"skin_punctures", 2, assessment::Comparison::at_most, 1.0, true}};
  return setting;
}

}  // namespace seldinger::casedb
