// A procedure as `seldinger stats` offers it: a row of its shelf's table, which drives command, help, docs and
// tests.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "assessment/statistics/answer.h"
#include "assessment/statistics/data_table.h"

namespace seldinger::assessment::statistics {

struct ProcedureOption {
  const char* name;   // "delta"
  const char* value;  // what it takes, in words: "a number above 0"
  const char* words;
};

// What was typed as --options k=v,…; a procedure asks for its own.
class ProcedureOptions {
 public:
  ProcedureOptions() = default;
  explicit ProcedureOptions(std::map<std::string, std::string> values) : values_(std::move(values)) {}

  bool has(const std::string& name) const { return values_.contains(name); }
  std::string text(const std::string& name, const std::string& fallback = {}) const;
  // Nothing: it was given and is no finite number.
  std::optional<double> number(const std::string& name, double fallback) const;
  // Nothing: it was given and is no whole number from `least` to `most` (both below 2^53).
  std::optional<std::size_t> whole(const std::string& name, std::size_t fallback, std::size_t least,
                                   std::size_t most) const;
  // "a:b:c", in that order.
  std::vector<std::string> list(const std::string& name) const;
  const std::map<std::string, std::string>& all() const noexcept { return values_; }

 private:
  std::map<std::string, std::string> values_;
};

// What a procedure needs of a table.
struct Needs {
  std::size_t least_values = 1, most_values = 1;  // columns of numbers
  bool group = false, subject = false, rater = false, x = false;
};

struct Procedure {
  const char* name;     // "mann_whitney"
  const char* summary;  // one sentence, with when to take it
  const char* columns;  // in words, what each column holds: "value by group; two groups"
  Needs needs;
  std::span<const ProcedureOption> options;
  // Total: any table that holds what is needed, and any options, give an answer, settled.
  Answer (*run)(const DataTable&, const ProcedureOptions&);
  const char* source;  // who published it
  const char* oracle;  // what tests hold it against, with the tolerance
};

}  // namespace seldinger::assessment::statistics
