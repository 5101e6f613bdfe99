// What a case's CT is told to hold, in lines for a person.
#pragma once

#include <string>

#include "sim/volume/organs/find_organs.h"
#include "sim/volume/tissue/tissue_told.h"

namespace seldinger::app {

// Phase of contrast, share of each class, what is doubtful.
std::string tissue_text(const volume::TissueTold& told);
// Organs that are named, with how sure that is, those that were looked for in vain, and what was not looked for.
std::string organs_text(const volume::Organs& organs);

}  // namespace seldinger::app
