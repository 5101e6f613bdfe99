#include "app/measure/goals/goals_answer.h"

#include <cmath>
#include <cstdio>

namespace seldinger::measure {

const char* name_of(imaging::UltrasoundMethod method) noexcept {
  return method == imaging::UltrasoundMethod::scatterers ? "scatterers"
         : method == imaging::UltrasoundMethod::lattice  ? "lattice"
                                                         : "thesis";
}

std::string goals_table(const GoalsOfMethod& measured) {
  char line[256];
  std::snprintf(line, sizeof line, "%s, %s\n%2s  %-49s %-13s %10s %-12s %7s %9s %8s\n", measured.method.c_str(),
                measured.quality == Quality::fast ? "fast" : "reference", "", "how far off", "probe", "measured",
                "", "fast", "reference", "of it");
  std::string text = line;
  int held = 0;
  for (const Reading& reading : measured.readings) {
    const double share = reading.share(measured.quality);
    const bool holds = reading.holds(measured.quality);
    held += holds;
    char measured_text[32], share_text[32];
    std::snprintf(measured_text, sizeof measured_text, std::isfinite(reading.off) ? "%.4g" : "none", reading.off);
    std::snprintf(share_text, sizeof share_text, std::isfinite(share) ? "%.2f" : "-", share);
    std::snprintf(line, sizeof line, "%2d  %-49s %-13s %10s %-12s %7g %9g %8s  %s\n", reading.goal,
                  reading.what.c_str(), reading.probe.c_str(), measured_text, reading.unit, reading.fast,
                  reading.reference, share_text, holds ? "holds" : "MISSED");
    text += line;
  }
  std::snprintf(line, sizeof line, "%d of %zu hold.\n\n", held, measured.readings.size());
  return text + line;
}

std::string goals_table(const std::vector<ForceReading>& readings) {
  char line[256];
  std::snprintf(line, sizeof line, "%-42s %-9s %10s %-6s %s\n", "", "of", "measured", "", "goal");
  std::string text = line;
  int held = 0;
  for (const ForceReading& reading : readings) {
    held += reading.holds();
    std::snprintf(line, sizeof line, "%-42s %-9s %10.3g %-6s %s %g  %s\n", reading.what, reading.where,
                  reading.measured, reading.unit, reading.at_least ? "at least" : "at most", reading.limit,
                  reading.holds() ? "holds" : "MISSED");
    text += line;
  }
  std::snprintf(line, sizeof line, "%d of %zu hold.\n", held, readings.size());
  return text + line;
}

}  // namespace seldinger::measure
