#include <algorithm>
#include <cmath>
#include <glm/mat4x4.hpp>

#include "casedb/cases/authoring.h"
#include "casedb/cases/case_rows.h"
#include "casedb/cases/changeable_case.h"
#include "casedb/cases/setting_columns.h"
#include "casedb/cases/structure_json.h"
#include "casedb/database/audit.h"
#include "casedb/database/new_assets.h"
#include "casedb/database/question.h"
#include "casedb/database/sqlite.h"
#include "casedb/database/uuid.h"
#include "sim/base/check.h"
#include "sim/base/names.h"
#include "sim/volume/volume_bytes.h"

namespace seldinger::casedb {
namespace {

constexpr auto kKinds = base::names<StructureKind>(
    {{StructureKind::tissue_class, "class"}, {StructureKind::label, "label"}, {StructureKind::drawn, "drawn"}});

// Nothing when a text in it is not one that the store writes.
std::optional<StructureRow> read_structure(const Statement& from) {
  StructureRow row;
  row.structure_id = from.text("structure_id");
  row.case_id = from.text("case_id");
  row.position = from.small_integer("position");
  row.name = from.text("title");
  const auto rule = cases::structure_rule_from(from.text("rule"));
  const auto tissue = volume::tissue_of_name(from.text("tissue"));
  if (!rule || !tissue) return std::nullopt;
  row.rule = *rule;
  row.tissue = *tissue;
  const auto kind = base::from_name(kKinds, from.text("kind"));
  if (!kind) return std::nullopt;
  row.kind = *kind;
  if (row.kind == StructureKind::drawn) {
    auto shape = shape_from_json(from.text("geometry"));
    if (!shape) return std::nullopt;
    row.drawn = std::move(*shape);
    if (!from.is_null("hu")) row.hu = from.real("hu");
  }
  if (row.kind == StructureKind::label) {
    row.labels_sha256 = from.text("labels_sha256");
    row.label = from.small_integer("label");
  }
  return row;
}

// Reading classes and labels takes a moment: not to be asked under the write lock.
base::Result<void> check_structure(Library& library, const StructureRow& structure) {
  if (!is_sound_name(structure.name)) return base::Error{"bad_structure", "a name has 1 to 100 bytes on one line"};
  const auto row = find_case(library, structure.case_id);
  if (!row) return row.error();
  CaseContents contents(library.database(), asset_loader(library), *row);
  return check_place(contents, *row, structure);
}

const base::Error kNameTaken{"name_taken", "the case has a structure of that name"};
bool has_name(const std::vector<StructureRow>& structures, const std::string& name) {
  return std::any_of(structures.begin(), structures.end(),
                     [&](const StructureRow& one) { return one.name == name; });
}

void insert_structure(Library& library, const StructureRow& structure, const std::string& structure_id,
                      int position) {
  const bool drawn = structure.kind == StructureKind::drawn, label = structure.kind == StructureKind::label;
  question(library.database(), "add_structure")
      .bind("structure_id", structure_id)
      .bind("case_id", structure.case_id)
      .bind("position", position)
      .bind("title", structure.name)
      .bind("rule", cases::name_of(structure.rule))
      .bind("tissue", volume::about(structure.tissue).name)
      .bind("kind", name_of(structure.kind))
      .bind("geometry", drawn ? std::optional(json_of_shape(structure.drawn)) : std::nullopt)
      .bind("hu", drawn ? structure.hu : std::nullopt)
      .bind("labels_sha256", label ? std::optional(structure.labels_sha256) : std::nullopt)
      .bind("label", label ? std::optional(structure.label) : std::nullopt)
      .bind("created_us", now_us())
      .run();
}

}  // namespace

base::Result<CaseRow> changeable_case(Library& library, const std::string& case_id) {
  auto row = find_case(library, case_id);
  if (!row) return row.error();
  if (row->state != CaseState::draft) return kNotADraft;
  Statement attempts = question(library.database(), "attempts_of_case");
  CHECK(attempts.bind("case_id", case_id).step());
  if (attempts.integer("attempts") > 0)
    return base::Error{"has_attempts",
                       "attempts were made on this draft; `seldinger case version` makes the next one"};
  return row;
}

std::string name_of(StructureKind kind) {
  return std::string(base::name_of(kKinds, kind));
}

base::Result<std::string> add_structure(Library& library, const StructureRow& structure) {
  if (const auto fit = check_structure(library, structure); !fit) return fit.error();
  Transaction transaction(library.database());
  if (const auto row = changeable_case(library, structure.case_id); !row) return row.error();
  const auto others = list_structures(library, structure.case_id);
  if (has_name(others, structure.name)) return kNameTaken;
  std::string structure_id = new_uuid();
  insert_structure(library, structure, structure_id, others.empty() ? 0 : others.back().position + 1);
  audit(library, Act::change_case, {"case", structure.case_id});
  transaction.commit();
  return structure_id;
}

base::Result<void> put_structure(Library& library, const StructureRow& structure) {
  if (const auto fit = check_structure(library, structure); !fit) return fit.error();
  Transaction transaction(library.database());
  if (const auto row = changeable_case(library, structure.case_id); !row) return row.error();
  auto others = list_structures(library, structure.case_id);
  for (const StructureRow& other : others)
    if (other.structure_id == structure.structure_id)
      question(library.database(), "remove_structure")
          .bind("case_id", structure.case_id)
          .bind("title", other.name)
          .run();
  std::erase_if(others, [&](const StructureRow& one) { return one.structure_id == structure.structure_id; });
  if (has_name(others, structure.name)) return kNameTaken;
  const bool taken = std::any_of(others.begin(), others.end(),
                                 [&](const StructureRow& one) { return one.position == structure.position; });
  insert_structure(library, structure, structure.structure_id,
                   taken ? others.back().position + 1 : structure.position);
  audit(library, Act::change_case, {"case", structure.case_id});
  transaction.commit();
  return {};
}

base::Result<void> remove_structure(Library& library, const std::string& case_id, const std::string& name) {
  Transaction transaction(library.database());
  const auto row = changeable_case(library, case_id);
  if (!row) return row.error();
  const auto all = list_structures(library, case_id);
  if (std::none_of(all.begin(), all.end(), [&](const StructureRow& one) { return one.name == name; }))
    return base::Error{"no_structure", "the case has no structure of that name"};
  question(library.database(), "remove_structure").bind("case_id", case_id).bind("title", name).run();
  audit(library, Act::change_case, {"case", case_id});
  transaction.commit();
  return {};
}

std::optional<std::vector<StructureRow>> read_structures(Sqlite& database, const std::string& case_id) {
  std::vector<StructureRow> rows;
  Statement from = question(database, "structures_of_case");
  for (from.bind("case_id", case_id); from.step();) {
    auto row = read_structure(from);
    if (!row) return std::nullopt;
    rows.push_back(std::move(*row));
  }
  return rows;
}

std::vector<StructureRow> list_structures(Library& library, const std::string& case_id) {
  auto rows = read_structures(library.database(), case_id);
  if (!rows) throw base::Failure("database", "a stored structure cannot be read");
  return std::move(*rows);
}

base::Result<std::string> add_label_map(Library& library, const std::string& case_id,
                                        const volume::LabelMap& labels) {
  const base::Error unsound{"bad_labels", "the label map is not one of this case's volume"};
  {
    const auto row = find_case(library, case_id);
    if (!row) return row.error();
    if (!is_sound_label_map(*row, labels)) return unsound;
  }
  NewAssets assets(library);
  std::string sha256 = assets.add(volume::bytes_from_labels(labels));
  Transaction transaction(library.database());
  const auto row = changeable_case(library, case_id);
  if (!row) return row.error();
  Statement there = question(library.database(), "label_maps_of_case");
  bool known = row->labels_sha256 == sha256;
  for (there.bind("case_id", case_id); there.step();) known = known || there.text("labels_sha256") == sha256;
  if (known) return sha256;
  assets.make_sure();
  question(library.database(), "add_label_map")
      .bind("case_id", case_id)
      .bind("labels_sha256", sha256)
      .bind("created_us", now_us())
      .run();
  audit(library, Act::change_case, {"case", case_id});
  transaction.commit();
  assets.keep();
  return sha256;
}

std::vector<std::string> label_map_names(Sqlite& database, const CaseRow& row) {
  std::vector<std::string> names;
  if (!row.labels_sha256.empty()) names.push_back(row.labels_sha256);
  Statement added = question(database, "label_maps_of_case");
  for (added.bind("case_id", row.case_id); added.step();) names.push_back(added.text("labels_sha256"));
  return names;
}

base::Result<std::vector<StoredLabels>> load_label_maps(Library& library, const CaseRow& row) {
  std::vector<StoredLabels> maps;
  if (!row.labels_sha256.empty()) maps.push_back({row.labels_sha256, {}});
  Statement added = question(library.database(), "label_maps_of_case");
  for (added.bind("case_id", row.case_id); added.step();)
    maps.push_back({added.text("labels_sha256"), {}, added.integer("wins") != 0});
  for (StoredLabels& map : maps) {
    const auto bytes = library.load_asset(map.sha256);
    if (!bytes) return bytes.error();
    auto labels = volume::labels_from_bytes(*bytes);
    if (!labels) return labels.error();
    map.labels = std::move(*labels);
  }
  return maps;
}

namespace {

void write_title(Sqlite& database, const std::string& case_id, const std::string& title) {
  question(database, "set_title").bind("case_id", case_id).bind("title", title).run();
}

}  // namespace

base::Result<void> set_setting(Library& library, const std::string& case_id, const CaseSetting& setting,
                               const std::optional<std::string>& title) {
  if (const auto fit = check_setting(setting); !fit) return fit.error();
  if (title)
    if (const auto fit = check_case_title(*title); !fit) return fit.error();
  Transaction transaction(library.database());
  const auto row = changeable_case(library, case_id);
  if (!row) return row.error();
  write_setting(library.database(), case_id, setting);
  if (title) write_title(library.database(), case_id, *title);
  audit(library, Act::change_case, {"case", case_id});
  transaction.commit();
  return {};
}

base::Result<void> set_title(Library& library, const std::string& case_id, const std::string& title) {
  if (const auto fit = check_case_title(title); !fit) return fit.error();
  Transaction transaction(library.database());
  const auto row = find_case(library, case_id);
  if (!row) return row.error();
  if (row->state != CaseState::draft) return kNotADraft;
  write_title(library.database(), case_id, title);
  audit(library, Act::change_case, {"case", case_id});
  transaction.commit();
  return {};
}

base::Result<void> remove_lesion(Library& library, const std::string& case_id, const std::string& lesion_id) {
  Transaction transaction(library.database());
  const auto row = changeable_case(library, case_id);
  if (!row) return row.error();
  const auto all = list_lesions(library, case_id);
  if (std::none_of(all.begin(), all.end(), [&](const LesionRow& one) { return one.lesion_id == lesion_id; }))
    return base::Error{"no_lesion", "there is no such lesion in the case"};
  question(library.database(), "remove_lesion").bind("case_id", case_id).bind("lesion_id", lesion_id).run();
  audit(library, Act::change_case, {"case", case_id});
  transaction.commit();
  return {};
}

}  // namespace seldinger::casedb
