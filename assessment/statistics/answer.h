// What a statistical procedure answers: an estimate with its interval, a test with its method, how many persons it
// rests on; or that nothing can be estimated, and why. Never NaN or an infinity: see settled().
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace seldinger::assessment::statistics {

struct Interval {
  double low = 0.0, high = 0.0;
  bool operator==(const Interval&) const = default;
};

// A further number of a procedure that others do not have: {"hodges_lehmann", 0.305}.
struct Named {
  std::string name;
  double value = 0.0;
};

struct GroupCount {
  std::string name;
  std::size_t n = 0;
};

// A line of an answer that has several: a pair of groups, an item, a point of a curve. Every row of an answer has
// the same numbers, in the same order.
struct Row {
  std::string name;
  std::vector<Named> values;
};

struct Answer {
  std::string test;    // as `seldinger stats` calls it
  std::string method;  // in words, with what was chosen: "Mann–Whitney, exact, mid-ranks"
  // Why nothing can be estimated, a code of reasons.h; empty: something was.
  std::string reason;
  std::size_t n = 0;        // units (persons, pairs, items' respondents) that the answer rests on
  std::size_t missing = 0;  // left out since something of theirs was missing
  std::vector<GroupCount> groups;
  std::optional<double> statistic;
  std::vector<double> df;
  std::optional<double> p_value;  // two-sided unless `method` says otherwise
  std::optional<double> estimate;
  std::string estimate_name;  // what is estimated: "difference of means (a − b)"
  std::optional<Interval> ci95;
  std::vector<Named> more;
  std::vector<Row> rows;
  std::vector<std::string> notes;  // what the reader must know, one sentence each

  bool estimable() const noexcept { return reason.empty(); }
};

// An answer that tells why there is none. CHECKs that `reason` is one of reasons.h.
Answer not_estimable(std::string test, const char* reason, std::size_t n, std::vector<GroupCount> groups = {});

// The last word on an answer: where a number of it is no finite one it is taken away and a note says so; where
// nothing is left (no statistic, estimate, p, more or rows) it becomes not_estimable("no_finite_answer"). A p-value
// is held to [0, 1].
Answer settled(Answer answer);

}  // namespace seldinger::assessment::statistics
