#include "casedb/people/consent.h"

#include <algorithm>
#include <span>

#include "casedb/database/audit.h"
#include "casedb/database/credentials.h"
#include "casedb/database/question.h"
#include "casedb/database/sqlite.h"
#include "casedb/database/utf8.h"
#include "casedb/database/uuid.h"
#include "casedb/people/cohorts.h"
#include "casedb/people/people.h"
#include "sim/base/check.h"

namespace seldinger::casedb {
namespace {

constexpr std::size_t kMostBody = 20'000;

bool is_plain_text(std::string_view text) {
  while (!text.empty()) {
    const auto character = next_character(text);
    if (!character || (*character < 0x20 && *character != U'\n') || *character == 0x7f) return false;
  }
  return true;
}

// To the newest text that `fits`, of those that are asked of this person; within a transaction of the caller's.
template <typename Fits>
base::Result<void> add_consent(Library& library, const std::string& person_id, Fits fits, const char* none_fits) {
  if (const auto known = check_person(library, person_id); !known) return known.error();
  const auto asked = list_consents(library, person_id);
  const auto text =
      std::find_if(asked.begin(), asked.end(), [&](const Consent& one) { return one.newest && fits(one); });
  if (text == asked.end()) return base::Error{"no_text", none_fits};
  {
    Statement insert = question(library.database(), "add_consent");
    insert.bind("person_id", person_id).bind("text_id", text->text_id).bind("given_us", now_us());
    while (insert.step()) {
    }
  }
  audit(library, Act::give_consent, {"consent_text", text->text_id});
  return {};
}

}  // namespace

base::Result<std::string> add_study(Library& library, const std::string& title) {
  if (const auto fit = check_title(title); !fit) return fit.error();
  Transaction transaction(library.database());
  std::string study_id = new_uuid();
  {
    Statement insert = question(library.database(), "add_study");
    if (!insert.bind("study_id", study_id).bind("title", title).bind("created_us", now_us()).step())
      return base::Error{"title_taken", "there is already a study of that title"};
    CHECK(!insert.step());
  }
  audit(library, Act::make_study, {"study", study_id});
  transaction.commit();
  return study_id;
}

std::vector<Study> list_studies(Library& library) {
  std::vector<Study> studies;
  for (Statement rows = question(library.database(), "studies"); rows.step();)
    studies.push_back({rows.text("study_id"),
                       rows.text("title"),
                       {rows.small_integer("people"), rows.integer("of_simulated") != 0}});
  return studies;
}

base::Result<Study> find_study(Library& library, const std::string& title_or_id) {
  for (Study& one : list_studies(library))
    if (one.title == title_or_id || one.study_id == title_or_id) return std::move(one);
  return base::Error{"no_study", "there is no such study"};
}

base::Result<void> add_researcher(Library& library, const std::string& study_id, const std::string& person_id) {
  Transaction transaction(library.database());
  if (const auto known = check_person(library, person_id); !known) return known.error();
  if (is_researcher_of(library, study_id, person_id)) return {};
  question(library.database(), "add_researcher")
      .bind("study_id", study_id)
      .bind("person_id", person_id)
      .bind("from_us", now_us())
      .run();
  audit(library, Act::appoint_researcher, {"person", person_id});
  transaction.commit();
  return {};
}

base::Result<void> end_researcher(Library& library, const std::string& study_id, const std::string& person_id) {
  Transaction transaction(library.database());
  int ended = 0;
  {
    Statement end = question(library.database(), "end_researcher");
    for (end.bind("study_id", study_id).bind("person_id", person_id).bind("to_us", now_us()); end.step();) ++ended;
  }
  if (ended == 0) return base::Error{"not_enrolled", "this person does not work on the study now"};
  audit(library, Act::end_researcher, {"person", person_id});
  transaction.commit();
  return {};
}

bool is_researcher_of(Library& library, const std::string& study_id, const std::string& person_id) {
  Statement row = question(library.database(), "is_researcher_of");
  CHECK(row.bind("study_id", study_id).bind("person_id", person_id).step());
  return row.integer("found") != 0;
}

base::Result<int> add_consent_text(Library& library, const std::optional<std::string>& study_id,
                                   const std::string& body) {
  if (body.empty() || body.size() > kMostBody || !is_plain_text(body))
    return base::Error{"bad_text", "a consent text has 1 to 20,000 bytes of UTF-8 text"};
  if (study_id)
    if (const auto known = find_study(library, *study_id); !known) return known.error();
  Transaction transaction(library.database());
  const std::string text_id = new_uuid();
  int version = 0;
  {
    Statement insert = question(library.database(), "add_consent_text");
    insert.bind("text_id", text_id)
        .bind("study_id", study_id)
        .bind("body", body)
        .bind("body_hash", sha256_hex(std::as_bytes(std::span(body))))
        .bind("created_us", now_us());
    CHECK(insert.step());
    version = insert.small_integer("version");
    CHECK(!insert.step());
  }
  audit(library, Act::add_consent_text, {"consent_text", text_id});
  transaction.commit();
  return version;
}

std::vector<Consent> list_consents(Library& library, const std::string& person_id) {
  std::vector<Consent> consents;
  Statement rows = question(library.database(), "consents_of_person");
  const auto maybe = [&](const char* column) {
    return rows.is_null(column) ? std::nullopt : std::optional(rows.integer(column));
  };
  for (rows.bind("person_id", person_id); rows.step();) {
    Consent& one = consents.emplace_back();
    one.text_id = rows.text("text_id");
    if (!rows.is_null("study_id")) one.study_id = rows.text("study_id");
    one.study_title = rows.text("title");
    one.version = rows.small_integer("version");
    one.body = rows.text("body");
    one.body_hash = rows.text("body_hash");
    one.newest = rows.integer("newest") != 0;
    one.given_us = maybe("given_us");
    one.withdrawn_us = maybe("withdrawn_us");
  }
  return consents;
}

base::Result<void> add_consent_to_study(Library& library, const std::string& person_id,
                                        const std::string& study_id) {
  return add_consent(
      library, person_id, [&](const Consent& one) { return one.study_id == study_id; },
      "the study asks for no consent: `seldinger consent text` adds what it asks");
}

base::Result<void> give_consent(Library& library, const std::string& person_id, const std::string& text_id) {
  Transaction transaction(library.database());
  auto given = add_consent(
      library, person_id, [&](const Consent& one) { return one.text_id == text_id; },
      "there is no such text, or a newer one has replaced it");
  if (given) transaction.commit();
  return given;
}

base::Result<void> withdraw_consent(Library& library, const std::string& person_id, const std::string& text_id) {
  Transaction transaction(library.database());
  const auto asked = list_consents(library, person_id);
  if (std::none_of(asked.begin(), asked.end(), [&](const Consent& one) { return one.text_id == text_id; }))
    return base::Error{"no_text", "there is no such text"};
  int withdrawn = 0;
  {
    Statement withdraw = question(library.database(), "withdraw_consent");
    withdraw.bind("person_id", person_id).bind("text_id", text_id).bind("withdrawn_us", now_us());
    while (withdraw.step()) ++withdrawn;
  }
  if (withdrawn == 0) {
    Statement refuse = question(library.database(), "add_refusal");
    refuse.bind("person_id", person_id).bind("text_id", text_id).bind("now_us", now_us());
    while (refuse.step()) ++withdrawn;
  }
  if (withdrawn == 0) return base::Error{"not_given", "no consent to this text stands"};
  audit(library, Act::withdraw_consent, {"consent_text", text_id});
  transaction.commit();
  return {};
}

std::set<std::string> consenting_people(Library& library, const std::optional<std::string>& study_id) {
  std::set<std::string> people;
  Statement rows = question(library.database(), "consenting_people");
  for (rows.bind("study_id", study_id); rows.step();) people.insert(rows.text("person_id"));
  return people;
}

}  // namespace seldinger::casedb
