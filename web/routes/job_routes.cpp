// Long work: importing a CT that is sent from a browser, a study's report and export. Each is its asker's alone.
#include <charconv>

#include "reports/pages/people/jobs_page.h"
#include "reports/pages/style_sheet.h"
#include "web/jobs/jobs.h"
#include "web/json/jobs_json.h"
#include "web/routes/shelves.h"
#include "web/site/base64url.h"
#include "web/site/site.h"

namespace seldinger::web {
namespace {

using casedb::Action;
using casedb::may;
constexpr std::string_view kOwnJobs = "of oneself";

reports::JobView view_of(const Job& job) {
  reports::JobView view;
  view.job_id = job.job_id;
  view.kind = base::name_of(kJobKindNames, job.kind);
  const auto title = job.wish.find("title");
  if (title != job.wish.end()) view.title = title->second;
  view.state = base::name_of(kJobStateNames, job.state);
  view.asked_us = job.asked_us;
  view.files = job.files.size();
  for (const JobFile& one : job.files) view.sent_bytes += one.bytes;
  view.doing = job.doing;
  view.said = job.said;
  view.case_id = job.made_id;
  for (const JobFile& one : job.results)
    view.results.push_back({one.name, one.bytes, one.bytes > JobLimits().most_result_bytes});
  return view;
}

std::vector<reports::JobView> own_jobs(Site& site, const Call& call) {
  std::vector<reports::JobView> views;
  if (site.surroundings.jobs)
    for (const Job& one : site.surroundings.jobs->list(call.reader->account.person_id))
      views.push_back(view_of(one));
  return views;
}

std::optional<Job> own_job(Site& site, const Call& call) {
  return site.surroundings.jobs ? site.surroundings.jobs->find(call.reader->account.person_id, call.id)
                                : std::nullopt;
}

Response jobs_page(Site& site, const Call& call, int status, std::string_view problem) {
  Response response =
      html_response(status, reports::jobs_page(call.reader->visitor(), own_jobs(site, call),
                                               may(call.reader->account.role, Action::add_case), problem));
  response.policy = Policy::list;
  return response;
}

Response list_jobs(Site& site, const Call& call) {
  return jobs_page(site, call, 200, "");
}

Response list_jobs_json(Site& site, const Call& call) {
  return json_response(jobs_json(own_jobs(site, call)));
}

Response show_job(Site& site, const Call& call) {
  const auto job = own_job(site, call);
  if (!job) return refusal(404, call.reader);
  Response response = html_response(200, reports::job_page(call.reader->visitor(), view_of(*job)));
  response.policy = Policy::replay;
  return response;
}

Response show_job_json(Site& site, const Call& call) {
  const auto job = own_job(site, call);
  return job ? json_response(job_json(view_of(*job))) : refusal(404, call.reader);
}

bool may_work_on(Site& site, const casedb::Account& account, JobKind kind, const std::string& study_id) {
  const Action action = kind == JobKind::study_report ? Action::plan_study : Action::export_study;
  return may(account.role, action, site.questions.relation_to_study(account.person_id, study_id));
}

// Whether the reader may have that done; what is asked for it goes into `wish`.
bool may_ask(Site& site, const Call& call, JobKind kind, std::map<std::string, std::string>& wish) {
  const casedb::Account& account = call.reader->account;
  if (kind == JobKind::import_ct) {
    for (const char* name : {"title", "modality", "position", "face", "no_burned_in_text"})
      wish[name] = call.field(name);
    return may(account.role, Action::add_case);
  }
  const std::string study_id = call.field("study");
  if (!may_work_on(site, account, kind, study_id)) return false;
  const auto study = site.questions.find_study(study_id);
  if (!study) return false;
  wish = {{"study", study_id}, {"title", study->study.title}};
  return true;
}

Response ask_job(Site& site, const Call& call) {
  const auto kind = base::from_name(kJobKindNames, call.field("kind"));
  if (!kind || !site.surroundings.jobs) return refusal(400, call.reader);
  std::map<std::string, std::string> wish;
  if (!may_ask(site, call, *kind, wish)) return refusal(404, call.reader);
  if (const auto& title = wish["title"]; *kind == JobKind::import_ct && !title.empty())
    if (const auto fits = casedb::check_case_title(title); !fits)
      return jobs_page(site, call, 400, "That is not a valid title for a case: " + fits.error().text + ".");
  const auto asked = site.surroundings.jobs->ask(call.reader->account.person_id, *kind, wish);
  if (!asked) return jobs_page(site, call, asked.error().code == "no_job" ? 503 : 429, asked.error().text);
  return redirect("/jobs/" + *asked);
}

// To the script that sends files, in words.
Response told(const base::Result<void>& result) {
  if (result) return {.status = 200, .content_type = "text/plain; charset=utf-8", .body = "ok\n"};
  const std::string& code = result.error().code;
  const int status = code == "no_job" ? 404 : code == "too_large" ? 413 : code == "disk" ? 507 : 409;
  return {.status = status, .content_type = "text/plain; charset=utf-8", .body = result.error().text + "\n"};
}

template <typename Number>
bool read_number(const std::string& text, Number& number) {
  const auto read = std::from_chars(text.data(), text.data() + text.size(), number);
  return !text.empty() && read.ec == std::errc() && read.ptr == text.data() + text.size();
}

Response receive_piece(Site& site, const Call& call) {
  std::size_t number = 0;
  std::uint64_t at = 0;
  const auto piece = bytes_from_base64url(call.field("data"));
  if (!own_job(site, call)) return refusal(404, call.reader);
  if (!piece || !read_number(call.field("number"), number) || !read_number(call.field("at"), at))
    return refusal(400, call.reader);
  return told(site.surroundings.jobs->receive(call.reader->account.person_id, call.id, number, call.field("ending"),
                                              at, *piece));
}

Response start_job(Site& site, const Call& call) {
  if (!own_job(site, call)) return refusal(404, call.reader);
  return told(site.surroundings.jobs->all_sent(call.reader->account.person_id, call.id));
}

Response cancel_job(Site& site, const Call& call) {
  if (!own_job(site, call)) return refusal(404, call.reader);
  const std::string& person_id = call.reader->account.person_id;
  // A page that is out of date cancels what has ended, and means no results.
  static_cast<void>(call.field("remove") == "yes" ? site.surroundings.jobs->remove(person_id, call.id)
                                                  : site.surroundings.jobs->cancel(person_id, call.id));
  return redirect(own_job(site, call) ? "/jobs/" + call.id : "/jobs");
}

Response load_result(Site& site, const Call& call) {
  const auto job = own_job(site, call);
  const auto asked = form_fields(call.request.query);
  std::size_t number = 0;
  if (!job || !asked || !asked->contains("n") || !read_number(asked->at("n"), number) ||
      number >= job->results.size())
    return refusal(404, call.reader);
  // Whoever no longer works on the study gets no more of it.
  const auto study = job->wish.find("study");
  if (job->kind != JobKind::import_ct &&
      (study == job->wish.end() || !may_work_on(site, call.reader->account, job->kind, study->second)))
    return refusal(404, call.reader);
  const auto bytes = site.surroundings.jobs->load_result(call.reader->account.person_id, call.id, number);
  if (!bytes) return refusal(404, call.reader);
  const std::string& name = job->results[number].name;  // of ours
  Response response{.content_type =
                        name.ends_with(".html") ? "text/html; charset=utf-8" : "application/octet-stream"};
  response.body.assign(reinterpret_cast<const char*>(bytes->data()), bytes->size());
  response.headers.emplace_back("Content-Disposition", "attachment; filename=\"" + name + "\"");
  return response;
}

Response jobs_script(Site&, const Call&) {
  return {.content_type = "text/javascript; charset=utf-8", .body = std::string(reports::jobs_script())};
}

constexpr Route kJobRoutes[] = {
    {"GET", "/jobs.js", kOpen, false, "", "the script that sends files and shows how far a job is", jobs_script},
    {"GET", "/jobs", Action::run_job, true, kOwnJobs, "the list, newest first", list_jobs},
    {"GET", "/jobs.json", Action::run_job, false, kOwnJobs, "the same list", list_jobs_json},
    {"POST", "/jobs", Action::run_job, true, "mentor, admin: an import; researcher: own studies",
     "asks for one: kind (import, study_report, study_export); title, modality, position, face and "
     "no_burned_in_text, or study; token",
     ask_job, Lane::changes},
    {"GET", "/jobs/{job_id}", Action::run_job, true, kOwnJobs, "how far it is, and what came of it", show_job},
    {"GET", "/jobs/{job_id}/job.json", Action::run_job, false, kOwnJobs, "the same", show_job_json},
    {"GET", "/jobs/{job_id}/result", Action::run_job, false, kOwnJobs, "one of its files, up to 12 MB; ?n=N",
     load_result, Lane::heavy},
    {"POST", "/jobs/{job_id}/files", Action::run_job, false, kOwnJobs,
     "a piece of a file of an import: number, ending (dcm, nii, nii.gz, nrrd, mha, other), at, data in base64url, "
     "token",
     receive_piece, Lane::changes},
    {"POST", "/jobs/{job_id}/start", Action::run_job, false, kOwnJobs, "all files of an import are sent: token",
     start_job, Lane::changes},
    {"POST", "/jobs/{job_id}/cancel", Action::run_job, true, kOwnJobs,
     "cancels it; with remove=yes removes one that has ended: token", cancel_job, Lane::changes},
};

}  // namespace

std::span<const Route> job_routes() {
  return kJobRoutes;
}

}  // namespace seldinger::web
