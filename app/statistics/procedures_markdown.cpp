#include <string>

#include "app/statistics/procedures.h"
#include "assessment/statistics/reasons.h"

namespace seldinger::app {
namespace {

using assessment::statistics::Procedure;

constexpr const char* kHead = R"(# Statistics

Made by `seldinger help --statistics > docs/statistics.md`; a test compares, and another types every example
(`tests/e2e/stats_test.cpp`). `seldinger stats TEST` answers one question from one CSV file. The files in `docs/statistics` are made up, to try
it on.

**The file** is RFC 4180 in UTF-8: a header, then one observation a line; LF or CRLF; a byte-order mark is allowed. Semicolons or tabs separate
where the header holds them and no comma. Decimals have a point. An empty cell, NA or NaN is missing: what has something missing is left out
and counted. A file that is not such a CSV, lacks a column or holds a word where a number is wanted is refused (`bad_csv`, exit 3); the message
names row and column and never the cell. An empty one, or one that is too small, is not estimable, with the reason, and exit 0.

**The person is the unit.** Where `--subject` is given, a person who appears twice in a group, or in two groups that should be independent, is
refused (`repeated_subject`, `subject_in_two_groups`): aggregate first, or model it (`mixed_model`). Where it is not given, every line counts
as another person. Tests of several conditions of the same persons take them as one column with `--group` and `--subject`, or side by side:
`seldinger stats paired --csv docs/statistics/course.csv --value before,after`.

**The answer** with `--json` is one object: `test`, `status` (`ok` or `not_estimable`), `reason` (a code of the list at the end) and
`reason_words`, `n`, `missing`, `method` (in words, with what was chosen), `groups` (`name`, `n`), `statistic`, `df` (a number, or a list where
there are several), `p_value` (two-sided unless `method` says otherwise), `estimate` and `estimate_name`, `ci95` as [low, high], `notes`, `rows`
(pairs, items, points of a curve, each with `name`), then what only this test has, by its name. What is not there is null, never 0; NaN and
infinities are never printed. Numbers have as many digits as it takes to read the same number back.

**Oracle** names what the tests of `tests/assessment/statistics` compare the procedure with, and the largest difference that they accept
(relative, unless it says otherwise); [held](statistics-held.md) says what was seen. R is that of Debian 12.
)";

std::string cell(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) text.replace(at, 1, "\\|");
  return text;
}

std::string synopsis_of(const Procedure& procedure) {
  const auto& needs = procedure.needs;
  std::string text = std::string("seldinger stats ") + procedure.name;
  if (needs.least_values > 0) text += " --csv FILE --value COL";
  if (needs.most_values > 1) text += ",COL…";
  if (needs.group) text += " --group COL";
  if (needs.subject) text += " --subject COL";
  if (needs.rater) text += " --rater COL";
  if (needs.x) text += " --x COL";
  return text;
}

std::string section_of(const Procedure& procedure) {
  std::string text = std::string("\n## ") + procedure.name + "\n\n" + procedure.summary + "\n\n```\n" +
                     synopsis_of(procedure) + "\n";
  for (const ProcedureExample& one : procedure_examples())
    if (std::string(one.procedure) == procedure.name)
      text += std::string("\nseldinger stats ") + one.procedure + " " + one.words + "\n";
  text += std::string("```\n\n- columns: ") + procedure.columns + "\n- source: " + procedure.source +
          "\n- oracle: " + procedure.oracle + "\n";
  if (procedure.options.empty()) return text;
  text += "\n| option | takes | what it does |\n|---|---|---|\n";
  for (const auto& option : procedure.options)
    text += std::string("| `") + option.name + "` | " + cell(option.value) + " | " + cell(option.words) + " |\n";
  return text;
}

}  // namespace

std::string procedures_markdown() {
  std::string text = kHead;
  text += "\n| test | what for |\n|---|---|\n";
  for (const Procedure& one : procedures())
    text += std::string("| [`") + one.name + "`](#" + one.name + ") | " + cell(one.summary) + " |\n";
  for (const Procedure& one : procedures()) text += section_of(one);
  text += "\n## Why nothing is estimated\n\n| reason | because |\n|---|---|\n";
  for (const auto& reason : assessment::statistics::reasons())
    text += std::string("| `") + reason.code + "` | " + cell(reason.words) + " |\n";
  return text;
}

}  // namespace seldinger::app
