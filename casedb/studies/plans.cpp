#include "casedb/studies/plans.h"

#include <array>
#include <map>
#include <span>
#include <utility>

#include "casedb/cases/cases.h"
#include "casedb/database/audit.h"
#include "casedb/database/credentials.h"
#include "casedb/database/question.h"
#include "casedb/database/sqlite.h"
#include "casedb/database/uuid.h"
#include "casedb/people/consent.h"
#include "casedb/people/facts.h"
#include "sim/base/check.h"
#include "sim/base/hex.h"

namespace seldinger::casedb {
namespace {

namespace study = assessment::study;

std::string hash_of_text(const std::string& text) {
  return sha256_hex(std::as_bytes(std::span(text)));
}

void check_facts(const study::Plan& plan, std::vector<base::Problem>& wrong) {
  for (std::size_t i = 0; i < plan.groups.size(); ++i)
    for (const study::FactCriterion& one : plan.groups[i].facts) {
      const std::string place = "groups[" + std::to_string(i) + "].facts: ";
      if (const auto answer = checked_answer(one.fact, one.value); !answer)
        wrong.push_back({"bad_study_plan", place + answer.error().text});
      else if (find_fact(one.fact)->is_choice() && one.comparison != assessment::Comparison::equal)
        wrong.push_back({"bad_study_plan", place + "a word is compared by = alone"});
    }
  for (const std::string& fact : plan.randomisation.strata)
    if (find_fact(fact) == nullptr || !find_fact(fact)->is_choice())
      wrong.push_back({"bad_study_plan", "randomisation.strata: a stratum is a fact that is answered by a word"});
}

// What of the plan is none of the library's or of today's metrics.
base::Result<void> check_plan(Library& library, const study::Plan& plan) {
  base::Error error{"bad_study_plan", "the plan is not as it should be", {}};
  std::map<std::string, cases::SightLaw> laws;
  for (const auto* outcomes : {&plan.primary, &plan.secondary})
    for (const study::Outcome& one : *outcomes)
      if (const auto row = find_case(library, one.case_id))
        laws.emplace(one.case_id, row->sight_law);
      else
        error.findings.push_back(
            {"bad_study_plan", "outcome \"" + one.name + "\": the library has no case of that id"});
  const std::vector<base::Problem> problems = study::problems_of(plan, laws);
  error.findings.insert(error.findings.begin(), problems.begin(), problems.end());
  check_facts(plan, error.findings);
  if (!error.findings.empty()) return error;
  return {};
}

}  // namespace

base::Result<StoredPlan> find_plan(Library& library, const std::string& study_id) {
  Statement row = question(library.database(), "study_plan");
  if (!row.bind("study_id", study_id).step())
    return base::Error{"no_plan", "the study has no plan yet; `seldinger study plan` stores one"};
  StoredPlan stored;
  stored.study_id = study_id;
  stored.body = row.text("body");
  stored.body_hash = row.text("body_hash");
  stored.stored_us = row.integer("stored_us");
  if (!row.is_null("frozen_us")) stored.frozen_us = row.integer("frozen_us");
  stored.seed = row.text("seed");
  stored.seed_hash = row.text("seed_hash");
  auto plan = study::plan_from_json(stored.body);
  if (!plan || hash_of_text(stored.body) != stored.body_hash)
    return base::Error{"damaged", "the stored plan is not what was stored"};
  stored.plan = std::move(*plan);
  return stored;
}

bool has_plan(Library& library, const std::string& study_id) {
  Statement row = question(library.database(), "study_plan");
  return row.bind("study_id", study_id).step();
}

bool has_draft(Library& library, const std::string& study_id) {
  Statement row = question(library.database(), "study_plan");
  return row.bind("study_id", study_id).step() && row.is_null("frozen_us");
}

base::Result<StoredPlan> store_plan(Library& library, const std::string& study_id, const std::string& json) {
  if (const auto known = find_study(library, study_id); !known) return known.error();
  const auto plan = study::plan_from_json(json);
  if (!plan) return plan.error();
  if (const auto checked = check_plan(library, *plan); !checked) return checked.error();
  Transaction transaction(library.database());
  if (const auto before = find_plan(library, study_id); before && before->frozen())
    return base::Error{"plan_frozen",
                       "the plan is frozen; `seldinger study deviate` appends what is done otherwise"};
  const std::string body = study::canonical_json(*plan);
  question(library.database(), "set_study_plan")
      .bind("study_id", study_id)
      .bind("body", body)
      .bind("body_hash", hash_of_text(body))
      .bind("now_us", now_us())
      .run();
  audit(library, Act::plan_study, {"study", study_id});
  transaction.commit();
  return find_plan(library, study_id);
}

base::Result<StoredPlan> freeze_plan(Library& library, const std::string& study_id) {
  Transaction transaction(library.database());
  const auto draft = find_plan(library, study_id);
  if (!draft) return draft.error();
  if (draft->frozen()) return base::Error{"plan_frozen", "the plan is frozen already"};
  if (const auto checked = check_plan(library, draft->plan); !checked) return checked.error();
  if (auto unanswered = study::unanswered_in(draft->plan); !unanswered.empty())
    return base::Error{"bad_study_plan", "the plan is not finished", std::move(unanswered)};
  std::array<std::byte, 32> random{};
  fill_random(random);
  const std::string seed = base::hex_from_bytes(random);
  question(library.database(), "freeze_study_plan")
      .bind("study_id", study_id)
      .bind("now_us", now_us())
      .bind("person_id", library.actor().person_id)
      .bind("seed", seed)
      .bind("seed_hash", hash_of_text(seed))
      .run();
  audit(library, Act::freeze_study, {"study", study_id});
  transaction.commit();
  return find_plan(library, study_id);
}

}  // namespace seldinger::casedb
