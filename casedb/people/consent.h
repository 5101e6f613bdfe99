// Studies, what they ask people to consent to, and who does. A text never changes: another wording is another
// version, kept with its SHA-256. Consent to a study, or to research with this library whatever the study; it holds
// until it is withdrawn, and withdrawing it from one study excludes the person there although the library's stands.
// Times are microseconds since 1970 UTC. Every write is one transaction.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "casedb/database/library.h"
#include "sim/base/result.h"

namespace seldinger::casedb {

// How many a study may be of: people who consent to it, or, where its plan says so, simulated ones, whom nobody
// asks.
struct StudyPeople {
  int count = 0;
  bool simulated = false;
  int consenting() const noexcept { return simulated ? 0 : count; }
  int simulated_people() const noexcept { return simulated ? count : 0; }
};

struct Study {
  std::string study_id, title;
  StudyPeople people{};
};

// A text as one person meets it.
struct Consent {
  std::string text_id;
  std::optional<std::string> study_id;  // none: research with this library
  std::string study_title;
  int version = 1;
  std::string body, body_hash;
  bool newest = true;                      // of its study; an older one was answered and is no longer asked
  std::optional<std::int64_t> given_us{};  // of the consent that stands, else of the last one
  std::optional<std::int64_t> withdrawn_us{};
  bool refused() const noexcept { return given_us.has_value() && given_us == withdrawn_us; }  // never given
  bool stands() const noexcept { return given_us.has_value() && !withdrawn_us.has_value(); }
};

base::Result<std::string> add_study(Library& library, const std::string& title);   // `bad_title`, `title_taken`
std::vector<Study> list_studies(Library& library);                                 // oldest first
base::Result<Study> find_study(Library& library, const std::string& title_or_id);  // `no_study`
// From now on; `no_person`. Who works on it already goes on.
base::Result<void> add_researcher(Library& library, const std::string& study_id, const std::string& person_id);
// From now on not; `not_enrolled`.
base::Result<void> end_researcher(Library& library, const std::string& study_id, const std::string& person_id);
bool is_researcher_of(Library& library, const std::string& study_id, const std::string& person_id);

// The next version, whose number it answers; without a study the library's. `bad_text`: it is empty, longer than
// 20,000 bytes, or not UTF-8 text. `no_study`.
base::Result<int> add_consent_text(Library& library, const std::optional<std::string>& study_id,
                                   const std::string& body);
// What is asked of this person, and what this person has answered: the library's first, then study by study.
std::vector<Consent> list_consents(Library& library, const std::string& person_id);
// `no_text`: no such one is asked of this person now; `no_person`.
base::Result<void> give_consent(Library& library, const std::string& person_id, const std::string& text_id);
// To the newest text of a study, within a transaction of the caller's; `no_person`, `no_text`: the study asks for
// none.
base::Result<void> add_consent_to_study(Library& library, const std::string& person_id,
                                        const std::string& study_id);
// Of every version. Of a study that was never answered, but which consent to research with the library covers: from
// now on that one does not cover it (kept as given and withdrawn at once). `no_text`, `not_given`.
base::Result<void> withdraw_consent(Library& library, const std::string& person_id, const std::string& text_id);

// Whose attempts the study may use; without one, whose consent to research with this library stands.
std::set<std::string> consenting_people(Library& library, const std::optional<std::string>& study_id);

}  // namespace seldinger::casedb
