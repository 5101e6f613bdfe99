#include "app/studies/acting_in_study.h"

namespace seldinger::app {

base::Result<OpenStudy> open_study(const Arguments& arguments, const std::string& what, casedb::Action action) {
  auto library = open_acting(arguments);
  if (!library) return library.error();
  const auto called = [&] { return what.starts_with("--") ? arguments.text(what) : arguments.positional(0); };
  auto study = casedb::find_study(*library, called());
  casedb::Relation relation;
  // Asked before it is told whether there is such a study: who may not learns nothing by trying.
  relation.own_study = study && library->actor().person_id &&
                       casedb::is_researcher_of(*library, study->study_id, *library->actor().person_id);
  if (const auto by = acting(*library, arguments, action, relation); !by) return by.error();
  if (!study) return study.error();
  return OpenStudy{std::move(*library), std::move(*study)};
}

}  // namespace seldinger::app
