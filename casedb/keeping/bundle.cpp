#include "casedb/keeping/bundle.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>

#include "casedb/cases/bundle_rows.h"
#include "casedb/cases/case_rows.h"
#include "casedb/cases/case_state.h"
#include "casedb/database/audit.h"
#include "casedb/database/credentials.h"
#include "casedb/database/disk.h"
#include "casedb/database/leftovers.h"
#include "casedb/database/migrate.h"
#include "casedb/database/new_assets.h"
#include "casedb/database/question.h"
#include "casedb/database/sqlite.h"
#include "casedb/database/tables.h"
#include "casedb/import/jail/jail.h"
#include "casedb/import/jail/unpacking.h"
#include "casedb/keeping/bundle_file.h"
#include "casedb/keeping/trusted_keys.h"
#include "sim/base/check.h"
#include "sim/base/codec.h"
#include "sim/case/form/mesh.h"
#include "sim/volume/classes.h"
#include "sim/volume/volume_bytes.h"

namespace seldinger::casedb {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kBundlePiece = std::size_t{1} << 20, kSha256Digits = 64;

const base::Error kDamaged{"damaged", "the bundle is damaged"};
const base::Error kBadValues{"bundle_values", "a case of the bundle has a value that this program never stores"};
const base::Error kTooLarge{"too_large", "the bundle would unpack to far more than a CT does"};

// In a jail, where room and time are made for what is unpacked next.
void announce_part(std::uint64_t unpacked, std::uint64_t packed) {
  announce_largest(packed + unpacked);
  announce_work(packed + unpacked);
}

bool plausible(std::uint64_t unpacked, std::uint64_t packed) {
  if (unpacks_too_far(kBundlePart, packed, unpacked)) return false;
  announce_part(unpacked, packed);
  return true;
}

// What CaseContents holds of a voxel at once: HU, labels, and classes that are made of them.
constexpr std::uint64_t kMostOfAVoxel = 4;
// A case is worth so many bytes of work besides its files: its rows are read, and a few of its files twice.
constexpr std::uint64_t kWorkOfACase = 8 * kMiB;

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

// Label maps that were added to a case are such as `case label` adds, and its structures are in its files.
base::Result<void> check_authored_files(const OpenFile& file, Sqlite& rows, const std::string& case_id,
                                        const Assets& assets, std::uint64_t voxels) {
  const CaseRow row = read_cases(rows, case_id).at(0);
  Statement maps = question(rows, "label_maps_of_case");
  for (maps.bind("case_id", case_id); maps.step();) {
    const auto bytes = read_asset(file, *assets.at(maps.text("labels_sha256")));
    if (!bytes) return bytes.error();
    if (volume::stored_voxels(*bytes) != voxels) return kDamaged;
    announce_part(voxels, bytes->size());
    const auto labels = volume::labels_from_bytes(*bytes);
    if (!labels || !is_sound_label_map(row, *labels)) return kDamaged;
  }
  CaseContents contents(
      rows,
      [&](const std::string& sha256) {
        const BundledAsset& asset = *assets.at(sha256);
        announce_part(kMostOfAVoxel * voxels, asset.bytes);
        return read_asset(file, asset);
      },
      row);
  const auto structures = read_structures(rows, case_id);
  CHECK(structures);  // rows_are_sound
  for (const StructureRow& structure : *structures)
    if (!check_place(contents, row, structure)) return kBadValues;
  return {};
}

// The files of a case are what they are used as. How far labels and classes unpack is no question of their own:
// nearly empty ones shrink ten thousand times, and they have as many voxels as the volume, which was judged.
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
    const auto skin = cases::mesh_from_bytes(*bytes);
    if (!skin || skin->triangles.empty()) return kDamaged;
  }
  if (const auto prepared = find_preparation(rows, case_id)) {
    const BundledAsset& original = *assets.at(prepared->original_sha256);
    const auto bytes = read_asset(file, original);
    if (!bytes) return bytes.error();
    const std::uint64_t stored = volume::stored_voxels(*bytes);
    if (stored > volume::kMaxVoxels || !plausible(stored * sizeof(std::int16_t), original.bytes)) return kTooLarge;
    if (!volume::volume_from_bytes(*bytes)) return kDamaged;
  }
  if (!row.is_null("labels_sha256")) {
    const auto bytes = read_asset(file, *asset("labels_sha256"));
    if (!bytes) return bytes.error();
    if (volume::stored_voxels(*bytes) != count) return kDamaged;
    announce_part(count, bytes->size());
    const auto labels = volume::labels_from_bytes(*bytes);
    if (!labels || labels->label.size() != count) return kDamaged;
  }
  if (!row.is_null("classes_sha256")) {
    const auto bytes = read_asset(file, *asset("classes_sha256"));
    if (!bytes) return bytes.error();
    announce_part(count, bytes->size());
    if (!volume::classes_from_bytes(*bytes, static_cast<std::size_t>(count))) return kDamaged;
  }
  return check_authored_files(file, rows, case_id, assets, count);
}

base::Result<std::unique_ptr<Sqlite>> read_rows(const OpenFile& file, RowsReader& reader, const BundledCase& part) {
  const std::vector<std::byte> packed = file.read(part.offset, static_cast<std::size_t>(part.packed_bytes));
  if (sha256_hex(packed) != part.sha256) return kDamaged;
  const auto bytes = base::decompress(packed, static_cast<std::size_t>(part.bytes));
  if (!bytes || bytes->size() != part.bytes) return kDamaged;
  return reader.read(*bytes, part.case_id);
}

// All of the file, before anything is stored. Each case is shown when it is found sound, with the names of its
// files. Without `unpacks` files are known by their names only.
using Show = std::function<void(const BundledCase& part, Sqlite& rows, const std::set<std::string>& names)>;
base::Result<void> check_parts(const OpenFile& file, const BundleList& list, bool unpacks, const Show& show) {
  Assets assets;
  for (const BundledAsset& asset : list.assets) {
    assets.emplace(asset.sha256, &asset);
    if (!unpacks) continue;
    announce_work(asset.bytes);
    Sha256 hash;
    for (std::uint64_t done = 0; done < asset.bytes; done += kBundlePiece)
      hash.add(file.read(asset.offset + done,
                         static_cast<std::size_t>(std::min<std::uint64_t>(kBundlePiece, asset.bytes - done))));
    if (hash.hex() != asset.sha256) return kDamaged;
  }
  std::set<std::string> used;
  RowsReader reader(list.schema);
  for (const BundledCase& part : list.cases) {
    if (unpacks) announce_work(kWorkOfACase + part.bytes);
    const auto rows = read_rows(file, reader, part);
    if (!rows) return rows.error();
    std::set<std::string> named = assets_named(**rows);
    for (const std::string& name : named)
      if (!assets.contains(name)) return kDamaged;
    if (unpacks)
      if (const auto fit = check_files(file, **rows, part.case_id, assets); !fit) return fit.error();
    show(part, **rows, named);
    used.merge(named);
  }
  if (used.size() != assets.size()) return kDamaged;  // a file that nobody needs
  return {};
}

// Reads all of the file in a jail, and answers its list. What is read of it afterwards out here is read with the
// hashes of that list and no other's, also when somebody writes to the file meanwhile.
base::Result<BundleList> checked_list(const OpenFile& file) {
  const RowsReader known(newest_version(library_schema()));  // so that the jail has its schema already
  JailInputs inputs;
  inputs.descriptors = {file.descriptor()};
  inputs.bytes = kMostFileListBytes + 4 * kMostRowBytes;
  base::Result<std::string> checked = base::Error{};
  const auto read = read_in_jail(
      inputs,
      [&](Outlet& out) {
        const auto list = read_bundle_list(file);
        const auto sound = list ? check_parts(file, *list, true, [](const auto&...) {}) : list.error();
        out.put(sound.has_value());
        if (sound)
          out.put_text(list->head_sha256);
        else
          out.put_error(sound.error());
      },
      [&](Inlet& in) {
        if (in.take_flag())
          checked = in.take_text(kSha256Digits);
        else
          checked = in.take_error();
      });
  if (!read) return read.error();
  if (!checked) return checked.error();
  auto list = read_bundle_list(file);
  if (list && list->head_sha256 != *checked) return kDamaged;
  return list;
}

Bundle told(const BundleList& list, std::uint64_t bytes) {
  Bundle bundle{list.schema, list.program_version, {}, list.assets.size(), bytes, list.signing_key};
  for (const BundledCase& part : list.cases) bundle.case_ids.push_back(part.case_id);
  return bundle;
}

// What is known of a bundle beside a library once all of it was read.
struct Compared {
  Unbundled cases;
  std::set<std::string> assets;          // that the absent cases need
  std::set<std::string> hurt;            // of the present ones, missing or damaged here
  std::vector<base::Problem> different;  // cases that are there with other content
};

base::Result<Compared> compared(Library& library, const OpenFile& file, const BundleList& list) {
  Compared found;
  const auto sound = check_parts(file, list, false, [&](const BundledCase& part, Sqlite& rows, const auto& names) {
    switch (presence(rows, library.database(), part.case_id)) {
      case Presence::absent:
        found.cases.stored.push_back(part.case_id);
        if (read_cases(rows, part.case_id).at(0).state == CaseState::published)
          found.cases.for_review.push_back(part.case_id);
        found.assets.insert(names.begin(), names.end());
        break;
      case Presence::same:
        found.cases.present.push_back(part.case_id);
        for (const std::string& name : names)
          if (library.asset_state(name) != Library::AssetState::sound) found.hurt.insert(name);
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
    insert_rows(**rows, library.database(), part.case_id, list.signing_key);
    audit(library, Act::import_cases, {"case", part.case_id});
  }
  transaction.commit();
  assets.keep();
  return true;
}

// Files of cases that are here already take the place of those that are damaged; read_asset looked at every byte.
base::Result<void> heal(Library& library, const OpenFile& file, const BundleList& list, const Compared& found) {
  for (const BundledAsset& asset : list.assets) {
    if (!found.hurt.contains(asset.sha256)) continue;
    const auto bytes = read_asset(file, asset);
    if (!bytes) return bytes.error();
    library.store_asset(*bytes);
  }
  return {};
}

base::Result<Bundle> written(Library& library, std::vector<std::string> case_ids, const fs::path& out,
                             const std::string& program_version, const std::optional<HashKey>& secret_key) {
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
  remove_leftover_files(out.parent_path(), kBundleMagic);
  NewFile made(out, FileAccess::as_umask);
  const std::vector<std::byte> head = bundle_head(list, secret_key);
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
                                  const std::string& program_version, const std::optional<HashKey>& secret_key) {
  return without_paths([&] { return written(library, std::move(case_ids), out, program_version, secret_key); });
}

base::Result<Bundle> check_bundle(const fs::path& file) {
  return without_paths([&]() -> base::Result<Bundle> {
    if (!fs::is_regular_file(file)) return not_found();
    const OpenFile in(fs::canonical(file));
    const auto list = checked_list(in);
    if (!list) return list.error();
    return told(*list, in.size());
  });
}

base::Result<Unbundled> import_bundle(Library& library, const fs::path& file) {
  return without_paths([&]() -> base::Result<Unbundled> {
    if (!fs::is_regular_file(file)) return not_found();
    const OpenFile in(fs::canonical(file));
    const auto list = checked_list(in);
    if (!list) return list.error();
    try {
      for (;;) {
        auto found = compared(library, in, *list);
        if (!found) return found.error();
        found->cases.signing_key = list->signing_key;
        for (TrustedKey& one : list_trusted_keys(library))
          if (one.public_key == list->signing_key) found->cases.trusted_as = std::move(one.label);
        if (const auto whole = heal(library, in, *list, *found); !whole) return whole.error();
        found->cases.healed = found->hurt.size();
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
