#include "app/cases/privacy_text.h"

#include <algorithm>
#include <map>

namespace seldinger::app {

namespace {

std::string sender_of(const casedb::Received& received) {
  if (!received.signing_key) return "unsigned";
  return received.trusted_as ? "signed by " + *received.trusted_as
                             : "signed by " + *received.signing_key + ", which is not trusted here";
}

}  // namespace

std::string received_text(const casedb::Received& received) {
  return "came in a bundle, " + sender_of(received) + "; its sender says: " + casedb::name_of(received.state) +
         ", face " + casedb::name_of(received.face_state) + ", burned-in text " +
         (received.burned_in_checked_us ? "none" : "not looked for") + "\n";
}

std::string privacy_text(const casedb::CaseRow& row) {
  std::map<std::string, std::int64_t> by_reason;
  std::int64_t all = 0;
  for (const casedb::Dropped& one : row.dropped) {
    by_reason[one.reason] += one.count;
    all += one.count;
  }
  const bool overruled = std::any_of(row.warnings.begin(), row.warnings.end(),
                                     [](const base::Problem& one) { return one.code == "face_overruled"; });
  std::string text = std::string("face     ") + casedb::name_of(row.face_state) +
                     (overruled ? ", detector overruled by an admin" : "") + "\n";
  text += "burned-in text: ";
  text += !row.burned_in_checked ? "absence not confirmed"
          : row.burned_in_checked->person_id
              ? "none, confirmed by person " + *row.burned_in_checked->person_id +
                    (row.burned_in_checked->by_operator ? " (entered by the operator)" : "")
              : "none, confirmed at the command line";
  text += "\nstayed outside: " + std::to_string(all) + (all == 1 ? " element" : " elements") + " of " +
          std::to_string(row.dropped.size()) + (row.dropped.size() == 1 ? " kind" : " kinds");
  for (const auto& [reason, count] : by_reason) text += ", " + std::to_string(count) + " " + reason;
  return text + "\n";
}

}  // namespace seldinger::app
