#include "reports/studies/validity_report.h"

#include "casedb/cases/cases.h"
#include "casedb/database/uuid.h"

namespace seldinger::reports {

ValidityReport validity_report_of(casedb::Library& library, const casedb::Study& study,
                                  const casedb::StoredPlan& plan, const std::string& query,
                                  const std::string& program_version) {
  ValidityReport report;
  report.study = study;
  report.plan = plan;
  report.program_version = program_version;
  for (const casedb::CaseRow& row : casedb::list_case_heads(library)) report.case_titles[row.case_id] = row.title;
  if (!plan.frozen()) report.blinded = casedb::blinded_counts(library, plan);
  if (plan.frozen()) {
    casedb::StudyData data = casedb::study_data(library, plan);
    report.result = assessment::study::analyse(report.plan.plan, data.people);
    assessment::study::add_sensitivity(report.plan.plan, data.people, report.result);
    casedb::add_analysed(report.result, data.flow);
    report.flow = std::move(data.flow);
    report.backgrounds = std::move(data.backgrounds);
    report.ratings = casedb::rated_people(library, study.study_id);
    report.rated_rounds = casedb::rated_rounds(library, study.study_id);
    report.forms = reliability_of_study(library, study.study_id);
    for (const auto* outcomes : {&report.result.primary, &report.result.secondary})
      for (const assessment::study::Compared& one : *outcomes)
        if (const auto row = casedb::find_case(library, one.outcome.case_id)) {
          report.marks.rules[row->case_id] = row->rule;
          report.marks.cuts[row->case_id] = casedb::list_cuts(library, row->case_id);
        }
    report.data_hash = casedb::data_hash(report.result);
    report.lock = casedb::find_lock(library, plan.study_id);
    casedb::note_look(library, plan.study_id, query, casedb::people_with_outcome(report.result));
  }
  report.looks = casedb::list_looks(library, plan.study_id);
  report.deviations = casedb::list_deviations(library, plan.study_id);
  report.made_us = casedb::now_us();
  return report;
}

}  // namespace seldinger::reports
