// The answers of a round as CSV, a line for each respondent and item, as R and pandas read it.
#pragma once

#include <string>

#include "casedb/questionnaires/responses.h"

namespace seldinger::reports {

// form, version, language, form_sha256, round, respondent, group, source, item, kind, state (missing,
// not_applicable, answered), value (as ticked; of a choice its place), scored (mirrored where the item is reverse;
// none for "don't know"), label, comment. By respondent, each with every item of the form in its order.
std::string responses_csv(const casedb::Responses& responses);

// The same as `seldinger stats` takes it: a line for each respondent, a column for each item that is a number or on
// a scale, holding what counts (`scored`), and nothing where nothing does.
std::string scores_csv(const casedb::Responses& responses);

}  // namespace seldinger::reports
