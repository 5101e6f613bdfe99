// The container of a bundle (.sdbundle): a header, a list of what follows with sizes and SHA-256, then those parts
// in that order to the last byte of the file.
//
//   magic "SDBUNDLE" · uint32 format 1 · uint32 0 · uint64 bytes of the list · its SHA-256 as 64 hexadecimal digits
//   list: lines "schema N", "program V", "case ID PACKED_BYTES BYTES SHA256" …, "asset BYTES SHA256" …
//   cases: their rows (casedb/cases/bundle_rows.h), a zstd frame each; assets: as they lie in assets/
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "casedb/database/disk.h"
#include "sim/base/result.h"

namespace seldinger::casedb {

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
};

// Header and list; the parts follow. Fills in where each will lie.
std::vector<std::byte> bundle_head(BundleList& list);

// Before anything else of the file is read: all parts are named once and end where the file ends. Refused:
// `not_a_bundle`, `bundle_version`, `newer_schema`, `damaged`.
base::Result<BundleList> read_bundle_list(const OpenFile& file);

}  // namespace seldinger::casedb
