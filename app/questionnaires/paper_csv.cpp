#include "app/questionnaires/paper_csv.h"

#include <algorithm>
#include <map>
#include <set>

#include "app/statistics/csv_records.h"

namespace seldinger::app {
namespace {

namespace questionnaire = assessment::questionnaire;

constexpr std::size_t kMostFaults = 10;

base::Error bad_paper(const std::string& text) {
  return {"bad_csv", text};
}

// The first line decides: who works with commas for decimals has semicolons between cells.
char separator_of(const std::string& text) {
  const std::string head = text.substr(0, text.find('\n'));
  return std::count(head.begin(), head.end(), ';') > std::count(head.begin(), head.end(), ',') ? ';' : ',';
}

base::Result<void> check_header(const std::vector<std::string>& header, const questionnaire::Form& form) {
  std::set<std::string> seen;
  for (const std::string& column : header) {
    if (!seen.insert(column).second) return bad_paper("a column is there twice");
    const bool known = column == "respondent" || column == "version" || column == "group" || column == "language" ||
                       form.find_item(column) != nullptr;
    if (!known)
      return bad_paper(
          "a column is neither an item of the questionnaire nor respondent, version, group or language");
  }
  for (const char* needed : {"respondent", "version"})
    if (!seen.contains(needed)) return bad_paper(std::string("the column ") + needed + " is missing");
  for (const questionnaire::Item& item : form.items)
    if (!seen.contains(item.id)) return bad_paper("the column " + item.id + " is missing: an item");
  return {};
}

// As it is read: 4 and 4.0 are one answer, what cannot be read is itself.
std::string as_read(const questionnaire::Form& form, const std::string& item_id, const std::string& typed) {
  const questionnaire::Item* item = form.find_item(item_id);
  if (item == nullptr) return typed;
  const auto answer = questionnaire::answer_from_text(form, *item, typed);
  return answer ? questionnaire::text_of(*item, *answer) : typed;
}

}  // namespace

base::Result<std::vector<casedb::PaperForm>> paper_forms_in_csv(const std::string& text,
                                                                const questionnaire::Form& form) {
  const std::string body = text.starts_with("\xEF\xBB\xBF") ? text.substr(3) : text;
  CsvRecords records(body, separator_of(body));
  std::vector<std::string> header, cells;
  if (!records.next(header)) return bad_paper("the file has no line of column names");
  if (const auto fit = check_header(header, form); !fit) return fit.error();
  base::Error error{"bad_csv", "some rows are wrong"};
  std::vector<casedb::PaperForm> papers;
  std::set<std::string> people;
  for (std::size_t row = 1; records.next(cells) && error.findings.size() < kMostFaults; ++row) {
    const auto bad = [&](const std::string& what) {
      error.findings.push_back({"bad_csv", "row " + std::to_string(row) + " " + what});
    };
    if (cells.size() != header.size()) {
      bad("has another number of cells than the header");
      continue;
    }
    casedb::PaperForm paper;
    for (std::size_t i = 0; i < header.size(); ++i) {
      if (header[i] == "respondent")
        paper.respondent.code = cells[i];
      else if (header[i] == "group")
        paper.respondent.group = cells[i];
      else if (header[i] == "language")
        paper.respondent.language = cells[i];
      else if (header[i] != "version")
        paper.typed.emplace(header[i], cells[i]);
      else if (cells[i] != std::to_string(form.version))
        bad("has another version than version " + std::to_string(form.version) + ", which the round uses");
    }
    if (!people.insert(paper.respondent.code).second) bad("is for a respondent who is in an earlier row");
    papers.push_back(std::move(paper));
  }
  if (records.fault() != nullptr) return bad_paper(records.fault());
  if (!error.findings.empty()) return error;
  if (papers.empty()) return bad_paper("the file holds no answers");
  return papers;
}

std::vector<EntryDifference> entry_differences(const std::vector<casedb::PaperForm>& first,
                                               const std::vector<casedb::PaperForm>& second,
                                               const questionnaire::Form& form) {
  std::vector<EntryDifference> differences;
  std::map<std::string, const casedb::PaperForm*> by_code;
  for (const casedb::PaperForm& one : second) by_code.emplace(one.respondent.code, &one);
  for (const casedb::PaperForm& one : first) {
    const auto found = by_code.find(one.respondent.code);
    if (found == by_code.end()) {
      differences.push_back({one.respondent.code, "respondent", one.respondent.code, ""});
      continue;
    }
    const casedb::PaperForm& other = *found->second;
    const auto compare = [&](const std::string& column, const std::string& a, const std::string& b) {
      if (as_read(form, column, a) != as_read(form, column, b))
        differences.push_back({one.respondent.code, column, a, b});
    };
    compare("group", one.respondent.group, other.respondent.group);
    compare("language", one.respondent.language, other.respondent.language);
    for (const auto& [item_id, typed] : one.typed) compare(item_id, typed, other.typed.at(item_id));
    by_code.erase(found);
  }
  for (const auto& [code, paper] : by_code) differences.push_back({code, "respondent", "", code});
  return differences;
}

}  // namespace seldinger::app
