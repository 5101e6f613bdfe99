#include "app/library/job_program.h"

#include <optional>
#include <string_view>
#include <system_error>

#include "app/acting/token_file.h"
#include "app/library/child_process.h"
#include "casedb/database/credentials.h"
#include "casedb/database/library.h"
#include "casedb/people/login_session.h"
#include "casedb/people/people.h"

namespace seldinger::app {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kError = "error: ", kMadeCase = "case ";

std::string wish_of(const web::Job& job, const std::string& name) {
  const auto found = job.wish.find(name);
  return found == job.wish.end() ? "" : found->second;
}

// One file, or the folder of several.
fs::path source_of(const web::Job& job, const fs::path& folder) {
  return job.files.size() == 1 ? folder / "files" / job.files.front().name : folder / "files";
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  for (std::size_t at = text.find(what); at != text.npos; at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
  return text;
}

// Without what the server's disk is like.
std::string without_places(std::string text, const web::Job& job, const fs::path& folder, const fs::path& library) {
  for (const fs::path& place : {source_of(job, folder), folder / "files", folder / "results", folder, library})
    text = replaced(std::move(text), place.string(), "…");
  return replaced(std::move(text), "SOURCE \"…\": ", "");
}

// What it said of why not: from the first "error: " on, without that word and the code.
std::string reason_of(const ChildEnd& end) {
  const std::size_t at = end.errors.find(kError);
  if (at == end.errors.npos) return "It ended without a message.";
  const std::string text = end.errors.substr(at + kError.size());
  const std::size_t colon = text.find(": ");
  return colon == text.npos || colon > text.find('\n') ? text : text.substr(colon + 2);
}

// A session of the command line, for as long as the job runs.
class ActingSession {
 public:
  ActingSession(const fs::path& library, const std::string& person_id, fs::path file) : file_(std::move(file)) {
    if (auto opened = casedb::Library::open(library)) library_.emplace(std::move(*opened));
    const auto account = library_ ? casedb::find_user(*library_, person_id) : std::nullopt;
    if (!account || !account->enabled) return;
    token_ = casedb::begin_login_session(*library_, *account);
    write_token(file_, token_);
  }
  ~ActingSession() {
    std::error_code none;
    fs::remove(file_, none);
    try {
      if (!token_.empty()) casedb::end_login_session(*library_, token_);
    } catch (const std::exception&) {
      // It ends by itself.
    }
    casedb::wipe(token_);
  }
  ActingSession(const ActingSession&) = delete;
  ActingSession& operator=(const ActingSession&) = delete;
  bool begun() const noexcept { return !token_.empty(); }

 private:
  fs::path file_;
  std::optional<casedb::Library> library_;
  std::string token_;
};

// "": it made none. It says so as soon as the case is there, before it has ended.
std::string made_case_of(const web::Job& job, const std::string& output) {
  const std::size_t line_end = output.find('\n');
  if (job.kind != web::JobKind::import_ct || !output.starts_with(kMadeCase) || line_end == output.npos) return "";
  return output.substr(kMadeCase.size(), line_end - kMadeCase.size());
}

web::JobEnd run_job(const web::Job& job, const fs::path& folder, const fs::path& library,
                    const std::function<void(std::string_view)>& doing, const std::stop_token& stop) {
  const fs::path token = folder / "session";
  const ActingSession session(library, job.person_id, token);
  if (!session.begun()) return {false, "Your account is closed.", {}};
  if (job.kind == web::JobKind::study_export) fs::remove(folder / "results");  // an export makes its folder
  std::vector<std::string> words = words_of_job(job, folder);
  words.insert(words.end(), {"--library", library.string(), "--token-file", token.string()});
  const ChildEnd end = run_this_program(words, doing, stop);
  web::JobEnd ended;
  ended.made_id = made_case_of(job, end.output);
  ended.done = end.exit_code == 0 || !ended.made_id.empty();
  ended.said = without_places(ended.done ? end.output : reason_of(end), job, folder, library);
  return ended;
}

}  // namespace

std::vector<std::string> words_of_job(const web::Job& job, const fs::path& folder) {
  switch (job.kind) {
    case web::JobKind::study_report:
      return {"report",  "validity",
              "--study", wish_of(job, "study"),
              "--out",   (folder / "results" / "validity-report.html").string()};
    case web::JobKind::study_export:
      return {"export", "--study", wish_of(job, "study"), "--raw", "none", "--out", (folder / "results").string()};
    case web::JobKind::import_ct:
      break;
  }
  std::vector<std::string> words = {"import", source_of(job, folder).string()};
  for (const char* name : {"title", "modality", "position", "face"})
    if (const std::string value = wish_of(job, name); !value.empty())
      words.insert(words.end(), {"--" + std::string(name), value});
  if (wish_of(job, "no_burned_in_text") == "yes") words.emplace_back("--no-burned-in-text");
  return words;
}

web::JobRunner job_runner(fs::path library) {
  return [library = std::move(library)](
             const web::Job& job, const fs::path& folder, const std::function<void(std::string_view)>& doing,
             const std::stop_token& stop) { return run_job(job, folder, library, doing, stop); };
}

}  // namespace seldinger::app
