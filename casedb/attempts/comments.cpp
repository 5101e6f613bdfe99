#include "casedb/attempts/comments.h"

#include <algorithm>

#include "casedb/attempts/attempts.h"
#include "casedb/database/audit.h"
#include "casedb/database/question.h"
#include "casedb/database/sqlite.h"
#include "casedb/database/utf8.h"
#include "casedb/database/uuid.h"

namespace seldinger::casedb {
namespace {

bool is_said(const std::string& body) {
  return body.size() <= kMostAttemptComment && is_text(body) && body.find_first_not_of(" \t\r\n") != body.npos;
}

}  // namespace

base::Result<void> add_comment(Library& library, const std::string& attempt_id, double at_s,
                               const std::string& body) {
  Transaction transaction(library.database());
  const auto attempt = find_attempt(library, attempt_id);
  if (!attempt) return attempt.error();
  if (!is_said(body)) return base::Error{"bad_text", "a comment has 1 to 1,000 bytes of UTF-8 text"};
  if (!(at_s >= 0.0 && at_s <= attempt->duration_s))
    return base::Error{"bad_moment", "the comment's moment is not within the attempt"};
  question(library.database(), "add_attempt_comment")
      .bind("attempt_id", attempt_id)
      .bind("comment_id", new_uuid())
      .bind("at_s", at_s)
      .bind("body", body)
      .bind("person_id", library.actor().person_id)
      .bind("now_us", now_us())
      .run();
  audit(library, Act::comment_attempt, {"attempt", attempt_id});
  transaction.commit();
  return {};
}

std::vector<AttemptComment> list_comments(Library& library, const std::string& attempt_id) {
  std::vector<AttemptComment> comments;
  Statement rows = question(library.database(), "attempt_comments");
  for (rows.bind("attempt_id", attempt_id); rows.step();) {
    AttemptComment& one = comments.emplace_back();
    one.comment_id = rows.text("comment_id");
    one.at_s = rows.real("at_s");
    one.body = rows.text("body");
    if (!rows.is_null("person_id")) one.person_id = rows.text("person_id");
    one.written_us = rows.integer("written_us");
  }
  return comments;
}

}  // namespace seldinger::casedb
