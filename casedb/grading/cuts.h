// Cuts of a case's item: where a method of standard setting puts the line, from data that were brought to a
// meeting. Somebody proposes one, a second person freezes it; both stand in the audit log, the data with the cut.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "assessment/statistics/answer.h"
#include "assessment/statistics/procedure.h"
#include "casedb/database/library.h"
#include "sim/base/result.h"

namespace seldinger::casedb {

// The methods there are: procedures of the shelf of standards whose answer is a cut.
std::vector<const assessment::statistics::Procedure*> cut_methods();

struct NewCut {
  std::string case_id;
  std::string metric_id;  // of the registry; empty: a share of items, as Angoff's judges have it
  const assessment::statistics::Procedure* method = nullptr;  // one of cut_methods()
  assessment::statistics::ProcedureOptions options;
  assessment::statistics::DataTable data;
};

struct Cut {
  std::string cut_id, case_id;
  std::string metric_id;  // empty: a share of items
  int version = 1;        // of the metric
  bool higher_is_better = true;
  std::string method, options;  // "hofstee", "cut_low=50,…"
  std::string data;             // CSV; who is in it is s1, s2, … and j1, j2, …
  double value = 0.0;
  std::optional<assessment::statistics::Interval> interval;
  std::size_t n = 0;
  std::string words;  // the method in words
  // Pseudonyms, with whether the operator entered it in that person's name.
  std::string proposed_by, frozen_by;
  std::int64_t proposed_us = 0;
  std::optional<std::int64_t> frozen_us;
};

// By whoever may propose; which side is better is the metric's. Answers the cut's id. Refused: `no_user`,
// `not_allowed`, `no_case`, `unknown_metric`, `cut_not_estimable`.
base::Result<std::string> propose_cut(Library& library, const NewCut& cut, const std::string& by);
// By a director who did not propose it. Refused: `no_user`, `not_allowed`, `no_cut`, `cut_frozen`.
base::Result<void> freeze_cut(Library& library, const std::string& cut_id, const std::string& by);
// Oldest first.
std::vector<Cut> list_cuts(Library& library, const std::string& case_id);
// The one that holds of that metric: the last to be frozen. Null: none is.
const Cut* cut_in_force(const std::vector<Cut>& cuts, const std::string& metric_id) noexcept;

}  // namespace seldinger::casedb
