#include "casedb/people/web_sessions.h"

#include "casedb/database/question.h"
#include "casedb/database/sqlite.h"
#include "casedb/database/uuid.h"

namespace seldinger::casedb {

std::vector<WebSession> list_web_sessions(Library& library, int port) {
  std::vector<WebSession> sessions;
  Statement rows = question(library.database(), "web_sessions");
  for (rows.bind("port", port).bind("now_us", now_us()); rows.step();)
    sessions.push_back({rows.text("id_hash"), rows.text("person_id"), rows.text("password_mark"),
                        rows.integer("begun_us"), rows.integer("seen_us"), rows.integer("ends_us")});
  return sessions;
}

void keep_web_sessions(Library& library, int port, const WebSessionChanges& changes) {
  Sqlite& database = library.database();
  Transaction transaction(database);
  question(database, "end_old_web_sessions").bind("now_us", now_us()).run();
  Statement keep = question(database, "keep_web_session"), end = question(database, "end_web_session");
  for (const WebSession& one : changes.kept)
    keep.bind("id_hash", one.id_hash)
        .bind("port", port)
        .bind("person_id", one.person_id)
        .bind("password_mark", one.password_mark)
        .bind("begun_us", one.begun_us)
        .bind("seen_us", one.seen_us)
        .bind("ends_us", one.ends_us)
        .run();
  for (const std::string& id_hash : changes.ended) end.bind("id_hash", id_hash).run();
  transaction.commit();
}

}  // namespace seldinger::casedb
