#include "casedb/keeping/bundle.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>

#include "casedb/cases/bundle_rows.h"
#include "casedb/database/audit.h"
#include "casedb/database/credentials.h"
#include "casedb/database/disk.h"
#include "casedb/database/migrate.h"
#include "casedb/database/new_assets.h"
#include "casedb/database/question.h"
#include "casedb/database/sqlite.h"
#include "casedb/database/tables.h"
#include "casedb/keeping/bundle_file.h"
#include "sim/base/check.h"
#include "sim/base/codec.h"
#include "sim/case/form/mesh.h"
#include "sim/volume/classes.h"
#include "sim/volume/volume_bytes.h"

namespace seldinger::casedb {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kBundlePiece = std::size_t{1} << 20;
// A CT's noise does not shrink; labels and classes of a made-up body do, about 100-fold. What claims far more is
// there to fill a memory.
constexpr std::uint64_t kMostShrinking = 1000;

const base::Error kDamaged{"damaged", "the bundle is damaged"};
const base::Error kTooLarge{"too_large", "the bundle would unpack to far more than a CT does"};

bool plausible(std::uint64_t unpacked, std::uint64_t packed) {
  return unpacked <= base::kTakenAtItsWord || unpacked / kMostShrinking <= packed;
}

using Assets = std::map<std::string, const BundledAsset*>;  // by name

// The bytes of an asset, or none when they are not what the list says.
base::Result<std::vector<std::byte>> read_asset(const OpenFile& file, const BundledAsset& asset) {
  std::vector<std::byte> bytes = file.read(asset.offset, static_cast<std::size_t>(asset.bytes));
  if (bytes.size() != asset.bytes || sha256_hex(bytes) != asset.sha256) return kDamaged;
  return bytes;
}

bool same_number(double a, double b) {
  return a == b && std::isfinite(a);
}

// What the case says of its volume is what the volume is.
bool fits(const volume::Volume& volume, const Statement& row) {
  constexpr const char* kAxes[] = {"x", "y", "z"};
  const auto [lowest, highest] = std::minmax_element(volume.hu.begin(), volume.hu.end());
  if (row.integer("hu_min") != *lowest || row.integer("hu_max") != *highest) return false;
  for (int axis = 0; axis < 3; ++axis) {
    const std::string name = kAxes[axis];
    if (row.integer("size_" + name + "_voxels") != volume.size_voxels[axis] ||
        !same_number(row.real("spacing_" + name + "_mm"), volume.spacing_mm[axis]))
      return false;
    for (int column = 0; column < 4; ++column)
      if (!same_number(row.real("lps_from_voxel_" + std::to_string(axis) + std::to_string(column)),
                       volume.lps_from_voxel[column][axis]))
        return false;
  }
  return true;
}

// The files of a case are what they are used as.
base::Result<void> check_files(const OpenFile& file, Sqlite& rows, const std::string& case_id,
                               const Assets& assets) {
  Statement row = question(rows, "cases");
  CHECK(row.bind("case_id", case_id).step());
  const auto asset = [&](const char* column) { return assets.at(row.text(column)); };
  const double voxels = static_cast<double>(row.integer("size_x_voxels")) *
                        static_cast<double>(row.integer("size_y_voxels")) *
                        static_cast<double>(row.integer("size_z_voxels"));
  if (!(voxels >= 1.0 && voxels <= static_cast<double>(volume::kMaxVoxels))) return kDamaged;
  const auto count = static_cast<std::uint64_t>(voxels);
  if (!plausible(count * sizeof(std::int16_t), asset("volume_sha256")->bytes)) return kTooLarge;
  {
    const auto bytes = read_asset(file, *asset("volume_sha256"));
    if (!bytes) return bytes.error();
    if (volume::stored_voxels(*bytes) != count) return kDamaged;  // before room is made for them
    const auto volume = volume::volume_from_bytes(*bytes);
    if (!volume || !fits(*volume, row)) return kDamaged;
  }
  {
    const auto bytes = read_asset(file, *asset("skin_sha256"));
    if (!bytes) return bytes.error();
    if (!plausible(base::claimed_size(*bytes).value_or(0), bytes->size())) return kTooLarge;
    if (!cases::mesh_from_bytes(*bytes)) return kDamaged;
  }
  if (!row.is_null("labels_sha256")) {
    const auto bytes = read_asset(file, *asset("labels_sha256"));
    if (!bytes) return bytes.error();
    if (!plausible(count, bytes->size())) return kTooLarge;
    if (volume::stored_voxels(*bytes) != count) return kDamaged;
    const auto labels = volume::labels_from_bytes(*bytes);
    if (!labels || labels->label.size() != count) return kDamaged;
  }
  if (!row.is_null("classes_sha256")) {
    const auto bytes = read_asset(file, *asset("classes_sha256"));
    if (!bytes) return bytes.error();
    if (!plausible(count, bytes->size())) return kTooLarge;
    if (!volume::classes_from_bytes(*bytes, static_cast<std::size_t>(count))) return kDamaged;
  }
  return {};
}

base::Result<std::unique_ptr<Sqlite>> read_rows(const OpenFile& file, RowsReader& reader, const BundledCase& part) {
  const std::vector<std::byte> packed = file.read(part.offset, static_cast<std::size_t>(part.packed_bytes));
  if (sha256_hex(packed) != part.sha256) return kDamaged;
  const auto bytes = base::decompress(packed, static_cast<std::size_t>(part.bytes));
  if (!bytes || bytes->size() != part.bytes) return kDamaged;
  return reader.read(*bytes, part.case_id);
}

// All of the file, before anything is stored. Each case is shown when it is found sound, with the names of its
// files.
using Show = std::function<void(const BundledCase& part, Sqlite& rows, const std::set<std::string>& names)>;
base::Result<void> check_parts(const OpenFile& file, const BundleList& list, const Show& show) {
  Assets assets;
  for (const BundledAsset& asset : list.assets) {
    Sha256 hash;
    for (std::uint64_t done = 0; done < asset.bytes; done += kBundlePiece)
      hash.add(file.read(asset.offset + done,
                         static_cast<std::size_t>(std::min<std::uint64_t>(kBundlePiece, asset.bytes - done))));
    if (hash.hex() != asset.sha256) return kDamaged;
    assets.emplace(asset.sha256, &asset);
  }
  std::set<std::string> used;
  RowsReader reader(list.schema);
  for (const BundledCase& part : list.cases) {
    const auto rows = read_rows(file, reader, part);
    if (!rows) return rows.error();
    std::set<std::string> named = assets_named(**rows);
    for (const std::string& name : named)
      if (!assets.contains(name)) return kDamaged;
    if (const auto fit = check_files(file, **rows, part.case_id, assets); !fit) return fit.error();
    show(part, **rows, named);
    used.merge(named);
  }
  if (used.size() != assets.size()) return kDamaged;  // a file that nobody needs
  return {};
}

Bundle told(const BundleList& list, std::uint64_t bytes) {
  Bundle bundle{list.schema, list.program_version, {}, list.assets.size(), bytes};
  for (const BundledCase& part : list.cases) bundle.case_ids.push_back(part.case_id);
  return bundle;
}

// What is known of a bundle beside a library once all of it was read.
struct Compared {
  Unbundled cases;
  std::set<std::string> assets;          // that the absent cases need
  std::vector<base::Problem> different;  // cases that are there with other content
};

base::Result<Compared> compared(Library& library, const OpenFile& file, const BundleList& list) {
  Compared found;
  const auto sound = check_parts(file, list, [&](const BundledCase& part, Sqlite& rows, const auto& names) {
    switch (presence(rows, library.database(), part.case_id)) {
      case Presence::absent:
        found.cases.stored.push_back(part.case_id);
        found.assets.insert(names.begin(), names.end());
        break;
      case Presence::same:
        found.cases.present.push_back(part.case_id);
        break;
      case Presence::different:
        found.different.push_back(
            {"case_differs", "case " + part.case_id + " is in the library with other content"});
        break;
    }
  });
  if (!sound) return sound.error();
  if (!found.different.empty())
    return base::Error{"case_differs", "a case of the bundle is in the library with other content",
                       found.different};
  return found;
}

// The file changed while it was read.
class Changed {};

// The absent cases, all or none. False: one of them is there meanwhile.
base::Result<bool> store(Library& library, const OpenFile& file, const BundleList& list, const Compared& found) {
  NewAssets assets(library);
  for (const BundledAsset& asset : list.assets)
    if (found.assets.contains(asset.sha256))
      assets.add([&file, &asset] {
        auto bytes = read_asset(file, asset);
        if (!bytes) throw Changed();
        return std::move(bytes.value());
      });
  const std::set<std::string_view> absent(found.cases.stored.begin(), found.cases.stored.end());
  RowsReader reader(list.schema);
  Transaction transaction(library.database());
  assets.make_sure();
  for (const BundledCase& part : list.cases) {
    if (!absent.contains(part.case_id)) continue;
    const auto rows = read_rows(file, reader, part);
    if (!rows) return rows.error();
    if (presence(**rows, library.database(), part.case_id) != Presence::absent) return false;
    insert_rows(**rows, library.database(), part.case_id);
    audit(library, Act::import_cases, {"case", part.case_id});
  }
  transaction.commit();
  assets.keep();
  return true;
}

base::Result<Bundle> written(Library& library, std::vector<std::string> case_ids, const fs::path& out,
                             const std::string& program_version) {
  const base::Error too_large{"too_large", "there is more in it than a bundle takes"};
  Sqlite& database = library.database();
  BundleList list;
  list.schema = newest_version(library_schema());
  list.program_version = program_version;
  std::vector<std::vector<std::byte>> parts;
  std::set<std::string> names;
  {
    const Snapshot snapshot(database);
    if (case_ids.empty())
      for (Statement rows = question(database, "case_ids"); rows.step();) case_ids.push_back(rows.text("case_id"));
    if (case_ids.empty()) return base::Error{"no_case", "there is no case in the library"};
    if (case_ids.size() > 20'000) return too_large;
    for (const std::string& case_id : case_ids) {
      Statement there = question(database, "cases");
      if (!there.bind("case_id", case_id).step())
        return base::Error{"no_case", "there is no such case in the library"};
      const std::vector<std::byte> bytes = bytes_from_rows(database, case_id);
      if (bytes.size() > kMostRowBytes) return too_large;
      std::vector<std::byte> packed = base::compress(bytes);
      list.cases.push_back({case_id, packed.size(), bytes.size(), sha256_hex(packed), 0});
      names.merge(assets_of_case(database, case_id));
      parts.push_back(std::move(packed));
    }
  }
  const base::Error missing{"asset_missing", "a file of the library is missing"};
  for (const std::string& name : names) {
    if (!library.has_asset(name)) return missing;
    list.assets.push_back({name, fs::file_size(library.folder() / kAssetsFolder / name), 0});
  }
  NewFile made(out);
  const std::vector<std::byte> head = bundle_head(list);
  std::uint64_t bytes = head.size();
  made.write(head);
  for (const std::vector<std::byte>& part : parts) {
    made.write(part);
    bytes += part.size();
  }
  for (const BundledAsset& asset : list.assets) {
    if (!library.has_asset(asset.sha256)) return missing;  // deleted meanwhile
    const OpenFile in(library.folder() / kAssetsFolder / asset.sha256);
    Sha256 hash;
    for (std::uint64_t at = 0; at < in.size(); at += kBundlePiece) {
      const std::vector<std::byte> piece = in.read(at, kBundlePiece);
      hash.add(piece);
      made.write(piece);
      bytes += piece.size();
    }
    if (hash.hex() != asset.sha256) return base::Error{"asset_damaged", "a file of the library is damaged"};
  }
  made.keep();
  return told(list, bytes);
}

base::Error not_found() {
  return {"not_found", "there is no such file"};
}

}  // namespace

base::Result<Bundle> write_bundle(Library& library, std::vector<std::string> case_ids, const fs::path& out,
                                  const std::string& program_version) {
  return without_paths([&] { return written(library, std::move(case_ids), out, program_version); });
}

base::Result<Bundle> check_bundle(const fs::path& file) {
  return without_paths([&]() -> base::Result<Bundle> {
    if (!fs::is_regular_file(file)) return not_found();
    const OpenFile in(file);
    const auto list = read_bundle_list(in);
    if (!list) return list.error();
    if (const auto sound = check_parts(in, *list, [](const auto&...) {}); !sound) return sound.error();
    return told(*list, in.size());
  });
}

base::Result<Unbundled> import_bundle(Library& library, const fs::path& file) {
  return without_paths([&]() -> base::Result<Unbundled> {
    if (!fs::is_regular_file(file)) return not_found();
    const OpenFile in(file);
    const auto list = read_bundle_list(in);
    if (!list) return list.error();
    try {
      for (;;) {
        const auto found = compared(library, in, *list);
        if (!found) return found.error();
        if (found->cases.stored.empty()) return found->cases;
        const auto stored = store(library, in, *list, *found);
        if (!stored) return stored.error();
        if (*stored) return found->cases;
      }
    } catch (const Changed&) {
      return kDamaged;
    } catch (const DatabaseFailure& failure) {
      if (failure.kind() != DatabaseFailure::Kind::constraint) throw;
      // Sound by themselves, but not beside what is there, as a target of the same id in another case.
      return base::Error{"case_differs", "the bundle does not fit to what the library holds"};
    }
  });
}

}  // namespace seldinger::casedb
