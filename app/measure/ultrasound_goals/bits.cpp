// The same input, the same bits (15).
#include <algorithm>
#include <cstring>

#include "app/measure/ultrasound_goals/goal.h"
#include "app/measure/ultrasound_goals/needle.h"

namespace seldinger::measure {

void measure_bits(const Setting& setting, Readings& readings) {
  const TissueBlock block = tissue_block(
      [](const glm::dvec3& p) { return p.y < 10.0 ? volume::TissueClass::fat : volume::TissueClass::liver; });
  imaging::UltrasoundView view = setting.view();
  const imaging::Inserted inserted = needle_at(4.0, 30.0, 30.0);
  view.threads = 1;
  const imaging::PolarPicture one = setting.picture(block, view, inserted);
  double differ = 0.0;
  for (const int threads : {1, 2, 3, 7}) {
    view.threads = threads;
    const imaging::PolarPicture again = setting.picture(block, view, inserted);
    for (std::size_t i = 0; i < one.envelope.size(); ++i)
      differ += std::memcmp(&one.envelope[i], &again.envelope[i], sizeof(float)) != 0;
  }
  readings.push_back({15, "samples that differ, again and by 1 to 7 threads", std::string(setting.probe.name),
                      differ, "", 0.0, 0.0});
}

}  // namespace seldinger::measure
