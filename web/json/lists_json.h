// What the pages tell, as JSON: of the same views, so that nothing stands in the one that does not in the other.
// Times are microseconds since 1970 UTC; null is what there is not, or what is withheld.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "casedb/cases/cases.h"
#include "casedb/people/people.h"
#include "reports/pages/attempts_page.h"
#include "reports/pages/cohorts_page.h"
#include "reports/pages/curricula_page.h"
#include "reports/pages/log_ins_page.h"
#include "reports/pages/me_page.h"
#include "reports/pages/people/audit_page.h"
#include "reports/pages/people/learner_view.h"
#include "reports/pages/people/studies_page.h"

namespace seldinger::web {

std::string attempts_json(std::span<const reports::AttemptView> attempts, const reports::ListPart& part);
std::string learners_json(std::span<const reports::LearnerView> learners, std::int64_t now_us);
std::string learner_json(const reports::LearnerView& learner, std::int64_t now_us);
std::string cohorts_json(std::span<const reports::CohortView> cohorts);
// `own`: of somebody who learns them; how many attempts they have left stands with their progress.
std::string curricula_json(std::span<const reports::CurriculumView> curricula, bool own,
                           const assessment::statistics::Answer& dependability);
std::string cases_json(std::span<const casedb::CaseRow> cases);
std::string studies_json(std::span<const reports::StudyView> studies);
std::string study_json(const reports::StudyView& study);
std::string accounts_json(std::span<const casedb::Account> accounts);
std::string log_ins_json(std::span<const reports::DelayedLogIn> delayed);
std::string audit_json(const reports::AuditView& view);
std::string about_json(const reports::AboutMe& about);

}  // namespace seldinger::web
