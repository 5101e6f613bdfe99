#include "casedb/people/relations.h"

#include "casedb/database/question.h"
#include "casedb/database/sqlite.h"
#include "casedb/database/uuid.h"
#include "sim/base/check.h"

namespace seldinger::casedb {

std::unordered_map<std::string, Relation> relations_of(Library& library, const std::string& reader_id) {
  std::unordered_map<std::string, Relation> relations;
  Statement rows = question(library.database(), "relations");
  for (rows.bind("reader", reader_id); rows.step();) {
    Relation relation;
    relation.own = rows.integer("own") != 0;
    relation.own_cohort = rows.integer("own_cohort") != 0;
    relation.own_programme = rows.integer("own_programme") != 0;
    relation.own_study = rows.integer("own_study") != 0;
    relations.emplace(rows.text("person_id"), relation);
  }
  return relations;
}

Relation relation_to(Library& library, const std::string& reader_id, const std::optional<std::string>& person_id) {
  Relation relation;
  relation.nobodys = !person_id.has_value();
  if (relation.nobodys) return relation;
  const auto all = relations_of(library, reader_id);
  const auto found = all.find(*person_id);
  return found == all.end() ? relation : found->second;
}

Relation relation_to_cohort(Library& library, const std::string& reader_id, const std::string& cohort_id,
                            const std::string& programme) {
  Statement row = question(library.database(), "relation_to_cohort");
  CHECK(row.bind("reader", reader_id).bind("cohort_id", cohort_id).bind("programme", programme).step());
  Relation relation;
  relation.own_cohort = row.integer("leads") != 0;
  relation.own_programme = row.integer("directs") != 0;
  return relation;
}

bool reaches_own_cohort(Library& library, const std::string& case_id, const std::string& person_id) {
  Statement row = question(library.database(), "case_reaches");
  CHECK(row.bind("case_id", case_id).bind("person_id", person_id).step());
  return row.integer("reaches") != 0;
}

}  // namespace seldinger::casedb
