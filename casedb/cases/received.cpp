#include "casedb/cases/received.h"

#include "casedb/database/question.h"
#include "casedb/database/sqlite.h"

namespace seldinger::casedb {

std::optional<Received> find_received(Library& library, const std::string& case_id) {
  Statement from = question(library.database(), "received_case");
  if (!from.bind("case_id", case_id).step()) return std::nullopt;
  Received received;
  received.received_us = from.integer("received_us");
  received.state = *case_state_from(from.view("state"));  // the schema takes no others
  received.face_state = *face_state_from(from.text("face_state"));
  if (!from.is_null("burned_in_checked_us")) received.burned_in_checked_us = from.integer("burned_in_checked_us");
  if (!from.is_null("signing_key")) received.signing_key = from.text("signing_key");
  if (!from.is_null("trusted_as")) received.trusted_as = from.text("trusted_as");
  return received;
}

CaseState arriving(CaseState there) noexcept {
  return there == CaseState::published ? CaseState::review : there;
}

}  // namespace seldinger::casedb
