// What a case's CT is told to hold, in lines for a person.
#pragma once

#include <string>

#include "sim/volume/tissue/tissue_told.h"

namespace seldinger::app {

// Phase of contrast, share of each class, what is doubtful.
std::string tissue_text(const volume::TissueTold& told);

}  // namespace seldinger::app
