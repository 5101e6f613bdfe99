// A case's settings in words, as its page and `case show` have them.
#include "reports/words/case_words.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace seldinger::reports {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string all_of(const casedb::CaseSetting& setting) {
  std::string text;
  for (const SettingFact& one : setting_facts(setting)) text += std::string(one.words) + ": " + one.value + "\n";
  return text;
}

TEST(CaseWords, EverySettingThatHasWordsIsToldOnceSet) {
  casedb::CaseSetting setting;
  EXPECT_THAT(all_of(setting), Not(HasSubstr("INR")));
  EXPECT_THAT(all_of(setting), Not(HasSubstr("Indication")));
  setting.clinic = {
      .inr = 1.4, .platelets_per_nl = 90.0, .allergy = "latex", .indication = "a mass", .defer = true};
  setting.motion.breath_depth = 1.5;
  setting.motion.yields = true;
  setting.difficulty = casedb::Difficulty::hard;
  setting.time_limit_s = 300.0;
  setting.attempt_limit = 5;
  const std::string text = all_of(setting);
  for (const char* line : {"INR: 1.4\n", "Platelets per nl: 90\n", "Allergy: latex\n", "Indication: a mass\n",
                           "Right decision: defer\n", "3 deep): 1.5\n", "Tissue: yields\n", "Difficulty: hard\n",
                           "Time limit, s: 300\n", "Attempts: 5\n", "Needle's tip: bevel\n"})
    EXPECT_THAT(text, HasSubstr(line));
  EXPECT_EQ(setting_facts(setting).size(), casedb::shown_rows(&casedb::SettingRow::page).size());
}

TEST(CaseWords, GuidanceSaysHowThePatientLiesAndWhoChoosesTheProbe) {
  casedb::CaseSetting setting;
  setting.modality = cases::Modality::ultrasound;
  setting.approach = cases::Approach::out_of_plane;
  setting.position = cases::PatientPosition::lateral_left;
  setting.further_modalities = {cases::Modality::mpr};
  EXPECT_EQ(guidance_text(setting), "ultrasound, out of plane, patient lateral left, also mpr");
  setting.probe_is_chosen = true;
  EXPECT_THAT(guidance_text(setting), HasSubstr("the trainee chooses the probe"));
  setting.modality = cases::Modality::xray;
  EXPECT_THAT(guidance_text(setting), Not(HasSubstr("plane"))) << "a C-arm has none";
}

}  // namespace
}  // namespace seldinger::reports
