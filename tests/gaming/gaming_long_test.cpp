// As gaming_test, of all drills and graded cases, with the real CTs.
#include "tests/fixtures/shared_data.h"
#include "tests/gaming/all_players.h"

namespace seldinger::gaming {
namespace {

TEST(Gaming, PassesNoShippedCase) {
  SELDINGER_NEEDS_SHARED_DATA();
  const fixtures::CommandLibrary made(fixtures::fresh_folder("gaming_long"));
  const std::string ct = " --ct " + fixtures::kData;
  ASSERT_EQ(made.ask("demo --cases" + ct + "/ct-abdomen-contrast-dicom" + ct +
                     "/ct-abdomen-pelvis/abdomen_pelvis_2x.mha" + ct + "/ct-thorax-inlet/thorax_inlet_1mm.mha")
                .at("cases")
                .size(),
            8U);
  auto library = casedb::Library::open(made.path());
  ASSERT_TRUE(library.has_value()) << library.error().text;
  expect_only_honest_passes(all_played(*library));
}

}  // namespace
}  // namespace seldinger::gaming
