// Whether a library is whole: its two databases, what they refer to, the files beside them. Texts name ids and
// files of assets/, never a person.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "casedb/database/library.h"
#include "casedb/database/sqlite.h"
#include "sim/base/result.h"

namespace seldinger::casedb {

struct CheckReport {
  // What does not hold: `database_damaged`, `reference_broken`, `asset_missing`, `asset_damaged`, `asset_orphaned`,
  // `incomplete`, `recording_damaged`, `value_damaged`, `leftover_file`, `unknown_file`, `name_without_person`,
  // `audit_changed`, `audit_missing`, `audit_cut`.
  std::vector<base::Problem> findings;
  std::vector<base::Problem> repaired;  // found and taken away
  std::vector<base::Problem> healed;    // found and put back from a backup
  std::vector<base::Problem> accepted;  // found and taken as it is
  std::size_t cases = 0, attempts = 0, assets = 0;
  bool holds() const noexcept { return findings.empty(); }
};

// While others may read and write the library. With `repair`, what is provably nobody's goes: files that no row
// names, found so under the write lock (an import under way stores its file again), and temporary files whose
// writer is gone. With a backup's folder as `from`, what is hurt is put back from it (heal.h). Nothing else is
// changed. Refused as Library::open does, save for `damaged`, which is a finding, and as heal does.
base::Result<CheckReport> check_library(const std::filesystem::path& folder, bool repair,
                                        const std::filesystem::path& from = {});

// Of what the check found, values that are not what was stored are from now on what is stored, each noted in the
// audit log; for when no backup has them. Not of a damaged database, and not the definitions of tables and rules.
void accept_damaged_values(Library& library, CheckReport& report);

// Every page, every reference, every stored value and every recording of one database; empty when all holds.
std::vector<base::Problem> problems_of(Sqlite& database);

}  // namespace seldinger::casedb
