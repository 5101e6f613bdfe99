// Cases out of one library and into another, as one checked file (casedb/keeping/bundle_file.h): the case, what is
// said of it, its targets and its files. No person, no account and no attempt is ever in it. Throws base::Failure
// ("disk", "database").
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "casedb/database/library.h"
#include "sim/base/result.h"

namespace seldinger::casedb {

struct Bundle {
  int schema = 0;
  std::string program_version;
  std::vector<std::string> case_ids;
  std::size_t assets = 0;
  std::uint64_t bytes = 0;  // of the file
};

// Whole under `out`, or nothing is there. No ids: every case. Refused: `no_case`, `asset_missing`, `asset_damaged`,
// `too_large` (a case with more than 8 MB of rows, or a bundle of more than some 20,000 cases).
base::Result<Bundle> write_bundle(Library& library, std::vector<std::string> case_ids,
                                  const std::filesystem::path& out, const std::string& program_version);

// Reads all of it and checks all of it: every part's SHA-256, every row against the schema, every volume, skin and
// class against its case. Refused: `not_a_bundle`, `bundle_version`, `newer_schema`, `damaged`, `too_large` (it
// would unpack to far more than a CT does).
base::Result<Bundle> check_bundle(const std::filesystem::path& file);

struct Unbundled {
  std::vector<std::string> stored;
  std::vector<std::string> present;  // were there already, with the same content
  std::size_t healed = 0;            // files of those that were missing or damaged here and are whole again
};

// Checks it as check_bundle, then stores all cases or none. Refused also: `case_differs` (a case is there with
// other content).
base::Result<Unbundled> import_bundle(Library& library, const std::filesystem::path& file);

}  // namespace seldinger::casedb
