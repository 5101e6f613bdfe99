#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <unordered_map>

#include "casedb/cases/authoring.h"
#include "casedb/cases/case_rows.h"
#include "casedb/cases/cases.h"
#include "casedb/cases/changeable_case.h"
#include "casedb/cases/classed_case.h"
#include "casedb/cases/setting_columns.h"
#include "casedb/database/audit.h"
#include "casedb/database/new_assets.h"
#include "casedb/database/question.h"
#include "casedb/database/sqlite.h"
#include "casedb/database/uuid.h"
#include "sim/base/check.h"
#include "sim/volume/organs/organ_classes.h"
#include "sim/volume/tissue/find_tissue.h"
#include "sim/volume/volume_bytes.h"

namespace seldinger::casedb {
namespace {

constexpr const char* kAxes[] = {"x", "y", "z"};

std::string matrix_column(int row, int column) {
  return "lps_from_voxel_" + std::to_string(row) + std::to_string(column);
}

void insert_case(Library& library, const NewCase& new_case, const std::string& case_id, std::int64_t created_us,
                 const std::optional<std::string>& labels_sha256, const CaseData& data) {
  Sqlite& database = library.database();
  const bool by_operator = library.actor().is_operator();
  Statement insert = question(database, "add_case");
  insert.bind("case_id", case_id).bind("title", new_case.title).bind("state", name_of(CaseState::draft));
  insert.bind("origin", new_case.origin).bind("created_us", created_us).bind("slices_used", new_case.slices_used);
  bind_data(insert, data);
  insert.bind("face_state", name_of(new_case.face_state));
  insert.bind("burned_in_checked_us", new_case.no_burned_in_text ? std::optional(created_us) : std::nullopt);
  insert.bind("burned_in_checked_by", new_case.burned_in_checked_by);
  insert.bind("burned_in_by_operator", by_operator && new_case.no_burned_in_text ? std::optional(1) : std::nullopt);
  insert.bind_null("family_id").bind("version", 1);
  insert.bind("labels_sha256", labels_sha256).run();
  write_setting(database, case_id, new_case);

  Statement attribute = question(database, "add_case_attribute");
  for (std::size_t i = 0; i < new_case.attributes.size(); ++i)
    attribute.bind("case_id", case_id)
        .bind("position", static_cast<std::int64_t>(i))
        .bind("name", new_case.attributes[i].first)
        .bind("value", new_case.attributes[i].second)
        .run();
  std::vector<base::Problem> warnings = new_case.warnings;
  if (!new_case.face_overruled.empty()) warnings.push_back({"face_overruled", new_case.face_overruled});
  Statement warning = question(database, "add_case_warning");
  for (std::size_t i = 0; i < warnings.size(); ++i)
    warning.bind("case_id", case_id)
        .bind("position", static_cast<std::int64_t>(i))
        .bind("code", warnings[i].code)
        .bind("text", warnings[i].text)
        .run();
  Statement dropped = question(database, "add_case_dropped");
  for (std::size_t i = 0; i < new_case.dropped.size(); ++i)
    dropped.bind("case_id", case_id)
        .bind("position", static_cast<std::int64_t>(i))
        .bind("tag", new_case.dropped[i].tag)
        .bind("keyword", new_case.dropped[i].keyword)
        .bind("reason", new_case.dropped[i].reason)
        .bind("count", new_case.dropped[i].count)
        .run();
}

// Put together once: a list of thousands of cases asks for them again and again.
struct GridColumns {
  std::string size[3], spacing[3], matrix[3][4];
  GridColumns() {
    for (int axis = 0; axis < 3; ++axis) {
      size[axis] = std::string("size_") + kAxes[axis] + "_voxels";
      spacing[axis] = std::string("spacing_") + kAxes[axis] + "_mm";
      for (int column = 0; column < 4; ++column) matrix[axis][column] = matrix_column(axis, column);
    }
  }
};

CaseRow read_case(const Statement& from) {
  CaseRow row;
  row.case_id = from.text("case_id");
  row.title = from.text("title");
  row.state = *case_state_from(from.view("state"));  // the schema takes no others
  row.origin = from.text("origin");
  row.created_us = from.integer("created_us");
  static const GridColumns names;
  for (int axis = 0; axis < 3; ++axis) {
    row.size_voxels[axis] = from.small_integer(names.size[axis]);
    row.spacing_mm[axis] = from.real(names.spacing[axis]);
    for (int column = 0; column < 4; ++column)
      row.lps_from_voxel[column][axis] = from.real(names.matrix[axis][column]);
  }
  row.hu_min = from.small_integer("hu_min");
  row.hu_max = from.small_integer("hu_max");
  row.slices_used = from.small_integer("slices_used");
  row.volume_sha256 = from.text("volume_sha256");
  row.skin_sha256 = from.text("skin_sha256");
  row.labels_sha256 = from.text("labels_sha256");
  row.classes_sha256 = from.text("classes_sha256");
  read_setting(from, row);
  row.family_id = from.is_null("family_id") ? row.case_id : from.text("family_id");
  row.version = from.small_integer("version");
  row.own_cohort_only = from.text("audience") == "own_cohort";
  row.face_state = *face_state_from(from.text("face_state"));  // the schema takes no others
  if (!from.is_null("burned_in_checked_us")) {
    row.burned_in_checked = BurnedInCheck{from.integer("burned_in_checked_us"), {}, false};
    row.burned_in_checked->by_operator =
        !from.is_null("burned_in_by_operator") && from.integer("burned_in_by_operator") != 0;
    if (!from.is_null("burned_in_checked_by")) row.burned_in_checked->person_id = from.text("burned_in_checked_by");
  }
  return row;
}

// Every case, or the one; without what lies in tables of its own.
std::vector<CaseRow> read_heads(Sqlite& database, const std::optional<std::string>& case_id) {
  std::vector<CaseRow> rows;
  Statement cases = question(database, "cases");
  for (cases.bind("case_id", case_id); cases.step();) rows.push_back(read_case(cases));
  return rows;
}

base::Result<void> check_lesion(Library& library, const std::string& case_id, const cases::LesionForm& form) {
  const auto row = find_case(library, case_id);
  if (!row) return row.error();
  if (row->state != CaseState::draft) return kNotADraft;
  if (!is_sound_lesion(*row, form))
    return base::Error{"bad_lesion",
                       "a lesion needs a centre inside the volume, a radius above 0 that the volume can hold, HU "
                       "from -1024 to 32767, roughness from 0 to 0.3 and an edge no wider than the lesion"};
  return {};
}

void insert_lesion(Sqlite& database, const LesionRow& lesion) {
  const cases::LesionForm& form = lesion.form;
  const bool ellipsoid = form.outline == cases::LesionOutline::ellipsoid;
  question(database, "add_lesion")
      .bind("lesion_id", lesion.lesion_id)
      .bind("case_id", lesion.case_id)
      .bind("center_x_lps_mm", form.center_lps_mm.x)
      .bind("center_y_lps_mm", form.center_lps_mm.y)
      .bind("center_z_lps_mm", form.center_lps_mm.z)
      .bind("radius_mm", radius_of(form))
      .bind("hu", form.hu)
      .bind("kind", base::name_of(cases::kLesionOutlineNames, form.outline))
      .bind("lesion_kind", base::name_of(cases::kLesionKindNames, form.kind))
      .bind("radius_x_mm", ellipsoid ? std::optional(form.radii_mm.x) : std::nullopt)
      .bind("radius_y_mm", ellipsoid ? std::optional(form.radii_mm.y) : std::nullopt)
      .bind("radius_z_mm", ellipsoid ? std::optional(form.radii_mm.z) : std::nullopt)
      .bind("roughness", form.roughness)
      .bind("seed", std::bit_cast<std::int64_t>(form.seed))
      .bind("adds", form.adds ? 1 : 0)
      .bind("edge_mm", form.edge_mm)
      .bind("created_us", lesion.created_us)
      .run();
}

}  // namespace

std::vector<std::string> data_columns() {
  std::vector<std::string> columns = {"hu_min", "hu_max", "volume_sha256", "skin_sha256", "classes_sha256"};
  const GridColumns names;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    columns.insert(columns.end(), {names.size[axis], names.spacing[axis]});
    columns.insert(columns.end(), std::begin(names.matrix[axis]), std::end(names.matrix[axis]));
  }
  return columns;
}

void bind_data(Statement& statement, const CaseData& data) {
  const GridColumns names;
  for (int axis = 0; axis < 3; ++axis) {
    statement.bind(names.size[axis], data.volume.size_voxels[axis]);
    statement.bind(names.spacing[axis], data.volume.spacing_mm[axis]);
    for (int column = 0; column < 4; ++column)
      statement.bind(names.matrix[axis][column], data.volume.lps_from_voxel[column][axis]);
  }
  const auto [lowest, highest] = std::minmax_element(data.volume.hu.begin(), data.volume.hu.end());
  statement.bind("hu_min", int{*lowest}).bind("hu_max", int{*highest});
  statement.bind("volume_sha256", data.volume_sha256).bind("skin_sha256", data.skin_sha256);
  statement.bind("classes_sha256", data.classes_sha256);
}

std::vector<CaseRow> read_cases(Sqlite& database, const std::optional<std::string>& case_id) {
  std::vector<CaseRow> rows = read_heads(database, case_id);
  std::unordered_map<std::string, std::size_t> place;
  for (std::size_t at = 0; at < rows.size(); ++at) place.emplace(rows[at].case_id, at);
  // They come case by case, so that a case is looked up once; one added between two questions is not in `place`.
  CaseRow* row = nullptr;
  const auto belongs = [&](const Statement& from) {
    const std::string_view id = from.view("case_id");
    if (row != nullptr && row->case_id == id) return true;
    const auto at = place.find(std::string(id));
    row = at == place.end() ? nullptr : &rows[at->second];
    return row != nullptr;
  };
  Statement attributes = question(database, "case_attributes");
  for (attributes.bind("case_id", case_id); attributes.step();)
    if (belongs(attributes)) row->attributes.emplace_back(attributes.text("name"), attributes.text("value"));
  Statement warnings = question(database, "case_warnings");
  for (warnings.bind("case_id", case_id); warnings.step();)
    if (belongs(warnings)) row->warnings.push_back({warnings.text("code"), warnings.text("text")});
  Statement dropped = question(database, "case_dropped");
  for (dropped.bind("case_id", case_id); dropped.step();)
    if (belongs(dropped))
      row->dropped.push_back(
          {dropped.text("tag"), dropped.text("keyword"), dropped.text("reason"), dropped.integer("count")});
  return rows;
}

std::string name_of(cases::Modality modality) {
  return std::string(base::name_of(cases::kModalityNames, modality));
}

std::optional<cases::Modality> modality_from(const std::string& name) {
  return base::from_name(cases::kModalityNames, name);
}

std::string modality_names() {
  return base::listed(base::kNamesOf<cases::kModalityNames>);
}

std::string name_of(cases::PatientPosition position) {
  return std::string(base::name_of(cases::kPatientPositionNames, position));
}

std::optional<cases::PatientPosition> position_from(const std::string& name) {
  return base::from_name(cases::kPatientPositionNames, name);
}

std::string add_case(Library& library, const NewCase& new_case) {
  return add_case(library, new_case,
                  volume::classes_with_organs(new_case.volume, new_case.labels ? &*new_case.labels : nullptr));
}

std::string add_case(Library& library, const NewCase& new_case, const std::vector<volume::TissueClass>& classes) {
  const volume::Volume& volume = new_case.volume;
  const std::size_t voxels = static_cast<std::size_t>(volume.size_voxels.x) *
                             static_cast<std::size_t>(volume.size_voxels.y) *
                             static_cast<std::size_t>(volume.size_voxels.z);
  CHECK(voxels > 0 && volume.hu.size() == voxels);
  CHECK(!new_case.labels || new_case.labels->label.size() == voxels);
  CHECK(classes.size() == voxels);
  CHECK(check_case_title(new_case.title));

  NewAssets assets(library);
  const std::string volume_sha256 = assets.add(volume::bytes_from_volume(volume));
  const std::string skin_sha256 = assets.add(cases::bytes_from_mesh(new_case.skin));
  std::optional<std::string> labels_sha256;
  if (new_case.labels) labels_sha256 = assets.add(volume::bytes_from_labels(*new_case.labels));
  std::string original_sha256;
  if (new_case.prepared) original_sha256 = assets.add(volume::bytes_from_volume(new_case.prepared->original));
  const std::string classes_sha256 = assets.add(volume::bytes_from_classes(classes));

  Transaction transaction(library.database());
  assets.make_sure();
  const std::int64_t created_us = now_us();
  const std::string case_id = new_uuid();
  insert_case(library, new_case, case_id, created_us, labels_sha256,
              {volume, volume_sha256, skin_sha256, classes_sha256});
  if (new_case.prepared)
    add_preparation(library.database(), case_id, {new_case.prepared->settings, original_sha256});
  audit(library, Act::add_case, {"case", case_id});
  if (new_case.burned_in_checked_by) audit(library, Act::confirm_no_burned_in_text, {"case", case_id});
  if (!new_case.face_overruled.empty()) audit(library, Act::overrule_face, {"case", case_id});
  transaction.commit();
  assets.keep();
  return case_id;
}

std::vector<CaseRow> list_case_heads(Library& library) {
  return read_heads(library.database(), std::nullopt);
}

std::vector<CaseRow> list_cases(Library& library) {
  return read_cases(library.database(), std::nullopt);
}

base::Result<CaseRow> find_case(Library& library, const std::string& case_id) {
  std::vector<CaseRow> rows = read_cases(library.database(), case_id);
  if (rows.empty()) return base::Error{"no_case", "there is no such case in the library"};
  return std::move(rows.front());
}

base::Result<volume::Volume> load_volume(Library& library, const CaseRow& row) {
  const auto bytes = library.load_asset(row.volume_sha256);
  if (!bytes) return bytes.error();
  return volume::volume_from_bytes(*bytes);
}

base::Result<cases::Mesh> load_skin(Library& library, const CaseRow& row) {
  const auto bytes = library.load_asset(row.skin_sha256);
  if (!bytes) return bytes.error();
  return cases::mesh_from_bytes(*bytes);
}

base::Result<volume::LabelMap> load_labels(Library& library, const CaseRow& row) {
  if (row.labels_sha256.empty()) return base::Error{"no_labels", "the case has no labels"};
  const auto bytes = library.load_asset(row.labels_sha256);
  if (!bytes) return bytes.error();
  return volume::labels_from_bytes(*bytes);
}

namespace {

base::Result<std::vector<volume::TissueClass>> stored_classes(const LoadAsset& load, const CaseRow& row) {
  if (!row.classes_sha256.empty()) {
    const auto bytes = load(row.classes_sha256);
    if (!bytes) return bytes.error();
    const glm::dvec3 size(row.size_voxels);
    return volume::classes_from_bytes(*bytes, static_cast<std::size_t>(size.x * size.y * size.z));
  }
  const auto volume_bytes = load(row.volume_sha256);
  if (!volume_bytes) return volume_bytes.error();
  const auto volume = volume::volume_from_bytes(*volume_bytes);
  if (!volume) return volume.error();
  if (row.labels_sha256.empty()) return volume::tissue_classes_by_rule_1(*volume);
  const auto label_bytes = load(row.labels_sha256);
  if (!label_bytes) return label_bytes.error();
  const auto labels = volume::labels_from_bytes(*label_bytes);
  if (!labels) return labels.error();
  if (labels->label.size() != volume->hu.size())
    return base::Error{"damaged", "the stored labels are not the volume's"};
  return volume::tissue_classes_by_rule_1(*volume, &*labels);
}

}  // namespace

LoadAsset asset_loader(const Library& library) {
  return [&library](const std::string& sha256) { return library.load_asset(sha256); };
}

base::Result<std::vector<volume::TissueClass>> load_classes(Library& library, const CaseRow& row) {
  return load_classes(library.database(), asset_loader(library), row);
}

base::Result<std::vector<volume::TissueClass>> load_classes(Sqlite& database, const LoadAsset& load,
                                                            const CaseRow& row) {
  auto classes = stored_classes(load, row);
  if (!classes) return classes;
  Statement maps = question(database, "label_maps_of_case");
  for (maps.bind("case_id", row.case_id); maps.step();) {
    if (maps.integer("wins") == 0) continue;
    const auto bytes = load(maps.text("labels_sha256"));
    if (!bytes) return bytes.error();
    const auto labels = volume::labels_from_bytes(*bytes);
    if (!labels) return labels.error();
    if (labels->label.size() != classes->size())
      return base::Error{"damaged", "the stored labels are not the volume's"};
    volume::let_labels_win(*labels, *classes);
  }
  return classes;
}

base::Result<void> confirm_no_burned_in_text(Library& library, const std::string& case_id,
                                             const std::optional<std::string>& person_id) {
  Transaction transaction(library.database());
  if (const auto row = find_case(library, case_id); !row) return row.error();
  if (person_id) {
    Statement person = question(library.database(), "person_exists");
    CHECK(person.bind("person_id", *person_id).step());
    if (person.integer("found") == 0) return base::Error{"no_person", "there is no such person"};
  }
  question(library.database(), "confirm_no_burned_in_text")
      .bind("case_id", case_id)
      .bind("checked_us", now_us())
      .bind("person_id", person_id)
      .bind("by_operator", library.actor().is_operator() ? 1 : 0)
      .run();
  audit(library, Act::confirm_no_burned_in_text, {"case", case_id});
  transaction.commit();
  return {};
}

base::Result<std::string> add_lesion(Library& library, const std::string& case_id, const cases::Lesion& lesion) {
  cases::LesionForm form;
  form.center_lps_mm = lesion.center_lps_mm;
  form.radii_mm = glm::dvec3(lesion.radius_mm);
  form.hu = lesion.hu;
  form.kind = lesion.kind;
  return add_lesion(library, case_id, form);
}

base::Result<std::string> add_lesion(Library& library, const std::string& case_id, const cases::LesionForm& form) {
  Transaction transaction(library.database());
  if (const auto fit = check_lesion(library, case_id, form); !fit) return fit.error();
  LesionRow lesion;
  lesion.lesion_id = new_uuid();
  lesion.case_id = case_id;
  lesion.form = form;
  lesion.created_us = now_us();
  insert_lesion(library.database(), lesion);
  audit(library, Act::change_case, {"case", case_id});
  transaction.commit();
  return lesion.lesion_id;
}

base::Result<void> put_lesion(Library& library, const LesionRow& lesion) {
  Transaction transaction(library.database());
  if (const auto fit = check_lesion(library, lesion.case_id, lesion.form); !fit) return fit.error();
  if (const auto row = changeable_case(library, lesion.case_id); !row) return row.error();
  question(library.database(), "remove_lesion")
      .bind("case_id", lesion.case_id)
      .bind("lesion_id", lesion.lesion_id)
      .run();
  insert_lesion(library.database(), lesion);
  audit(library, Act::change_case, {"case", lesion.case_id});
  transaction.commit();
  return {};
}

std::vector<LesionRow> list_lesions(Library& library, const std::optional<std::string>& case_id) {
  return read_lesions(library.database(), case_id);
}

std::vector<LesionRow> read_lesions(Sqlite& database, const std::optional<std::string>& case_id) {
  std::vector<LesionRow> rows;
  Statement lesions = question(database, "lesions_of_case");
  for (lesions.bind("case_id", case_id); lesions.step();) {
    LesionRow& row = rows.emplace_back();
    row.lesion_id = lesions.text("lesion_id");
    row.case_id = lesions.text("case_id");
    row.lesion.center_lps_mm = {lesions.real("center_x_lps_mm"), lesions.real("center_y_lps_mm"),
                                lesions.real("center_z_lps_mm")};
    row.lesion.radius_mm = lesions.real("radius_mm");
    row.lesion.hu = lesions.real("hu");
    row.created_us = lesions.integer("created_us");
    cases::LesionForm& form = row.form;
    // The schema takes no others.
    form.outline = *base::from_name(cases::kLesionOutlineNames, lesions.view("kind"));
    form.kind = row.lesion.kind = *base::from_name(cases::kLesionKindNames, lesions.view("lesion_kind"));
    form.center_lps_mm = row.lesion.center_lps_mm;
    form.radii_mm = glm::dvec3(row.lesion.radius_mm);
    if (form.outline == cases::LesionOutline::ellipsoid)
      form.radii_mm = {lesions.real("radius_x_mm"), lesions.real("radius_y_mm"), lesions.real("radius_z_mm")};
    form.hu = row.lesion.hu;
    form.roughness = lesions.real("roughness");
    form.seed = std::bit_cast<std::uint64_t>(lesions.integer("seed"));
    form.adds = lesions.integer("adds") != 0;
    form.edge_mm = lesions.real("edge_mm");
  }
  return rows;
}

}  // namespace seldinger::casedb
