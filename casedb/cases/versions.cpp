#include "casedb/cases/versions.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "casedb/cases/authoring.h"
#include "casedb/cases/case_rows.h"
#include "casedb/cases/permissions.h"
#include "casedb/cases/setting_columns.h"
#include "casedb/database/audit.h"
#include "casedb/database/new_assets.h"
#include "casedb/database/question.h"
#include "casedb/database/sqlite.h"
#include "casedb/database/tables.h"
#include "casedb/database/uuid.h"
#include "sim/base/check.h"
#include "sim/volume/organs/organ_classes.h"
#include "sim/volume/volume_bytes.h"

namespace seldinger::casedb {
namespace {

constexpr const char* kDecisions[] = {"made",     "submitted", "returned",
                                      "approved", "published", "retired"};  // in the order of DecisionKind
constexpr Act kActOf[] = {Act::make_case_version, Act::submit_case,  Act::return_case,
                          Act::approve_case,      Act::publish_case, Act::retire_case};  // likewise
constexpr std::size_t kMostNote = 1000;

base::Error bad_state(const char* text) {
  return {"bad_state", text};
}

// What somebody wants with a case: both known, nothing written yet.
struct Wish {
  CaseRow row;
  Account by;
  std::vector<Decision> decisions;
};
base::Result<Wish> wish(Library& library, const std::string& case_id, const std::string& by,
                        const std::string& note) {
  if (const auto fit = check_note(note); !fit) return fit.error();
  auto row = find_case(library, case_id);
  if (!row) return row.error();
  auto account = acting_account(library, by);
  if (!account) return account.error();
  return Wish{std::move(*row), std::move(*account), list_decisions(library, case_id)};
}

void decide(Library& library, const Wish& wish, DecisionKind kind, const std::string& note) {
  question(library.database(), "add_decision")
      .bind("case_id", wish.row.case_id)
      .bind("decision", name_of(kind))
      .bind("person_id", wish.by.person_id)
      .bind("note", note)
      .bind("decided_us", now_us())
      .bind("by_operator", library.actor().is_operator() ? 1 : 0)
      .run();
  audit(library, kActOf[static_cast<std::size_t>(kind)], {"case", wish.row.case_id});
}

// A decision that was refused is kept, once the transaction of what was refused is over: of a case that there is,
// by somebody who there is.
template <typename T>
T kept(Library& library, DecisionKind kind, const std::string& case_id, T result) {
  if (!result && result.error().code != "bad_note" && result.error().code != "no_user" &&
      find_case(library, case_id))
    audit_alone(library, kActOf[static_cast<std::size_t>(kind)], {"case", case_id}, Outcome::refused);
  return result;
}

void set_state(Library& library, const Wish& wish, CaseState state, bool own_cohort) {
  question(library.database(), "set_state")
      .bind("case_id", wish.row.case_id)
      .bind("state", name_of(state))
      .bind("audience", own_cohort ? "own_cohort" : "everyone")
      .run();
}

// The last decision of this kind; nothing when there is none, or when it was returned since.
const Decision* last_of(const std::vector<Decision>& decisions, DecisionKind kind) {
  const Decision* found = nullptr;
  for (const Decision& one : decisions) {
    if (one.kind == kind) found = &one;
    if (one.kind == DecisionKind::returned) found = nullptr;
  }
  return found;
}

// Whether it is the own work of who wants it. What came in a bundle nobody here has made or submitted: there, who
// approved it stands for that, so that two people of this library have seen it.
bool made_or_submitted(const Wish& wish) {
  const bool came = last_of(wish.decisions, DecisionKind::submitted) == nullptr;
  return std::any_of(wish.decisions.begin(), wish.decisions.end(), [&](const Decision& one) {
    const bool counts = one.kind == DecisionKind::made || one.kind == DecisionKind::submitted ||
                        (came && one.kind == DecisionKind::approved);
    return counts && one.person_id == wish.by.person_id;
  });
}

// A case that comes from a patient is published only when a person has looked for burned-in text.
base::Result<void> check_burned_in(const CaseRow& row) {
  if (row.origin != "import" || row.burned_in_checked) return {};
  return base::Error{"burned_in_unchecked", "nobody has confirmed that the pictures have no burned-in text"};
}

// A quiet breath is 12 mm downwards; what cases of before call one is 16.
constexpr const char* kDepthByNewestBreathLaw =
    "min(3.0, breath_depth * CASE breath_law WHEN 'equal_holds' THEN 16.0 / 12.0 ELSE 1.0 END)";

enum class Copy { next_version, duplicate };

// A volume and skin that a copy gets in place of those of the case.
struct CopyData {
  CaseData data;
  StoredPreparation preparation;
  const std::vector<base::Problem>& warnings;
  NewAssets& assets;
};

// The row of a case and of what belongs to it alone, as they are; columns of later migrations come along.
void copy_case(Sqlite& database, const CaseRow& from, const std::string& case_id, Copy copy_as,
               const CopyData* other) {
  using Column = std::pair<std::string, std::string>;
  std::vector<Column> own = {
      {"case_id", ":case_id"},
      {"state", "'draft'"},
      {"audience", "'everyone'"},
      {"sight_law", "'" + std::string(base::name_of(cases::kSightLawNames, cases::kNewestSightLaw)) + "'"},
      {"touch_law", "'" + std::string(base::name_of(cases::kTouchLawNames, cases::kNewestTouchLaw)) + "'"},
      {"breath_law", "'" + std::string(base::name_of(kBreathLawNames, kNewestBreathLaw)) + "'"},
      {"breath_depth", kDepthByNewestBreathLaw},
      {"created_us", ":created_us"}};
  const bool duplicates = copy_as == Copy::duplicate;
  if (duplicates)
    own.insert(own.end(), {Column{"title", ":title"}, {"family_id", "NULL"}, {"version", "1"}});
  else
    own.insert(
        own.end(),
        {Column{"family_id", "coalesce(family_id, case_id)"},
         {"version",
          "(SELECT max(one.version) + 1 FROM training_case AS one WHERE coalesce(one.family_id, one.case_id) "
          "= coalesce(training_case.family_id, training_case.case_id))"}});
  if (other != nullptr)
    for (const std::string& column : data_columns()) own.emplace_back(column, ":" + column);
  for (const TravellingTable& table : travelling_tables()) {
    if (table.name == "lesion" || table.name == "structure") continue;  // these have ids of their own
    if (other != nullptr && table.name == "case_preparation") continue;
    const bool is_case = table.name == "training_case";
    std::string columns, values;
    for (const std::string& column : columns_of(database, table.name)) {
      const auto found =
          std::find_if(own.begin(), own.end(), [&](const Column& one) { return one.first == column; });
      const bool replaced = found != own.end() && (is_case || column == "case_id");
      const bool wins = table.name == "case_label_map" && column == "wins";  // as in a map that is added now
      if (!columns.empty()) {
        columns += ", ";
        values += ", ";
      }
      columns += column;
      values += replaced ? found->second : wins ? "1" : column;
    }
    if (columns.empty()) continue;
    Statement copy =
        database.prepare("INSERT INTO " + std::string(table.name) + " (" + columns + ") SELECT " + values +
                         " FROM " + std::string(table.name) + " WHERE case_id = :from_case_id");
    copy.bind("case_id", case_id).bind("from_case_id", from.case_id);
    if (is_case) copy.bind("created_us", now_us());
    if (is_case && duplicates) copy.bind("title", fitted_title("Copy of " + from.title));
    if (is_case && other != nullptr) bind_data(copy, other->data);
    copy.run();
  }
  if (other == nullptr) return;
  add_preparation(database, case_id, other->preparation);
  question(database, "remove_preparation_warnings")
      .bind("case_id", case_id)
      .bind("from_case_id", from.case_id)
      .run();
  Statement warning = question(database, "add_later_warning");
  for (const base::Problem& one : other->warnings)
    warning.bind("case_id", case_id).bind("code", one.code).bind("text", one.text).run();
}

}  // namespace

base::Result<void> check_note(const std::string& note) {
  const bool sound = note.size() <= kMostNote && std::none_of(note.begin(), note.end(), [](char c) {
                       return static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
                     });
  if (!sound) return base::Error{"bad_note", "a note is one line of at most 1000 bytes"};
  return {};
}

std::string name_of(DecisionKind kind) {
  return kDecisions[static_cast<std::size_t>(kind)];
}

std::string Decision::who() const {
  return by_operator.value_or(false) ? pseudonym + " (entered by the operator)" : pseudonym;
}

std::vector<Decision> list_decisions(Library& library, const std::string& case_id) {
  std::vector<Decision> decisions;
  Statement from = question(library.database(), "decisions_of_case");
  for (from.bind("case_id", case_id); from.step();) {
    Decision& one = decisions.emplace_back();
    for (std::size_t kind = 0; kind < std::size(kDecisions); ++kind)
      if (from.text("decision") == kDecisions[kind]) one.kind = static_cast<DecisionKind>(kind);
    one.person_id = from.text("person_id");
    one.pseudonym = from.text("pseudonym");
    one.note = from.text("note");
    one.decided_us = from.integer("decided_us");
    if (!from.is_null("by_operator")) one.by_operator = from.integer("by_operator") != 0;
  }
  return decisions;
}

std::optional<Decision> review_of(const std::vector<Decision>& decisions) {
  const Decision* approved = last_of(decisions, DecisionKind::approved);
  return approved == nullptr ? std::nullopt : std::optional(*approved);
}

namespace {

base::Result<void> try_to_submit(Library& library, const std::string& case_id, const std::string& by,
                                 const std::string& note) {
  Transaction transaction(library.database());
  const auto wanted = wish(library, case_id, by, note);
  if (!wanted) return wanted.error();
  if (const auto allowed = allow(wanted->by.role, Action::submit_case); !allowed) return allowed.error();
  if (wanted->row.state != CaseState::draft) return bad_state("only a draft is submitted to review");
  decide(library, *wanted, DecisionKind::submitted, note);
  set_state(library, *wanted, CaseState::review, false);
  transaction.commit();
  return {};
}

base::Result<void> try_to_judge(Library& library, const std::string& case_id, const std::string& by, bool approve,
                                const std::string& note) {
  Transaction transaction(library.database());
  const auto wanted = wish(library, case_id, by, note);
  if (!wanted) return wanted.error();
  const Action action = approve ? Action::approve_case : Action::return_case;
  if (const auto allowed = allow(wanted->by.role, action); !allowed) return allowed.error();
  if (wanted->row.state != CaseState::review) return bad_state("the case is not in review");
  // Whoever submitted it may take it back, but not approve it. Nobody here submitted what came in a bundle.
  const Decision* submitted = last_of(wanted->decisions, DecisionKind::submitted);
  const bool own = submitted != nullptr && submitted->person_id == wanted->by.person_id;
  if (const auto allowed = allow(wanted->by.role, action, Subject::whose(own)); !allowed) return allowed.error();
  decide(library, *wanted, approve ? DecisionKind::approved : DecisionKind::returned, note);
  if (!approve) {
    set_state(library, *wanted, CaseState::draft, false);
    for (const char* law : {"take_newest_breath_law", "take_newest_touch_law"})
      question(library.database(), law).bind("case_id", case_id).run();
  }
  transaction.commit();
  return {};
}

base::Result<void> try_to_publish(Library& library, const std::string& case_id, const CaseCheck& check,
                                  const std::string& by, bool own_cohort, const std::string& note) {
  if (const auto ready = ready_to_publish(check); !ready) return ready.error();
  Transaction transaction(library.database());
  const auto wanted = wish(library, case_id, by, note);
  if (!wanted) return wanted.error();
  if (wanted->row.state != CaseState::draft && wanted->row.state != CaseState::review)
    return bad_state("only a draft or a case in review is published");
  const bool reviewed = wanted->row.state == CaseState::review && review_of(wanted->decisions).has_value();
  const Action action = reviewed ? Action::publish_reviewed_case : Action::publish_unreviewed_case;
  if (const auto allowed = allow(wanted->by.role, action, Subject::whose(made_or_submitted(*wanted))); !allowed)
    return allowed.error();
  if (!reviewed && !own_cohort)
    return base::Error{
        "not_allowed",
        "no second person has approved the case; a mentor may publish it so to their own cohort only"};
  if (const auto fit = check_burned_in(wanted->row); !fit) return fit.error();
  if (check.content_mark != content_mark(library, case_id))
    return base::Error{"checks_failed", "the case has changed since it was checked: check it again"};
  decide(library, *wanted, DecisionKind::published, note);
  set_state(library, *wanted, CaseState::published, !reviewed);
  if (!reviewed) {
    int cohorts = 0;
    {
      Statement insert = question(library.database(), "add_case_cohorts");
      insert.bind("case_id", case_id).bind("person_id", wanted->by.person_id);
      while (insert.step()) ++cohorts;
    }
    if (cohorts == 0) return base::Error{"no_cohort", "you lead no cohort that the case could reach"};
  }
  transaction.commit();
  return {};
}

base::Result<void> try_to_retire(Library& library, const std::string& case_id, const std::string& by,
                                 const std::string& note) {
  Transaction transaction(library.database());
  const auto wanted = wish(library, case_id, by, note);
  if (!wanted) return wanted.error();
  const Decision* published = last_of(wanted->decisions, DecisionKind::published);
  const bool own = published != nullptr && published->person_id == wanted->by.person_id;
  if (const auto allowed = allow(wanted->by.role, Action::retire_case, Subject::whose(own)); !allowed)
    return allowed.error();
  if (wanted->row.state != CaseState::published) return bad_state("only a published case is retired");
  decide(library, *wanted, DecisionKind::retired, note);
  set_state(library, *wanted, CaseState::retired, wanted->row.own_cohort_only);
  transaction.commit();
  return {};
}

// Of a copy with another volume: what a bundle of it would be refused for.
base::Result<void> check_what_is_left(Library& library, const CaseRow& row, const std::vector<LesionRow>& lesions,
                                      const std::vector<StructureRow>& structures) {
  for (const LesionRow& lesion : lesions)
    if (!is_sound_lesion(row, lesion.form))
      return base::Error{"bad_preparation", "a lesion of the case would lie outside what is left of the CT"};
  CaseContents contents(
      library.database(), [&](const std::string& sha256) { return library.load_asset(sha256); }, row);
  for (const StructureRow& structure : structures)
    if (structure.kind != StructureKind::label && !check_place(contents, row, structure))  // maps stay as they are
      return base::Error{"bad_preparation",
                         "nothing of the structure " + structure.name + " would be left in the CT"};
  return {};
}

base::Result<std::string> try_to_copy(Library& library, const std::string& case_id, const std::string& by,
                                      Copy copy_as, const CopyData* other = nullptr) {
  Transaction transaction(library.database());
  auto wanted = wish(library, case_id, by, {});
  if (!wanted) return wanted.error();
  if (const auto allowed = allow(wanted->by.role, Action::make_case_version); !allowed) return allowed.error();
  Sqlite& database = library.database();
  const auto lesions = list_lesions(library, case_id);
  const auto structures = list_structures(library, case_id);
  const std::string made = new_uuid();
  if (other != nullptr) other->assets.make_sure();
  copy_case(database, wanted->row, made, copy_as, other);
  const CaseRow row = read_cases(database, made).at(0);
  if (other != nullptr)  // else all lies where it lay, also what no command would take today
    if (const auto left = check_what_is_left(library, row, lesions, structures); !left) return left.error();
  for (const LesionRow& lesion : lesions)
    question(database, "copy_lesion")
        .bind("case_id", made)
        .bind("lesion_id", new_uuid())
        .bind("from_lesion_id", lesion.lesion_id)
        .run();
  for (const StructureRow& structure : structures)
    question(database, "copy_structure")
        .bind("case_id", made)
        .bind("structure_id", new_uuid())
        .bind("from_structure_id", structure.structure_id)
        .run();
  wanted->row.case_id = made;
  decide(library, *wanted, DecisionKind::made, {});
  transaction.commit();
  return made;
}

}  // namespace

base::Result<void> submit_case(Library& library, const std::string& case_id, const std::string& by,
                               const std::string& note) {
  return kept(library, DecisionKind::submitted, case_id, try_to_submit(library, case_id, by, note));
}

base::Result<void> judge_case(Library& library, const std::string& case_id, const std::string& by, bool approve,
                              const std::string& note) {
  return kept(library, approve ? DecisionKind::approved : DecisionKind::returned, case_id,
              try_to_judge(library, case_id, by, approve, note));
}

base::Result<void> publish_case(Library& library, const std::string& case_id, const CaseCheck& check,
                                const std::string& by, bool own_cohort, const std::string& note) {
  return kept(library, DecisionKind::published, case_id,
              try_to_publish(library, case_id, check, by, own_cohort, note));
}

base::Result<void> retire_case(Library& library, const std::string& case_id, const std::string& by,
                               const std::string& note) {
  return kept(library, DecisionKind::retired, case_id, try_to_retire(library, case_id, by, note));
}

base::Result<std::string> new_version(Library& library, const std::string& case_id, const std::string& by) {
  return kept(library, DecisionKind::made, case_id, try_to_copy(library, case_id, by, Copy::next_version));
}

base::Result<std::string> add_prepared_copy(Library& library, const std::string& case_id,
                                            const PreparedCopy& prepared, const std::string& by) {
  const auto from = find_case(library, case_id);
  if (!from) return from.error();
  const bool same_grid =
      from->size_voxels == prepared.volume.size_voxels && from->lps_from_voxel == prepared.volume.lps_from_voxel;
  std::optional<volume::LabelMap> labels;
  if (!from->labels_sha256.empty()) {
    auto loaded = load_labels(library, *from);
    if (!loaded) return loaded.error();
    labels = std::move(*loaded);
  }
  const auto has_maps = [&] {
    return labels || question(library.database(), "label_maps_of_case").bind("case_id", case_id).step();
  };
  if (!same_grid && has_maps())
    return base::Error{"bad_preparation", "a case with label maps is not shrunk: they are of its voxels"};
  const auto before = find_preparation(library.database(), case_id);
  NewAssets assets(library);
  const std::string volume_sha256 = assets.add(volume::bytes_from_volume(prepared.volume)),
                    skin_sha256 = assets.add(cases::bytes_from_mesh(prepared.skin)),
                    classes_sha256 = assets.add(volume::bytes_from_classes(
                        volume::classes_with_organs(prepared.volume, labels ? &*labels : nullptr)));
  const CopyData other{{prepared.volume, volume_sha256, skin_sha256, classes_sha256},
                       {prepared.settings, before ? before->original_sha256 : from->volume_sha256},
                       prepared.warnings,
                       assets};
  const auto made =
      kept(library, DecisionKind::made, case_id, try_to_copy(library, case_id, by, Copy::duplicate, &other));
  if (made) assets.keep();
  return made;
}

base::Result<std::string> duplicate_case(Library& library, const std::string& case_id, const std::string& by) {
  return kept(library, DecisionKind::made, case_id, try_to_copy(library, case_id, by, Copy::duplicate));
}

}  // namespace seldinger::casedb
