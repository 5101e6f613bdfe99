// The container of a bundle (.sdbundle): a header, a list of what follows with sizes and SHA-256, then those parts
// in that order to the last byte of the file.
//
//   magic "SDBUNDLE" · uint32 format · uint32 0 · uint64 bytes of the list · its SHA-256 as 64 hexadecimal digits
//   list: lines "schema N", "program V", "case ID PACKED_BYTES BYTES SHA256" …, "asset BYTES SHA256" …
//   format 2 only, a signed bundle: the public key, 32 bytes, and its signature of all up to the list, 64 bytes
//   cases: their rows (casedb/cases/bundle_rows.h), a zstd frame each; assets: as they lie in assets/
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "casedb/database/credentials.h"
#include "casedb/database/disk.h"
#include "sim/base/result.h"

namespace seldinger::casedb {

inline constexpr std::string_view kBundleMagic = "SDBUNDLE";

constexpr std::uint64_t kMostFileListBytes = std::uint64_t{16} << 20;  // of 20,000 cases with five files each

struct BundledCase {
  std::string case_id;
  std::uint64_t packed_bytes = 0, bytes = 0;
  std::string sha256;        // of the packed bytes
  std::uint64_t offset = 0;  // in the file
};

struct BundledAsset {
  std::string sha256;
  std::uint64_t bytes = 0, offset = 0;
};

struct BundleList {
  int schema = 0;
  std::string program_version;
  std::vector<BundledCase> cases;
  std::vector<BundledAsset> assets;  // by name
  // The public key whose signature holds; nothing: unsigned. It signs the header, which names the list by its hash,
  // which so names every part.
  std::optional<std::string> signing_key;
  std::string head_sha256;  // of header and signature: which file this is the list of, to the last byte
};

// Header, list and signature, if there is a key; the parts follow. Fills in where each will lie.
std::vector<std::byte> bundle_head(BundleList& list, const std::optional<HashKey>& secret_key = {});

// Before anything else of the file is read: all parts are named once and end where the file ends. Refused:
// `not_a_bundle`, `bundle_version`, `newer_schema`, `damaged`, `bad_signature`.
base::Result<BundleList> read_bundle_list(const OpenFile& file);

}  // namespace seldinger::casedb
