#include "casedb/keeping/bundle_file.h"

#include <charconv>
#include <cstring>
#include <set>
#include <string_view>

#include "casedb/cases/bundle_rows.h"
#include "casedb/database/credentials.h"
#include "casedb/database/library.h"
#include "casedb/database/migrate.h"
#include "casedb/database/uuid.h"
#include "sim/base/check.h"
#include "sim/base/hex.h"

namespace seldinger::casedb {
namespace {

constexpr std::uint32_t kFormat = 1, kSignedFormat = 2;
constexpr std::size_t kPublicKeyBytes = 32;
constexpr std::size_t kSignatureBytes = kPublicKeyBytes + std::tuple_size_v<Signature>;

struct Header {
  char magic[8] = {};
  std::uint32_t format = kFormat, reserved = 0;
  std::uint64_t list_bytes = 0;
  char list_sha256[64] = {};
};
static_assert(sizeof(Header) == 88);

const base::Error kDamagedFile{"damaged", "the bundle is damaged"};

bool is_version(std::string_view text) {
  return !text.empty() && text.size() <= 64 &&
         text.find_first_not_of("0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ.+-") ==
             std::string_view::npos;
}

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  while (words.size() < 6) {
    const std::size_t end = line.find(' ');
    words.push_back(line.substr(0, end));
    if (end == std::string_view::npos) break;
    line.remove_prefix(end + 1);
  }
  return words;
}

// Only as it would be written: no sign, no leading zero.
bool read_number(std::string_view word, std::uint64_t& value) {
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size() && std::to_string(value) == word;
}

bool read_line(std::string_view line, BundleList& list) {
  const auto words = words_of(line);
  std::uint64_t number = 0;
  if (words[0] == "schema" && words.size() == 2 && list.schema == 0) {
    if (!read_number(words[1], number) || number < 1 || number > 1'000'000) return false;
    list.schema = static_cast<int>(number);
    return true;
  }
  if (words[0] == "program" && words.size() == 2 && list.program_version.empty()) {
    list.program_version = words[1];
    return is_version(words[1]);
  }
  if (words[0] == "case" && words.size() == 5) {
    BundledCase& made = list.cases.emplace_back();
    made.case_id = words[1];
    made.sha256 = words[4];
    return is_uuid(words[1]) && read_number(words[2], made.packed_bytes) && read_number(words[3], made.bytes) &&
           made.packed_bytes > 0 && made.packed_bytes <= kMostRowBytes && made.bytes <= kMostRowBytes &&
           is_asset_name(made.sha256);
  }
  if (words[0] == "asset" && words.size() == 3) {
    BundledAsset& made = list.assets.emplace_back();
    made.sha256 = words[2];
    return read_number(words[1], made.bytes) && is_asset_name(made.sha256);
  }
  return false;
}

// Where each part lies; false when they do not end at `end`.
bool lay_out(BundleList& list, std::uint64_t from, std::uint64_t end) {
  const auto take = [&](std::uint64_t bytes, std::uint64_t& offset) {
    offset = from;
    if (bytes > end - from) return false;
    from += bytes;
    return true;
  };
  for (BundledCase& part : list.cases)
    if (!take(part.packed_bytes, part.offset)) return false;
  for (BundledAsset& part : list.assets)
    if (!take(part.bytes, part.offset)) return false;
  return from == end;
}

}  // namespace

std::vector<std::byte> bundle_head(BundleList& list, const std::optional<HashKey>& secret_key) {
  std::string text = "schema " + std::to_string(list.schema) + "\nprogram " + list.program_version + "\n";
  std::uint64_t bytes = 0;
  for (const BundledCase& part : list.cases) {
    text += "case " + part.case_id + " " + std::to_string(part.packed_bytes) + " " + std::to_string(part.bytes) +
            " " + part.sha256 + "\n";
    bytes += part.packed_bytes;
  }
  for (const BundledAsset& part : list.assets) {
    text += "asset " + std::to_string(part.bytes) + " " + part.sha256 + "\n";
    bytes += part.bytes;
  }
  Header header;
  kBundleMagic.copy(header.magic, sizeof header.magic);
  header.format = secret_key ? kSignedFormat : kFormat;
  header.list_bytes = text.size();
  const std::string hash = sha256_hex(std::as_bytes(std::span(text)));
  std::memcpy(header.list_sha256, hash.data(), sizeof header.list_sha256);
  std::vector<std::byte> head(sizeof header + text.size());
  std::memcpy(head.data(), &header, sizeof header);
  std::memcpy(head.data() + sizeof header, text.data(), text.size());
  if (secret_key) {
    list.signing_key = public_key_of(*secret_key);
    const std::vector<std::byte> key = base::bytes_from_hex(*list.signing_key).value();
    const Signature signature = sign(*secret_key, std::as_bytes(std::span(&header, 1)));
    head.insert(head.end(), key.begin(), key.end());
    head.insert(head.end(), signature.begin(), signature.end());
  }
  CHECK(lay_out(list, head.size(), head.size() + bytes));
  return head;
}

base::Result<BundleList> read_bundle_list(const OpenFile& file) {
  Header header;
  const std::vector<std::byte> start = file.read(0, sizeof header);
  if (start.size() < sizeof header || std::memcmp(start.data(), kBundleMagic.data(), kBundleMagic.size()) != 0)
    return base::Error{"not_a_bundle", "the file is no bundle"};
  std::memcpy(&header, start.data(), sizeof header);
  if (header.format > kSignedFormat)
    return base::Error{"bundle_version", "the bundle was written by a newer version of this program"};
  if (header.format < kFormat || header.reserved != 0 || header.list_bytes > kMostFileListBytes ||
      header.list_bytes > file.size() - sizeof header)
    return kDamagedFile;
  const std::vector<std::byte> bytes = file.read(sizeof header, static_cast<std::size_t>(header.list_bytes));
  if (sha256_hex(bytes) != std::string_view(header.list_sha256, sizeof header.list_sha256)) return kDamagedFile;
  std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  BundleList list;
  Sha256 head;
  head.add(start);
  std::uint64_t parts_from = sizeof header + header.list_bytes;
  if (header.format == kSignedFormat) {
    const std::vector<std::byte> part = file.read(parts_from, kSignatureBytes);
    if (part.size() < kSignatureBytes) return kDamagedFile;
    head.add(part);
    Signature signature{};
    std::memcpy(signature.data(), part.data() + kPublicKeyBytes, signature.size());
    list.signing_key = base::hex_from_bytes(std::span(part).first(kPublicKeyBytes));
    if (!is_signed_by(*list.signing_key, std::as_bytes(std::span(&header, 1)), signature))
      return base::Error{"bad_signature", "the bundle's signature is not that of the key it names"};
    parts_from += kSignatureBytes;
  }
  list.head_sha256 = head.hex();
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos || !read_line(text.substr(0, end), list)) return kDamagedFile;
    text.remove_prefix(end + 1);
  }
  if (list.schema == 0 || list.program_version.empty() || list.cases.empty()) return kDamagedFile;
  if (const int newest = newest_version(library_schema()); list.schema > newest)
    return base::Error{"newer_schema", "the bundle was written by a newer version of this program (schema " +
                                           std::to_string(list.schema) + ", known up to " + std::to_string(newest) +
                                           ")"};
  std::set<std::string_view> names;
  for (const BundledCase& part : list.cases)
    if (!names.insert(part.case_id).second) return kDamagedFile;
  for (const BundledAsset& part : list.assets)
    if (!names.insert(part.sha256).second) return kDamagedFile;
  if (!lay_out(list, parts_from, file.size())) return kDamagedFile;
  return list;
}

}  // namespace seldinger::casedb
