// Cases out of one library and into another, as one checked file (casedb/keeping/bundle_file.h): the case, what is
// said of it, its targets and its files. No person, no account and no attempt is ever in it. Throws base::Failure
// ("disk", "database").
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "casedb/database/credentials.h"
#include "casedb/database/library.h"
#include "sim/base/result.h"

namespace seldinger::casedb {

struct Bundle {
  int schema = 0;
  std::string program_version;
  std::vector<std::string> case_ids;
  std::size_t assets = 0;
  std::uint64_t bytes = 0;                 // of the file
  std::optional<std::string> signing_key;  // the public key whose signature holds; nothing: unsigned
};

// Whole under `out`, or nothing is there. No ids: every case. Refused: `no_case`, `asset_missing`, `asset_damaged`,
// `too_large` (a case with more than 8 MB of rows, or a bundle of more than some 20,000 cases). With a secret key
// (casedb/database/credentials.h) it is signed.
base::Result<Bundle> write_bundle(Library& library, std::vector<std::string> case_ids,
                                  const std::filesystem::path& out, const std::string& program_version,
                                  const std::optional<HashKey>& secret_key = {});

// Reads all of it and checks all of it: its signature, every part's SHA-256, every row against the schema, every
// value against what the commands take, every volume, skin, label and class against its case. Refused:
// `not_a_bundle`, `bundle_version`, `newer_schema`, `damaged`, `bad_signature`, `bundle_values`, `too_large` (it
// would unpack to far more than a CT does).
base::Result<Bundle> check_bundle(const std::filesystem::path& file);

struct Unbundled {
  std::vector<std::string> stored;
  std::vector<std::string> present;     // were there already, with the same content
  std::vector<std::string> for_review;  // of those stored: published by the sender, to be reviewed here
  std::optional<std::string> signing_key, trusted_as;  // the key, and its label where it is trusted here
  std::size_t healed = 0;  // files of those that were missing or damaged here and are whole again
};

// Checks it as check_bundle, then stores all cases or none. What the sender says of its own review, of faces and of
// burned-in text is kept as the sender's (casedb/cases/received.h): here nothing of it is confirmed. Refused also:
// `case_differs` (a case is there with other content).
base::Result<Unbundled> import_bundle(Library& library, const std::filesystem::path& file);

}  // namespace seldinger::casedb
