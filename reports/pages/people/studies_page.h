// Studies for who works on them: what is planned, who takes part under which pseudonym, how far they are, and who
// has looked at the outcomes. No outcome stands here: to see one is a look, and noted.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "casedb/people/consent.h"
#include "casedb/studies/enrolments.h"
#include "casedb/studies/looks.h"
#include "casedb/studies/plans.h"
#include "casedb/studies/study_data.h"
#include "casedb/studies/visits.h"
#include "reports/pages/page.h"

namespace seldinger::reports {

struct StudyView {
  casedb::Study study;
  std::optional<casedb::StoredPlan> plan;  // none yet
  casedb::BlindedCounts blinded;           // of a draft: all that is told
  // Of a frozen plan; of people those who consent now.
  casedb::ParticipantFlow flow;
  std::vector<casedb::StudyEnrolment> enrolments;
  std::vector<casedb::PersonVisit> visits;
  std::vector<casedb::StudyNote> looks, deviations;
};

std::string studies_page(const Visitor& visitor, const std::vector<StudyView>& studies);
// The same list as who works on them lands on.
std::string researcher_start_page(const Visitor& visitor, const std::vector<StudyView>& studies);
// Its form goes to /studies/ID/report.
std::string study_page(const Visitor& visitor, const StudyView& study);

}  // namespace seldinger::reports
