#include "tests/casedb/import/outlined/outlined_bones.h"

#include <fstream>
#include <sstream>

#include "tests/fixtures/places.h"

namespace seldinger::casedb {

std::vector<OutlinedSlice> outlined_slices() {
  std::vector<OutlinedSlice> slices;
  std::ifstream text(fixtures::source_dir() / "tests/casedb/import/outlined/outlined_bones.txt");
  for (std::string line; std::getline(text, line);) {
    std::istringstream words(line);
    std::string kind;
    words >> kind;
    if (kind == "#") continue;
    if (kind == "slice") {
      OutlinedSlice& made = slices.emplace_back();
      words >> made.ct >> made.slice >> made.low.x >> made.low.y >> made.high.x >> made.high.y;
      continue;
    }
    std::istringstream corners(line.substr(line.find(':') + 1));
    Outline outline;
    for (glm::dvec2 p; corners >> p.x >> p.y;) outline.push_back(p);
    OutlinedSlice& of = slices.back();
    (kind == "bone" ? of.bones : kind == "hole" ? of.holes : of.doubtful).push_back(std::move(outline));
  }
  return slices;
}

}  // namespace seldinger::casedb
