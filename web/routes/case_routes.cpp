// Cases, the curricula that they stand in, and what their metrics mean.
#include "reports/pages/case_page.h"
#include "reports/pages/curricula_page.h"
#include "reports/pages/metrics_page.h"
#include "web/json/case_json.h"
#include "web/json/lists_json.h"
#include "web/routes/shelves.h"
#include "web/site/access.h"
#include "web/site/site.h"

namespace seldinger::web {
namespace {

using casedb::Action;
constexpr std::string_view kCurricula =
    "trainee: published, own states; mentor, director: all; researcher: no drafts";
constexpr std::string_view kCases =
    "mentor: all; director: no drafts; researcher, admin: published and retired, without reviewers' notes";

std::vector<casedb::CaseRow> visible_cases(Site& site, const Call& call) {
  std::vector<casedb::CaseRow> seen;
  for (casedb::CaseRow& row : site.questions.list_cases())
    if (may_see_case(call.reader->account.role, row)) {
      withhold(call.reader->account.role, row);
      seen.push_back(std::move(row));
    }
  return seen;
}

Response list_cases(Site& site, const Call& call) {
  return list_response(reports::cases_page(call.reader->visitor(), visible_cases(site, call)));
}

Response list_cases_json(Site& site, const Call& call) {
  return json_response(cases_json(visible_cases(site, call)));
}

std::optional<casedb::CaseParts> visible_case(Site& site, const Call& call) {
  auto parts = site.questions.find_case(call.id);
  if (!parts.has_value() || !may_see_case(call.reader->account.role, parts->row)) return std::nullopt;
  withhold(call.reader->account.role, *parts);
  return std::move(*parts);
}

Response show_case(Site& site, const Call& call) {
  const auto parts = visible_case(site, call);
  if (!parts.has_value()) return refusal(404, call.reader);
  return html_response(200, reports::case_page(call.reader->visitor(), *parts));
}

Response show_case_json(Site& site, const Call& call) {
  const auto parts = visible_case(site, call);
  if (!parts.has_value()) return refusal(404, call.reader);
  return {.content_type = "application/json", .body = case_json(*parts)};
}

Response show_checks(Site& site, const Call& call) {
  const auto parts = visible_case(site, call);
  if (!parts.has_value()) return refusal(404, call.reader);
  const std::string& case_id = parts->row.case_id;
  const std::string mark = site.questions.case_mark(case_id);
  auto checks = site.answers.get(case_id + " " + mark, [&]() -> base::Result<Answers::Made> {
    const auto check = site.questions.check_case(parts->row);
    if (!check) return check.error();
    return Answers::Made{checks_json(case_id, *check), check->content_mark == mark};
  });
  if (!checks) return site.fault(500, call.reader, checks.error().code + ": a case cannot be checked");
  return {.content_type = "application/json", .body = (*checks)->text};
}

Response list_metrics(Site&, const Call& call) {
  return html_response(200, reports::metrics_page(call.reader->visitor()));
}

std::vector<reports::CurriculumView> visible_curricula(Site& site, const Call& call) {
  const casedb::Account& account = call.reader->account;
  const bool own = account.role == casedb::Role::trainee;
  auto views = site.questions.list_curricula(own ? std::optional(account.person_id) : std::nullopt);
  std::erase_if(views, [&](const auto& one) { return !may_see_curriculum(account.role, one.curriculum); });
  for (auto& view : views)
    for (casedb::ItemState& item : view.items) withhold(account.role, item);
  return views;
}

Response list_curricula(Site& site, const Call& call) {
  return html_response(200, reports::curricula_page(call.reader->visitor(), visible_curricula(site, call),
                                                    site.questions.dependability()));
}

Response list_curricula_json(Site& site, const Call& call) {
  return json_response(curricula_json(visible_curricula(site, call),
                                      call.reader->account.role == casedb::Role::trainee,
                                      site.questions.dependability()));
}

constexpr Route kCaseRoutes[] = {
    {"GET", "/metrics", kAnyRole, true, "", "what each metric measures; #metric-ID", list_metrics},
    {"GET", "/curricula", Action::see_curriculum, true, kCurricula, "items, gates, and how far the trainee is",
     list_curricula},
    {"GET", "/curricula.json", Action::see_curriculum, false, kCurricula,
     "the same: items, gates, how many attempts they allow, and what passing one case shows", list_curricula_json},
    {"GET", "/cases", Action::see_case, true, kCases, "the list, oldest first", list_cases},
    {"GET", "/cases.json", Action::see_case, false, kCases, "the same list", list_cases_json},
    {"GET", "/cases/{case_id}", Action::see_case, true, kCases,
     "one case: state, version, who reviewed it, needle, patient, structures, rule", show_case},
    {"GET", "/cases/{case_id}/case.json", Action::see_case, false, kCases, "as `case show` prints it",
     show_case_json},
    {"GET", "/cases/{case_id}/checks.json", Action::see_case, false, kCases,
     "its checks as `case check` prints them", show_checks, Lane::heavy},
};

}  // namespace

std::span<const Route> case_routes() {
  return kCaseRoutes;
}

}  // namespace seldinger::web
