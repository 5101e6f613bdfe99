// The tables of a raw export as a Frictionless data package: what R's frictionless and Python's frictionless and
// pandas need to read each column as what it is.
#pragma once

#include <string>
#include <vector>

namespace seldinger::reports {

// datapackage.json of those of raw_tables() whose files are named; tables of one file an attempt are not in it.
// Specification: Data Package 1.0 with Table Schema 1.0 (specs.frictionlessdata.io).
std::string data_package(const std::vector<std::string>& files);

}  // namespace seldinger::reports
