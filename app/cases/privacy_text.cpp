#include "app/cases/privacy_text.h"

#include <map>

namespace seldinger::app {

std::string privacy_text(const casedb::CaseRow& row) {
  std::map<std::string, std::int64_t> by_reason;
  std::int64_t all = 0;
  for (const casedb::Dropped& one : row.dropped) {
    by_reason[one.reason] += one.count;
    all += one.count;
  }
  std::string text = std::string("face     ") + casedb::name_of(row.face_state) + "\n";
  text += "burned-in text: ";
  text += !row.burned_in_checked ? "not confirmed that there is none"
          : row.burned_in_checked->person_id
              ? "none, confirmed by person " + *row.burned_in_checked->person_id +
                    (row.burned_in_checked->by_operator ? " (entered by the operator)" : "")
              : "none, confirmed at the command line";
  text +=
      "\nstayed outside: " + std::to_string(all) + " elements of " + std::to_string(row.dropped.size()) + " kinds";
  for (const auto& [reason, count] : by_reason) text += ", " + std::to_string(count) + " " + reason;
  return text + "\n";
}

}  // namespace seldinger::app
