// From draft to review by a second person, to published, to retired; who may do it (docs/people.md), and new
// versions. What is published stays as it is: the database refuses to change it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "casedb/cases/case_checks.h"
#include "casedb/cases/preparation.h"
#include "sim/case/form/mesh.h"
#include "sim/volume/volume.h"

namespace seldinger::casedb {

enum class DecisionKind { made, submitted, returned, approved, published, retired };

struct Decision {
  DecisionKind kind = DecisionKind::made;
  std::string person_id, pseudonym, note;
  std::int64_t decided_us = 0;
  // Whether the operator entered it in that person's name, who had not logged in; nothing: before this was kept.
  std::optional<bool> by_operator{};
  // The pseudonym, and that the operator entered it.
  std::string who() const;
};
std::string name_of(DecisionKind kind);

std::vector<Decision> list_decisions(Library& library, const std::string& case_id);  // oldest first

// The second person who approved what was submitted last; nothing when none has.
std::optional<Decision> review_of(const std::vector<Decision>& decisions);

// What somebody writes beside a decision: `bad_note` (more than one line or 1000 bytes).
base::Result<void> check_note(const std::string& note);

// All of these: `no_case`, `no_user` (disabled too), `not_allowed` (role, or a second person is needed),
// `bad_state`, `bad_note`. A mentor submits a draft to review.
base::Result<void> submit_case(Library& library, const std::string& case_id, const std::string& by,
                               const std::string& note = {});
// Another mentor or a director than who submitted it approves, or returns it to draft.
base::Result<void> judge_case(Library& library, const std::string& case_id, const std::string& by, bool approve,
                              const std::string& note = {});
// A mentor or director publishes what was approved, as a second person: neither who made the version nor who
// submitted it. With `own_cohort` a mentor publishes what nobody has reviewed, marked so: it reaches the cohorts
// that this mentor leads at that moment (`no_cohort`: none), and nobody else. A case that comes from a patient
// needs the confirmation that no picture holds burned-in text (`burned_in_unchecked`). `check` is of the case as it
// is stored now, and holds (`checks_failed`): one of another case, or from before a change, is refused, however it
// came out.
base::Result<void> publish_case(Library& library, const std::string& case_id, const CaseCheck& check,
                                const std::string& by, bool own_cohort, const std::string& note = {});
// An admin, or who published it.
base::Result<void> retire_case(Library& library, const std::string& case_id, const std::string& by,
                               const std::string& note = {});

// A draft like the case in all of that, but a case of its own, "Copy of …". By a mentor. Answers its id.
base::Result<std::string> duplicate_case(Library& library, const std::string& case_id, const std::string& by);

// What a CT became (casedb/import/prepare.h), and what is told of that in place of earlier such warnings.
struct PreparedCopy {
  volume::Volume volume;
  cases::Mesh skin;
  Preparation settings;
  std::vector<base::Problem> warnings;
};
// The same with another preparation of its CT; lesions, structures and setting come along. `bad_preparation`: a
// case with label maps is shrunk, or a lesion or a structure would lie outside what is left.
base::Result<std::string> add_prepared_copy(Library& library, const std::string& case_id,
                                            const PreparedCopy& prepared, const std::string& by);

// A draft like the case, with lesions, structures and label maps of the same files, the next version of its family.
// By a mentor. Answers its id.
base::Result<std::string> new_version(Library& library, const std::string& case_id, const std::string& by);

}  // namespace seldinger::casedb
