// Attempts for REDCap: a data dictionary for its Dictionary Upload; attempts.csv is then its Data Import.
#pragma once

#include <string>

namespace seldinger::reports {

// One instrument, `attempts`, with a field for each column of attempts.csv, in their order: the first, `attempt`,
// is the record. CSV with REDCap's 18 columns.
std::string redcap_dictionary();

}  // namespace seldinger::reports
