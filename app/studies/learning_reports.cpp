#include "app/studies/learning_reports.h"

#include <algorithm>

#include "app/acting/acting.h"
#include "app/cli/version.h"
#include "reports/learning/case_report.h"
#include "reports/learning/learner_report.h"
#include "reports/learning/standard_report.h"

namespace seldinger::app {
namespace {

using casedb::Learners;

casedb::Subject nobodys() {
  casedb::Subject subject;
  subject.nobodys = true;
  return subject;
}

// "novice-3": the third person of the group, of the first seed that there is.
base::Result<std::string> simulated_called(casedb::Library& library, const std::string& typed) {
  for (const casedb::SimulatedTruth& one : casedb::list_simulated_truths(library))
    if (one.group + "-" + std::to_string(one.number) == typed) return one.person_id;
  return base::Error{"no_person",
                     "there is no such simulated person: give the group and a number, such as novice-3"};
}

}  // namespace

base::Result<std::string> learner_report(const Arguments& arguments) {
  if (arguments.has("--user") == arguments.has("--simulated"))
    throw UsageError("learner needs --user NAME, or --simulated with --person GROUP-NUMBER");
  const bool simulated = arguments.has("--simulated");
  const std::string called = arguments.required(simulated ? "--person" : "--user");
  auto library = open_acting(arguments);
  if (!library) return library.error();
  if (simulated) {
    if (const auto by = acting(*library, arguments, casedb::Action::see_attempt, nobodys()); !by) return by.error();
    const auto person = simulated_called(*library, called);
    if (!person) return person.error();
    return reports::learner_report_page(
        reports::learner_report_of(*library, Learners::simulated, *person, "Simulated " + called, kVersion));
  }
  const auto account = casedb::open_account(*library, called);
  if (!account) return account.error();
  if (const auto by = acting_on(*library, arguments, casedb::Action::see_attempt, account->person_id); !by)
    return by.error();
  return reports::learner_report_page(
      reports::learner_report_of(*library, Learners::people, account->person_id, account->login_name, kVersion));
}

base::Result<std::string> case_report(const Arguments& arguments) {
  auto library = open_acting(arguments);
  if (!library) return library.error();
  const casedb::Subject published(casedb::CaseState::published);
  if (const auto by = acting(*library, arguments, casedb::Action::see_case, published); !by) return by.error();
  return reports::case_report_page(reports::case_report_of(
      *library, arguments.has("--simulated") ? Learners::simulated : Learners::people, kVersion));
}

base::Result<std::string> standard_report(const Arguments& arguments) {
  arguments.required("--case");
  auto library = open_acting(arguments);
  if (!library) return library.error();
  const auto row = casedb::find_case(*library, arguments.text("--case"));
  const casedb::Subject subject(row ? row->state : casedb::CaseState::published);
  if (const auto by = acting(*library, arguments, casedb::Action::see_case, subject); !by) return by.error();
  if (!row) return row.error();
  return reports::standard_report_page(reports::standard_report_of(*library, *row, kVersion));
}

}  // namespace seldinger::app
