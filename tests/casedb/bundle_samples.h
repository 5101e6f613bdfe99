// Bundles taken apart and put together again with right sizes and hashes, so that a change gets past them.
#pragma once

#include <cstring>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "casedb/database/credentials.h"
#include "casedb/database/tables.h"
#include "casedb/keeping/bundle_file.h"
#include "sim/base/codec.h"
#include "sim/volume/volume_bytes.h"
#include "tests/casedb/library_samples.h"

namespace seldinger::casedb {

constexpr std::size_t kBundleHeader = 88;

struct Parts {
  std::string list;
  std::vector<std::string> rows;                            // of each case, unpacked
  std::vector<std::pair<std::string, std::string>> assets;  // name and bytes, in order
};

inline std::span<const std::byte> bytes_of(const std::string& text) {
  return std::as_bytes(std::span(text));
}
inline std::string text_of(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

inline void replace(std::string& text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::runtime_error("there is no " + from);
  text.replace(at, from.size(), to);
}

inline Parts parts_of(const std::filesystem::path& file) {
  const OpenFile in(file);
  const BundleList list = read_bundle_list(in).value();
  const std::string bytes = fixtures::whole_file(file);
  Parts parts;
  std::uint64_t list_bytes = 0;
  std::memcpy(&list_bytes, bytes.data() + 16, sizeof list_bytes);
  parts.list = bytes.substr(kBundleHeader, list_bytes);
  for (const BundledCase& part : list.cases)
    parts.rows.push_back(text_of(
        base::decompress(bytes_of(bytes.substr(part.offset, part.packed_bytes)), std::size_t{1} << 30).value()));
  for (const BundledAsset& asset : list.assets)
    parts.assets.emplace_back(asset.sha256, bytes.substr(asset.offset, asset.bytes));
  return parts;
}

// The list as it is, with its own hash.
inline void put_as_listed(const std::filesystem::path& file, const Parts& parts) {
  std::string head("SDBUNDLE\1\0\0\0\0\0\0\0", 16);
  const std::uint64_t size = parts.list.size();
  head.append(reinterpret_cast<const char*>(&size), sizeof size);
  head += sha256_hex(bytes_of(parts.list)) + parts.list;
  for (const std::string& rows : parts.rows) head += text_of(base::compress(bytes_of(rows)));
  for (const auto& [name, bytes] : parts.assets) head += bytes;
  std::ofstream(file, std::ios::binary) << head;
}

// Lines of cases and assets anew from what they are; all others stay.
inline void put(const std::filesystem::path& file, Parts parts) {
  std::string list;
  std::size_t next_case = 0;
  std::size_t listed = 0;
  for (std::size_t at = 0; at < parts.list.size();) {
    const std::size_t end = std::min(parts.list.find('\n', at), parts.list.size() - 1);
    const std::string line = parts.list.substr(at, end + 1 - at);
    at = end + 1;
    if (line.starts_with("case ") && next_case < parts.rows.size()) {
      const std::string packed = text_of(base::compress(bytes_of(parts.rows[next_case])));
      list += line.substr(0, 41) + " " + std::to_string(packed.size()) + " " +
              std::to_string(parts.rows[next_case].size()) + " " + sha256_hex(bytes_of(packed)) + "\n";
      ++next_case;
    } else if (line.starts_with("asset ") && listed < parts.assets.size()) {
      list +=
          "asset " + std::to_string(parts.assets[listed].second.size()) + " " + parts.assets[listed].first + "\n";
      ++listed;
    } else {
      list += line;
    }
  }
  parts.list = list;
  put_as_listed(file, parts);
}

// Another content under a name that is right for it, wherever the case names the old one.
inline void swap_asset(Parts& parts, const std::string& sha256, const std::vector<std::byte>& bytes) {
  const std::string name = sha256_hex(bytes);
  for (auto& [old, content] : parts.assets)
    if (old == sha256) {
      old = name;
      content = text_of(bytes);
    }
  for (std::string& rows : parts.rows)
    for (std::size_t at = 0; (at = rows.find(sha256, at)) != std::string::npos; at += 64)
      rows.replace(at, 64, name);
}

inline void drop_asset(Parts& parts, const std::string& sha256) {
  std::erase_if(parts.assets, [&](const auto& asset) { return asset.first == sha256; });
  const std::size_t at = parts.list.rfind("asset ", parts.list.find(sha256));
  parts.list.erase(at, parts.list.find('\n', at) + 1 - at);
}

inline volume::LabelMap sample_labels() {
  volume::LabelMap labels;
  labels.names = {"none", "kidney"};
  labels.label.resize(9 * 7 * 5);
  for (std::size_t i = 0; i < labels.label.size(); ++i) labels.label[i] = i % 3 == 0;
  return labels;
}

// Every row of every table and the name of every file.
inline std::map<std::string, std::string> state_of(Library& library) {
  std::map<std::string, std::string> state;
  for (const std::string& table : tables_of(library.database())) {
    std::string columns;
    for (const std::string& column : columns_of(library.database(), table))
      columns += (columns.empty() ? "quote(" : " || ',' || quote(") + column + ")";
    Statement rows = library.database().prepare("SELECT " + columns + " AS row FROM " + table + " ORDER BY 1");
    while (rows.step()) state[table] += rows.text("row") + "\n";
  }
  for (const auto& entry : std::filesystem::recursive_directory_iterator(library.folder() / kAssetsFolder))
    state["assets"] += entry.path().filename().string() + "\n";
  return state;
}

// The travelling rows of one database in another whose schema has fewer columns.
inline void copy_common_columns(Sqlite& from, Sqlite& to) {
  for (const TravellingTable& table : travelling_tables()) {
    std::string names, places;
    std::vector<std::string> columns = columns_of(to, table.name);
    if (columns.empty()) continue;
    for (const std::string& column : columns) {
      names += (names.empty() ? "" : ", ") + column;
      places += (places.empty() ? ":" : ", :") + column;
    }
    Statement insert =
        to.prepare("INSERT INTO " + std::string(table.name) + " (" + names + ") VALUES (" + places + ")");
    for (Statement rows = from.prepare("SELECT " + names + " FROM " + std::string(table.name)); rows.step();) {
      for (const std::string& column : columns) {
        if (rows.kind(column) == Statement::Kind::integer)
          insert.bind(column, rows.integer(column));
        else if (rows.kind(column) == Statement::Kind::real)
          insert.bind(column, rows.real(column));
        else if (rows.is_null(column))
          insert.bind_null(column);
        else
          insert.bind(column, rows.text(column));
      }
      insert.run();
    }
  }
}

}  // namespace seldinger::casedb
