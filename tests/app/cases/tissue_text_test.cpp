// What import and `case explain` tell of a CT's tissue, in words.
#include "app/cases/tissue_text.h"

#include <gtest/gtest.h>

namespace seldinger::app {
namespace {

TEST(TissueText, PhaseSharesAndDoubtsAreLines) {
  volume::TissueTold told;
  told.contrast = {volume::ContrastPhase::venous, 176, false};
  told.share[static_cast<std::size_t>(volume::TissueClass::fat)] = 0.7512;
  told.share[static_cast<std::size_t>(volume::TissueClass::soft_tissue)] = 0.2468;
  told.share[static_cast<std::size_t>(volume::TissueClass::metal)] = 0.002;
  told.doubts = {"metal streaks what lies beside it, whose classes are guesses"};
  EXPECT_EQ(tissue_text(told),
            "contrast venous phase: 30 ml of blood and organs are at 176 HU or more\n"
            "tissue   fat 75 %, soft tissue 25 %, metal < 1 %\n"
            "doubtful: metal streaks what lies beside it, whose classes are guesses\n");
  told.contrast = {volume::ContrastPhase::none, 60, false};
  EXPECT_TRUE(tissue_text(told).starts_with("contrast none\n"));
}

TEST(TissueText, OrgansAreNamedDoubtedOrNotLookedFor) {
  volume::Organs organs;
  organs.found = {{volume::FoundOrgan::spleen, 0.986, 301.4, 95}, {volume::FoundOrgan::liver, 0.31, 1500.0, 110}};
  EXPECT_EQ(organs_text(organs),
            "organs   spleen (301 ml, 99 % sure)\n"
            "not found, or not sure enough to name: liver, right kidney, left kidney, right lung, left lung, "
            "vertebrae, ribs, "
            "aorta, vena cava, bladder, gallbladder\n"
            "not looked for: heart, stomach, bowel, pancreas and whatever else is not listed\n");
  EXPECT_TRUE(organs_text({}).starts_with("organs   none is sure enough to be named\n"));
}

}  // namespace
}  // namespace seldinger::app
