#include "app/questionnaires/acting_in_round.h"

#include "casedb/people/consent.h"
#include "casedb/studies/looks.h"
#include "casedb/studies/plans.h"

namespace seldinger::app {

base::Result<casedb::Round> round_to_read(casedb::Library& library, const Arguments& arguments) {
  auto round = casedb::find_round(library, arguments.positional(0));
  casedb::Relation relation;
  const auto& whose = library.actor().person_id;
  relation.own = round && whose && round->opened_by == whose;
  relation.own_study =
      round && whose && round->study_id && casedb::is_researcher_of(library, *round->study_id, *whose);
  if (const auto by = acting(library, arguments, casedb::Action::see_responses, relation); !by) return by.error();
  return round;
}

base::Result<void> note_export(casedb::Library& library, const casedb::Round& round, std::size_t count) {
  const auto& study = round.study_id;
  const auto& whose = library.actor().person_id;
  const bool draft = study && casedb::has_draft(library, *study);
  if (draft && whose && casedb::is_researcher_of(library, *study, *whose))
    return base::Error{"blinded",
                       "until the plan is frozen nobody who works on the study may see answers by group"};
  casedb::audit_alone(library, casedb::Act::export_responses, {"round", round.round_id});
  if (study && casedb::has_plan(library, *study))
    casedb::note_look(library, *study, draft ? "questionnaire export before the freeze" : "questionnaire export",
                      count);
  return {};
}

}  // namespace seldinger::app
