// An export's tables as one SQLite file: the same cells with the same names, typed, with keys between them.
#pragma once

#include <filesystem>

namespace seldinger::reports {

// Reads the CSV files of `folder`, an export's, and writes `folder`/export.sqlite. A table for each of
// raw_tables(), STRICT: text TEXT, number REAL, integer and flag INTEGER; poses, forces and frames of all attempts
// in one each; and data_dictionary. Of an export without events, or without recordings, their tables are empty.
void write_sqlite_tables(const std::filesystem::path& folder);

}  // namespace seldinger::reports
