#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <string_view>
#include <utility>

#include "casedb/cases/case_rows.h"
#include "casedb/cases/setting_columns.h"
#include "casedb/cases/structure_json.h"
#include "casedb/database/tables.h"
#include "casedb/database/utf8.h"
#include "casedb/database/uuid.h"
#include "sim/base/check.h"
#include "sim/volume/volume_bytes.h"

namespace seldinger::casedb {
namespace {

constexpr std::size_t kMostName = 100;                            // bytes
constexpr std::size_t kMostText = 1000;                           // bytes of a text
constexpr std::size_t kMostDocument = std::size_t{256} << 10;     // of JSON: a tube has up to 1000 points
constexpr std::int64_t kEarliestUs = -62'135'596'800'000'000;     // the year 1
constexpr std::int64_t kLatestUs = 253'402'300'799'000'000;       // the end of the year 9999
constexpr double kFarthestOriginMm = 1e6;                         // as import takes it
constexpr std::int64_t kMostOfAKind = 1000;                       // lesions, structures of a case
constexpr double kNearlyPerpendicular = 0.01, kNearlyOne = 0.01;  // of directions that a scanner rounded

// The end of a control character in UTF-8 (ISO 6429: C0, DEL; C1 are C2 80 to C2 9F).
bool is_control(char before, char c) {
  const auto byte = static_cast<unsigned char>(c);
  return byte < 0x20 || byte == 0x7F || (before == '\xC2' && byte >= 0x80 && byte < 0xA0);
}

bool on_one_line(std::string_view text) {
  char before = 0;
  return std::none_of(text.begin(), text.end(), [&](char c) { return is_control(std::exchange(before, c), c); });
}

bool is_whole(std::string_view column, std::int64_t value) {
  if (column.ends_with("_us")) return value >= kEarliestUs && value <= kLatestUs;
  if (column == "seed") return true;  // any 64 bits
  return value >= std::numeric_limits<int>::min() && value <= std::numeric_limits<int>::max();
}

bool is_sound_text(std::string_view column, std::string_view text) {
  if (column.ends_with("_sha256")) return is_asset_name(std::string(text));
  if (column.ends_with("_id")) return is_uuid(text);
  if (column == "geometry" || column == "pass_rule") return text.size() <= kMostDocument;
  return text.size() <= kMostText && on_one_line(text);
}

// By what the schema says of the columns, so that one of a later migration is asked too.
bool values_are_sound(Sqlite& database, const TravellingTable& table, const std::string& case_id) {
  const std::vector<std::string> columns = columns_of(database, table.name);
  Statement rows =
      database.prepare("SELECT * FROM " + std::string(table.name) + " WHERE " + std::string(table.of_case));
  std::int64_t count = 0;
  for (rows.bind("case_id", case_id); rows.step(); ++count)
    for (const std::string& column : columns) {
      const Statement::Kind kind = rows.kind(column);
      if (kind == Statement::Kind::real && !std::isfinite(rows.real(column))) return false;
      if (kind == Statement::Kind::integer && !is_whole(column, rows.integer(column))) return false;
      if (kind == Statement::Kind::text && !is_sound_text(column, rows.view(column))) return false;
      if (kind == Statement::Kind::blob) return false;
    }
  return count <= kMostOfAKind;
}

bool is_sound_grid(const CaseRow& row) {
  for (int axis = 0; axis < 3; ++axis) {
    const double spacing_mm = row.spacing_mm[axis];
    const glm::dvec3 along(row.lps_from_voxel[axis]), next(row.lps_from_voxel[(axis + 1) % 3]);
    if (!(spacing_mm >= volume::kMinSpacingMm && spacing_mm <= volume::kMaxSpacingMm)) return false;
    if (!(std::abs(glm::length(along) / spacing_mm - 1.0) <= kNearlyOne)) return false;
    if (!(std::abs(glm::dot(along, next)) <= kNearlyPerpendicular * glm::length(along) * glm::length(next)))
      return false;
    if (!(std::abs(row.lps_from_voxel[3][axis]) <= kFarthestOriginMm)) return false;
  }
  return true;
}

base::Error bad(const char* text) {
  return {"bad_structure", text};
}

// Whether its box and the volume's overlap.
bool touches(const cases::Shape& shape, const CaseRow& row) {
  const volume::Volume grid{row.size_voxels, row.spacing_mm, row.lps_from_voxel, {}};
  const glm::dmat4 voxel_from_lps = volume::voxel_from_lps(grid);
  const cases::Bounds bounds = cases::bounds_of(shape);
  glm::dvec3 low(1e300), high(-1e300);
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 share(corner & 1, (corner >> 1) & 1, corner >> 2);
    const glm::dvec3 p = bounds.low_lps_mm + share * (bounds.high_lps_mm - bounds.low_lps_mm);
    const glm::dvec3 index(voxel_from_lps * glm::dvec4(p, 1.0));
    low = glm::min(low, index);
    high = glm::max(high, index);
  }
  for (int axis = 0; axis < 3; ++axis)
    if (!(high[axis] >= -0.5 && low[axis] <= row.size_voxels[axis] - 0.5)) return false;
  return true;
}

base::Result<void> check_drawn_place(const CaseRow& row, const StructureRow& structure) {
  if (const auto fit = check_drawn(structure.drawn); !fit) return fit.error();
  if (structure.hu && !(*structure.hu >= volume::kAirHu && *structure.hu <= 32767.0))
    return bad("HU are from -1024 to 32767");
  if (!touches(structure.drawn, row)) return bad("the structure lies beside the volume");
  return {};
}

}  // namespace

bool is_sound_name(const std::string& name) {
  return !name.empty() && name.size() <= kMostName && name.front() != ' ' && name.back() != ' ' &&
         on_one_line(name);
}

base::Result<void> check_case_title(const std::string& title) {
  if (!is_sound_name(title) || !is_text(title))
    return base::Error{"bad_title", "a title has 1 to 100 bytes on one line"};
  return {};
}

std::string fitted_title(std::string_view title) {
  std::string fitted;
  while (!title.empty()) {
    const std::string_view rest = title;
    if (!next_character(title)) break;
    const std::string_view one = rest.substr(0, rest.size() - title.size());
    const std::string_view shown = on_one_line(one) ? one : " ";
    if (fitted.empty() && shown == " ") continue;
    if (fitted.size() + shown.size() > kMostName) break;
    fitted += shown;
  }
  fitted.erase(fitted.find_last_not_of(' ') + 1);
  return fitted.empty() ? "untitled" : fitted;
}

bool is_sound_lesion(const CaseRow& row, const cases::LesionForm& form) {
  const volume::Volume grid{row.size_voxels, row.spacing_mm, row.lps_from_voxel, {}};
  // A target larger than the volume is a mistake in the unit.
  const double diagonal_mm = glm::length(glm::dvec3(row.size_voxels) * row.spacing_mm);
  for (int axis = 0; axis < 3; ++axis) {
    if (!(form.radii_mm[axis] > 0.0 && form.radii_mm[axis] <= diagonal_mm)) return false;
    if (!std::isfinite(form.center_lps_mm[axis])) return false;
  }
  // What a voxel can hold; what is added may also take away.
  if (!(form.hu >= (form.adds ? -4000.0 : -1024.0) && form.hu <= 32767.0)) return false;
  if (!(form.roughness >= 0.0 && form.roughness <= cases::kMostRoughness)) return false;
  if (!(form.edge_mm >= 0.0 && form.edge_mm <= 2.0 * std::min({form.radii_mm.x, form.radii_mm.y, form.radii_mm.z})))
    return false;
  return volume::inside(grid, glm::dvec3(volume::voxel_from_lps(grid) * glm::dvec4(form.center_lps_mm, 1.0)));
}

double radius_of(const cases::LesionForm& form) {
  if (form.outline != cases::LesionOutline::ellipsoid) return form.radii_mm.x;
  return std::cbrt(form.radii_mm.x * form.radii_mm.y * form.radii_mm.z);
}

bool is_sound_label_map(const CaseRow& row, const volume::LabelMap& labels) {
  const glm::dvec3 size(row.size_voxels);
  if (labels.names.empty() || labels.names.size() > 256 ||
      static_cast<double>(labels.label.size()) != size.x * size.y * size.z)
    return false;
  return std::all_of(labels.names.begin() + 1, labels.names.end(), is_sound_name) &&
         std::all_of(labels.label.begin(), labels.label.end(),
                     [&](std::uint8_t label) { return label < labels.names.size(); });
}

base::Result<bool> CaseContents::has(volume::TissueClass tissue) {
  if (!classes_) {
    const auto classes = load_classes(database_, load_, row_);
    if (!classes) return classes.error();
    classes_.emplace().fill(false);
    for (const volume::TissueClass one : *classes) (*classes_)[static_cast<std::uint8_t>(one)] = true;
  }
  return (*classes_)[static_cast<std::uint8_t>(tissue)];
}

base::Result<bool> CaseContents::has(const std::string& labels_sha256, int label) {
  if (label < 1 || label > 255) return false;
  auto map = labels_.find(labels_sha256);
  if (map == labels_.end()) {  // one after the other: many would not fit into memory
    const std::vector<std::string> names = label_map_names(database_, row_);
    if (std::ranges::find(names, labels_sha256) == names.end()) return false;
    const auto bytes = load_(labels_sha256);
    if (!bytes) return bytes.error();
    const auto labels = volume::labels_from_bytes(*bytes);
    if (!labels) return labels.error();
    map = labels_.emplace(labels_sha256, Present{}).first;
    for (const std::uint8_t one : labels->label) map->second[one] = true;
  }
  return map->second[static_cast<std::size_t>(label)];
}

base::Result<void> check_place(CaseContents& contents, const CaseRow& row, const StructureRow& structure) {
  if (structure.kind == StructureKind::drawn) return check_drawn_place(row, structure);
  const bool is_label = structure.kind == StructureKind::label;
  const auto there =
      is_label ? contents.has(structure.labels_sha256, structure.label) : contents.has(structure.tissue);
  if (!there) return there.error();
  if (!*there)
    return bad(is_label ? "no voxel of the case's label maps has this label"
                        : "no voxel of the case is of this class");
  return {};
}

bool rows_are_sound(Sqlite& database, const std::string& case_id) {
  for (const TravellingTable& table : travelling_tables())
    if (!values_are_sound(database, table, case_id)) return false;
  std::vector<CaseRow> found;
  try {
    found = read_cases(database, case_id);
  } catch (const base::Failure&) {  // its rule
    return false;
  }
  if (found.size() != 1) return false;
  const CaseRow& row = found.front();
  if (!check_case_title(row.title) || !is_sound_grid(row) || !check_setting(row)) return false;
  if (const auto prepared = find_preparation(database, case_id); prepared && !check_preparation(prepared->settings))
    return false;
  for (const LesionRow& lesion : read_lesions(database, case_id)) {
    const double radius_mm = radius_of(lesion.form);
    if (!is_sound_lesion(row, lesion.form) || !(std::abs(lesion.lesion.radius_mm / radius_mm - 1.0) <= 1e-6))
      return false;
  }
  const auto structures = read_structures(database, case_id);
  return structures && std::all_of(structures->begin(), structures->end(), [&](const StructureRow& one) {
           return is_sound_name(one.name) &&
                  (one.kind != StructureKind::drawn || check_drawn_place(row, one).has_value());
         });
}

}  // namespace seldinger::casedb
