#include "casedb/grading/cuts.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>

#include "assessment/registry.h"
#include "assessment/statistics/reasons.h"
#include "assessment/statistics/standards/standards_procedures.h"
#include "casedb/cases/permissions.h"
#include "casedb/database/audit.h"
#include "casedb/database/question.h"
#include "casedb/database/sqlite.h"
#include "casedb/database/uuid.h"

namespace seldinger::casedb {
namespace {

namespace statistics = assessment::statistics;

constexpr const char* kMethods[] = {"contrasting_groups", "borderline", "angoff", "hofstee"};

bool knows(const statistics::Procedure& procedure, std::string_view option) {
  return std::any_of(procedure.options.begin(), procedure.options.end(),
                     [&](const statistics::ProcedureOption& one) { return one.name == option; });
}

std::string digits_of(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  return std::isnan(value) ? "" : std::string(text, end);
}

// In quotes, as a group's name may hold a comma.
std::string quoted(const std::string& text) {
  std::string made = "\"";
  for (const char letter : text) made += letter == '"' ? std::string("\"\"") : std::string(1, letter);
  return made + "\"";
}

// "s1", "s2", … in the order in which they come; who is missing stays so.
class Numbered {
 public:
  explicit Numbered(char letter) : letter_(letter) {}
  std::string operator()(const std::string& label) {
    if (label.empty()) return label;
    return letter_ + std::to_string(numbers_.emplace(label, numbers_.size() + 1).first->second);
  }

 private:
  char letter_;
  std::map<std::string, std::size_t> numbers_;
};

std::string csv_of(const statistics::DataTable& data) {
  Numbered subjects('s'), judges('j');
  std::string text = "value";
  if (!data.group.empty()) text += ",group";
  if (!data.subject.empty()) text += ",subject";
  if (!data.rater.empty()) text += ",rater";
  if (!data.x.empty()) text += ",x";
  text += '\n';
  for (std::size_t i = 0; i < data.rows; ++i) {
    text += digits_of(data.values.front().values[i]);
    if (!data.group.empty()) text += "," + quoted(data.group[i]);
    if (!data.subject.empty()) text += "," + subjects(data.subject[i]);
    if (!data.rater.empty()) text += "," + judges(data.rater[i]);
    if (!data.x.empty()) text += "," + digits_of(data.x[i]);
    text += '\n';
  }
  return text;
}

std::string text_of(const statistics::ProcedureOptions& options) {
  std::string text;
  for (const auto& [name, value] : options.all()) text += (text.empty() ? "" : ",") + name + "=" + value;
  return text;
}

base::Error not_estimable(const statistics::Answer& answer) {
  std::string text = statistics::find_reason(answer.reason.c_str())->words;
  for (const std::string& note : answer.notes) text += ". " + note;
  return {"cut_not_estimable", std::string(answer.test) + " gives no cut: " + text};
}

Cut read_cut(Sqlite& database, const Statement& from) {
  Cut cut;
  cut.cut_id = from.text("cut_id");
  cut.case_id = from.text("case_id");
  cut.metric_id = from.text("metric_id");
  if (!from.is_null("version")) cut.version = from.small_integer("version");
  cut.higher_is_better = from.integer("higher_is_better") != 0;
  cut.method = from.text("method");
  cut.options = from.text("options");
  cut.data = from.text("data");
  cut.value = from.real("value");
  if (!from.is_null("low")) cut.interval = statistics::Interval{from.real("low"), from.real("high")};
  cut.n = static_cast<std::size_t>(from.integer("n"));
  cut.words = from.text("words");
  const auto entered = [&](Act act) {
    return entered_by_operator(database, act, cut.cut_id) ? " (entered by the operator)" : "";
  };
  cut.proposed_by = from.text("proposer") + entered(Act::propose_cut);
  cut.proposed_us = from.integer("proposed_us");
  if (!from.is_null("frozen_us")) {
    cut.frozen_us = from.integer("frozen_us");
    cut.frozen_by = from.text("freezer") + entered(Act::freeze_cut);
  }
  return cut;
}

}  // namespace

std::vector<const statistics::Procedure*> cut_methods() {
  std::vector<const statistics::Procedure*> methods;
  for (const statistics::Procedure& one : statistics::standards_procedures())
    if (std::find(std::begin(kMethods), std::end(kMethods), std::string_view(one.name)) != std::end(kMethods))
      methods.push_back(&one);
  return methods;
}

base::Result<std::string> propose_cut(Library& library, const NewCut& cut, const std::string& by) {
  Transaction transaction(library.database());
  const auto account = account_that_may(library, by, Action::propose_cut);
  if (!account) return account.error();
  const auto row = find_case(library, cut.case_id);
  if (!row) return row.error();
  const assessment::MetricInfo* metric = assessment::find_metric(cut.metric_id);
  if (metric == nullptr && !cut.metric_id.empty()) return base::Error{"unknown_metric", "there is no such metric"};
  const bool lower = metric != nullptr && metric->direction == assessment::Direction::lower_is_better;
  std::map<std::string, std::string> options = cut.options.all();
  if (knows(*cut.method, "direction")) options["direction"] = lower ? "lower" : "higher";
  const statistics::ProcedureOptions chosen(std::move(options));
  const statistics::Answer answer = statistics::settled(cut.method->run(cut.data, chosen));
  if (!answer.estimable() || !answer.estimate) return not_estimable(answer);
  std::string cut_id = new_uuid();
  const auto end = [&](double statistics::Interval::*which) {
    return answer.ci95 ? std::optional((*answer.ci95).*which) : std::nullopt;
  };
  question(library.database(), "add_cut")
      .bind("cut_id", cut_id)
      .bind("case_id", cut.case_id)
      .bind("metric_id", metric != nullptr ? std::optional(cut.metric_id) : std::nullopt)
      .bind("version", metric != nullptr
                           ? std::optional<std::int64_t>(assessment::version_of(*metric, row->sight_law))
                           : std::nullopt)
      .bind("higher_is_better", lower ? 0 : 1)
      .bind("method", cut.method->name)
      .bind("options", text_of(chosen))
      .bind("data", csv_of(cut.data))
      .bind("value", *answer.estimate)
      .bind("low", end(&statistics::Interval::low))
      .bind("high", end(&statistics::Interval::high))
      .bind("n", static_cast<std::int64_t>(answer.n))
      .bind("words", answer.method)
      .bind("proposed_by", account->person_id)
      .bind("proposed_us", now_us())
      .run();
  audit(library, Act::propose_cut, {"cut", cut_id});
  transaction.commit();
  return cut_id;
}

base::Result<void> freeze_cut(Library& library, const std::string& cut_id, const std::string& by) {
  Transaction transaction(library.database());
  const auto account = acting_account(library, by);
  if (!account) return account.error();
  Statement row = question(library.database(), "cut_head");
  const bool found = row.bind("cut_id", cut_id).step();
  // Asked before it is told whether there is such a cut.
  const bool own = found && row.text("proposed_by") == account->person_id;
  if (const auto allowed = allow(account->role, Action::freeze_cut, Subject::whose(own)); !allowed)
    return allowed.error();
  if (!found) return base::Error{"no_cut", "there is no such cut in the library"};
  if (!row.is_null("frozen_us")) return base::Error{"cut_frozen", "the cut is frozen already"};
  question(library.database(), "freeze_cut")
      .bind("cut_id", cut_id)
      .bind("frozen_by", account->person_id)
      .bind("frozen_us", now_us())
      .run();
  audit(library, Act::freeze_cut, {"cut", cut_id});
  transaction.commit();
  return {};
}

std::vector<Cut> list_cuts(Library& library, const std::string& case_id) {
  std::vector<Cut> cuts;
  Statement rows = question(library.database(), "cuts_of_case");
  for (rows.bind("case_id", case_id); rows.step();) cuts.push_back(read_cut(library.database(), rows));
  return cuts;
}

const Cut* cut_in_force(const std::vector<Cut>& cuts, const std::string& metric_id) noexcept {
  const Cut* last = nullptr;
  for (const Cut& one : cuts)
    if (one.metric_id == metric_id && one.frozen_us && (last == nullptr || *one.frozen_us >= *last->frozen_us))
      last = &one;
  return last;
}

}  // namespace seldinger::casedb
