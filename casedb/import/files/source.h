// What a reader takes of a CT: int16 HU in LPS and an allow-list of attributes, nothing else of the source.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "casedb/cases/privacy.h"
#include "sim/base/result.h"
#include "sim/volume/volume.h"

namespace seldinger::casedb {

struct Source {
  volume::Volume volume;
  std::vector<std::pair<std::string, std::string>> attributes;  // of the allow-list only
  std::vector<base::Problem> warnings;                          // e.g. single_slice
  std::vector<Dropped> dropped;                                 // what else the source told, counted
  bool says_head = false;                                       // the source says it shows a head: a hint only
  int slices_used = 0;
};

}  // namespace seldinger::casedb
