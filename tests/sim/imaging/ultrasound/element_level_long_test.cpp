// Goal 16 on a hundred thousand scatterers.
#include "app/measure/ultrasound_goals/elements.h"

#include "tests/sim/imaging/ultrasound/ultrasound_scene.h"

namespace seldinger::imaging {
namespace {

TEST(Goal16Long, AHundredThousandScatterers) {
  for (const auto& [probe, length_mm, lines] :
       std::vector<std::tuple<Probe, double, int>>{{kC52v, 32.0, 16}, {kL115v, 16.0, 24}}) {
    const measure::Setting setting = practised(probe);
    const measure::Likeness found = measure::likeness_to_elements(setting, measure::Apodisation::even, 0.0,
                                                                  {0.5 * setting.depth_mm(), length_mm, lines});
    printf("goal 16: %s: NCC %.4f of %zu scatterers\n", std::string(probe.name).c_str(), found.ncc,
           found.scatterers);
    EXPECT_GE(found.ncc, 0.9);
    EXPECT_GE(found.scatterers, 100000U);
  }
}

}  // namespace
}  // namespace seldinger::imaging
