// The plan of a study as the library keeps it: a draft, which its researchers may replace, until it is frozen. From
// then on the database refuses every change, and what was planned is told by its hash.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "assessment/study/plan.h"
#include "casedb/database/library.h"
#include "sim/base/result.h"

namespace seldinger::casedb {

struct StoredPlan {
  std::string study_id;
  assessment::study::Plan plan;
  std::string body, body_hash;  // canonical JSON and its SHA-256
  std::int64_t stored_us = 0;
  std::optional<std::int64_t> frozen_us;
  // Of the allocation: drawn at the freeze. The hash is told at once; the seed only tells who it was that would be
  // allocated next, so it stays here until nobody is to be enrolled any more.
  std::string seed, seed_hash;
  bool frozen() const noexcept { return frozen_us.has_value(); }
};

// `no_plan`.
base::Result<StoredPlan> find_plan(Library& library, const std::string& study_id);
bool has_plan(Library& library, const std::string& study_id);
// A plan that is not frozen yet.
bool has_draft(Library& library, const std::string& study_id);

// A draft, in the place of an older one: `no_study`, `bad_study_plan` (also where a case, a fact or an answer is
// none of the library's), `plan_frozen`.
base::Result<StoredPlan> store_plan(Library& library, const std::string& study_id, const std::string& json);
// Body, hash, time and the allocation's seed in one transaction. `no_plan`, `plan_frozen`, `bad_study_plan` (a
// metric has another version by now, or words of the template stand).
base::Result<StoredPlan> freeze_plan(Library& library, const std::string& study_id);

}  // namespace seldinger::casedb
