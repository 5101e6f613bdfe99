// Whether a library is whole: its two databases, what they refer to, the files beside them. Texts name ids and
// files of assets/, never a person.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "casedb/database/sqlite.h"
#include "sim/base/result.h"

namespace seldinger::casedb {

struct CheckReport {
  // What does not hold: `database_damaged`, `reference_broken`, `asset_missing`, `asset_damaged`, `asset_orphaned`,
  // `incomplete`, `recording_damaged`, `leftover_file`, `unknown_file`, `name_without_person`, `audit_changed`,
  // `audit_missing`, `audit_cut`.
  std::vector<base::Problem> findings;
  std::vector<base::Problem> repaired;  // found and mended
  std::size_t cases = 0, attempts = 0, assets = 0;
  bool holds() const noexcept { return findings.empty(); }
};

// While others may read and write the library. With `repair`, what is provably nobody's goes: files that no row
// names, found so under the write lock (an import under way stores its file again), and temporary files whose
// writer is gone. Nothing else is changed. Refused as Library::open does, save for `damaged`, which is a finding.
base::Result<CheckReport> check_library(const std::filesystem::path& folder, bool repair);

// Every page and every reference of one database; empty when all holds.
std::vector<base::Problem> problems_of(Sqlite& database);

}  // namespace seldinger::casedb
