#include "web/jobs/jobs.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <set>
#include <sstream>
#include <system_error>
#include <utility>

#include "casedb/database/uuid.h"
#include "sim/base/failure.h"
#include "web/jobs/job_json.h"

namespace seldinger::web {
namespace {

namespace fs = std::filesystem;

constexpr const char* kKept = "job.json";
constexpr const char* kFiles = "files";
constexpr const char* kResults = "results";
constexpr const char* kLock = ".lock";
constexpr const char* kStopped = "The server was stopped before the job had ended.";
constexpr std::size_t kMostSaid = 4000;
// Other: named unlike a slice, so that an import tells it from a lost one.
constexpr std::string_view kEndings[] = {"dcm", "nii", "nii.gz", "nrrd", "mha", "other"};

std::string text_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

// "0007.dcm"
std::string numbered(std::size_t number, const std::string& ending) {
  char text[32];
  std::snprintf(text, sizeof text, "%04zu.", number);
  return text + ending;
}

// Where it was cut in the middle of a letter, that letter goes too.
std::string shortened(std::string text) {
  if (text.size() <= kMostSaid) return text;
  std::size_t end = kMostSaid;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;
  return text.substr(0, end) + " …";
}

std::vector<JobFile> files_in(const fs::path& folder) {
  std::vector<JobFile> files;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder, none))
    if (entry.is_regular_file(none)) files.push_back({entry.path().filename().string(), entry.file_size(none)});
  std::sort(files.begin(), files.end(), [](const JobFile& a, const JobFile& b) { return a.name < b.name; });
  return files;
}

void make_folder(const fs::path& folder) {
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed) throw base::Failure("disk", "a job's folder cannot be made");
}

// Of the folder's lock; negative: another has it, or nothing can be written there. The kernel gives it back.
int locked(const fs::path& folder) {
  std::error_code none;
  fs::create_directories(folder, none);
  fs::permissions(folder, fs::perms::owner_all, none);
  const int lock = ::open((folder / kLock).c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0600);
  if (lock < 0 || ::flock(lock, LOCK_EX | LOCK_NB) == 0) return lock;
  ::close(lock);
  return -1;
}

base::Error no_job() {
  return {"no_job", "there is no such job"};
}

}  // namespace

Jobs::Jobs(fs::path folder, JobRunner runner, std::function<std::int64_t()> now_us, const JobLimits& limits)
    : folder_(std::move(folder)),
      runner_(std::move(runner)),
      now_us_(std::move(now_us)),
      limits_(limits),
      lock_(locked(folder_)) {
  if (lock_ < 0) return;
  load();
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

Jobs::~Jobs() {
  thread_.request_stop();
  {
    const std::lock_guard lock(mutex_);
    stop_running_.request_stop();
  }
  if (thread_.joinable()) thread_.join();
  if (lock_ >= 0) ::close(lock_);
}

void Jobs::load() {
  std::error_code none;
  for (const auto& person : fs::directory_iterator(folder_, none))
    for (const auto& entry : fs::directory_iterator(person.path(), none)) {
      auto job = job_from_json(text_of(entry.path() / kKept));
      if (!job || folder_of(*job) != entry.path()) continue;
      Job& one = jobs_.emplace(job->job_id, std::move(*job)).first->second;
      if (has_ended(one.state)) continue;
      try {
        end(one, JobState::interrupted, kStopped);
      } catch (const std::exception&) {
        // It cannot be written now: the next start says the same.
      }
    }
}

// Whole or not at all.
void Jobs::keep(const Job& job) const {
  const fs::path file = folder_of(job) / kKept, temporary = folder_of(job) / "job.tmp";
  {
    std::ofstream out(temporary, std::ios::binary | std::ios::trunc);
    out << json_of_kept_job(job);
    out.flush();
    if (!out) throw base::Failure("disk", "a job cannot be kept");
  }
  std::error_code failed;
  fs::rename(temporary, file, failed);
  if (failed) throw base::Failure("disk", "a job cannot be kept");
}

Job* Jobs::own(const std::string& person_id, const std::string& job_id) {
  const auto found = jobs_.find(job_id);
  return found == jobs_.end() || found->second.person_id != person_id ? nullptr : &found->second;
}

// What was sent goes at once, and what a runner that was killed left: a CT from outside lies here no longer than it
// is needed.
void Jobs::end(Job& job, JobState state, std::string said) {
  std::error_code none;
  std::vector<fs::path> gone;
  for (const auto& entry : fs::directory_iterator(folder_of(job), none)) {
    const fs::path name = entry.path().filename();
    if (name != kKept && !(name == kResults && state == JobState::done)) gone.push_back(entry.path());
  }
  for (const fs::path& one : gone) fs::remove_all(one, none);
  if (state == JobState::done) job.results = files_in(folder_of(job) / kResults);
  job.state = state;
  job.said = shortened(std::move(said));
  job.doing.clear();
  job.ended_us = now_us_();
  heard_us_.erase(job.job_id);
  keep(job);
}

// Not: its person was erased meanwhile.
bool Jobs::is_kept(const Job& job) const {
  std::error_code unknown;
  return fs::exists(folder_of(job) / kKept, unknown) || unknown;
}

void Jobs::forget(const std::string& job_id) {
  const auto found = jobs_.find(job_id);
  if (found == jobs_.end()) return;
  std::error_code none;
  fs::remove_all(folder_of(found->second), none);
  fs::remove(folder_of(found->second).parent_path(), none);  // when it was their last
  heard_us_.erase(job_id);
  jobs_.erase(found);
}

// A job that cannot be written holds up no other.
void Jobs::end_or_forget(const std::string& job_id, JobState state, std::string said) {
  Job& job = jobs_.at(job_id);
  if (!is_kept(job)) return forget(std::string(job_id));
  try {
    end(job, state, std::move(said));
  } catch (const std::exception&) {
    // The disk: a server that starts again calls it interrupted.
  }
}

void Jobs::drop_old(const std::string& person_id) {
  const std::int64_t now_us = now_us_();
  for (const auto& [job_id, heard] : std::map(heard_us_))
    if (now_us - heard > limits_.silent_us)
      end_or_forget(job_id, JobState::interrupted, "No more of its files arrived for an hour.");
  std::vector<const Job*> ended;  // of that person, newest first
  for (const auto& [job_id, job] : jobs_)
    if (job.person_id == person_id && has_ended(job.state)) ended.push_back(&job);
  std::sort(ended.begin(), ended.end(), [](const Job* a, const Job* b) { return a->ended_us > b->ended_us; });
  for (std::size_t i = 0; i < ended.size(); ++i) {
    if (i < limits_.most_kept_of_one && now_us - ended[i]->ended_us < limits_.kept_us) continue;
    forget(std::string(ended[i]->job_id));
  }
}

void Jobs::drop_everybodys_old() {
  std::set<std::string> people;
  std::vector<std::string> gone;
  for (const auto& [job_id, job] : jobs_) {
    people.insert(job.person_id);
    if (!is_kept(job)) gone.push_back(job_id);
  }
  for (const std::string& job_id : gone) forget(job_id);
  for (const std::string& person_id : people) drop_old(person_id);
}

base::Result<std::string> Jobs::ask(const std::string& person_id, JobKind kind,
                                    const std::map<std::string, std::string>& wish) {
  if (lock_ < 0)
    return base::Error{
        "no_job",
        "No jobs are accepted here: another server runs this library's, or the library cannot be written."};
  const std::lock_guard lock(mutex_);
  drop_old(person_id);
  const auto open = std::count_if(jobs_.begin(), jobs_.end(), [&](const auto& one) {
    return one.second.person_id == person_id && !has_ended(one.second.state);
  });
  if (static_cast<std::size_t>(open) >= limits_.most_open_of_one)
    return base::Error{"too_many_jobs", "Some of your jobs have not ended yet: wait for them, or cancel one."};
  Job job;
  job.job_id = casedb::new_uuid();
  job.person_id = person_id;
  job.kind = kind;
  job.state = kind == JobKind::import_ct ? JobState::receiving : JobState::waiting;
  job.wish = wish;
  job.asked_us = now_us_();
  make_folder(folder_of(job) / kFiles);
  fs::permissions(folder_, fs::perms::owner_all);
  keep(job);
  if (job.state == JobState::receiving) heard_us_[job.job_id] = job.asked_us;
  const std::string job_id = job.job_id;
  jobs_.emplace(job_id, std::move(job));
  asked_.notify_all();
  return job_id;
}

std::vector<Job> Jobs::list(const std::string& person_id) {
  const std::lock_guard lock(mutex_);
  drop_old(person_id);
  std::vector<Job> own_ones;
  for (const auto& [job_id, job] : jobs_)
    if (job.person_id == person_id) own_ones.push_back(job);
  std::reverse(own_ones.begin(), own_ones.end());  // ids begin with the time
  return own_ones;
}

std::optional<Job> Jobs::find(const std::string& person_id, const std::string& job_id) {
  const std::lock_guard lock(mutex_);
  const Job* job = own(person_id, job_id);
  return job == nullptr ? std::nullopt : std::optional(*job);
}

base::Result<void> Jobs::receive(const std::string& person_id, const std::string& job_id, std::size_t number,
                                 const std::string& ending, std::uint64_t at, std::span<const std::byte> piece) {
  const std::lock_guard lock(mutex_);
  Job* job = own(person_id, job_id);
  if (job == nullptr) return no_job();
  if (job->state != JobState::receiving) return base::Error{"bad_piece", "the job accepts no more files"};
  const bool known = std::find(std::begin(kEndings), std::end(kEndings), ending) != std::end(kEndings);
  if (known && number == 0 && at == 0 && !job->files.empty()) {  // a page that was loaded again
    std::error_code none;
    fs::remove_all(folder_of(*job) / kFiles, none);
    make_folder(folder_of(*job) / kFiles);
    job->files.clear();
  }
  const bool is_next = number == job->files.size() && at == 0;
  const bool goes_on = !job->files.empty() && number == job->files.size() - 1 && at == job->files.back().bytes;
  if (!known || (!is_next && !goes_on)) return base::Error{"bad_piece", "the piece is not the next one of a file"};
  std::uint64_t sent = piece.size();
  for (const JobFile& one : job->files) sent += one.bytes;
  if (sent > limits_.most_sent_bytes || number >= limits_.most_files)
    return base::Error{"too_large", "that is more than is accepted here: `seldinger import` takes larger ones"};
  std::error_code failed;
  const auto space = fs::space(folder_of(*job), failed);
  if (failed || space.available < limits_.free_bytes + piece.size())
    return base::Error{"disk", "there is too little room left on the server"};
  if (is_next) job->files.push_back({numbered(number, ending), 0});
  std::ofstream out(folder_of(*job) / kFiles / job->files.back().name, std::ios::binary | std::ios::app);
  out.write(reinterpret_cast<const char*>(piece.data()), static_cast<std::streamsize>(piece.size()));
  out.flush();
  if (!out) {
    end(*job, JobState::failed, "A file could not be written on the server.");
    return base::Error{"disk", "a file cannot be written on the server"};
  }
  job->files.back().bytes += piece.size();
  heard_us_[job_id] = now_us_();
  return {};
}

base::Result<void> Jobs::all_sent(const std::string& person_id, const std::string& job_id) {
  const std::lock_guard lock(mutex_);
  Job* job = own(person_id, job_id);
  if (job == nullptr) return no_job();
  if (job->state != JobState::receiving || job->files.empty())
    return base::Error{"bad_piece", "no file of the job has been sent"};
  job->state = JobState::waiting;
  heard_us_.erase(job_id);
  keep(*job);
  asked_.notify_all();
  return {};
}

base::Result<void> Jobs::cancel(const std::string& person_id, const std::string& job_id) {
  const std::lock_guard lock(mutex_);
  Job* job = own(person_id, job_id);
  if (job == nullptr) return no_job();
  if (job->state == JobState::running) {
    stop_running_.request_stop();
  } else if (!has_ended(job->state)) {
    end(*job, JobState::cancelled, "You cancelled it.");
  }
  return {};
}

base::Result<void> Jobs::remove(const std::string& person_id, const std::string& job_id) {
  const std::lock_guard lock(mutex_);
  const Job* job = own(person_id, job_id);
  if (job == nullptr) return no_job();
  if (has_ended(job->state)) forget(job_id);
  return {};
}

base::Result<std::vector<std::byte>> Jobs::load_result(const std::string& person_id, const std::string& job_id,
                                                       std::size_t number) {
  fs::path file;
  {
    const std::lock_guard lock(mutex_);
    const Job* job = own(person_id, job_id);
    if (job == nullptr || job->state != JobState::done || number >= job->results.size() ||
        job->results[number].bytes > limits_.most_result_bytes)
      return no_job();
    file = folder_of(*job) / kResults / job->results[number].name;
  }
  std::error_code none;
  if (!fs::is_regular_file(file, none)) return no_job();
  const std::string text = text_of(file);
  const auto bytes = std::as_bytes(std::span(text));
  return std::vector<std::byte>(bytes.begin(), bytes.end());
}

void Jobs::run(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    std::optional<Job> next;
    std::stop_token cancelled;
    {
      std::unique_lock lock(mutex_);
      drop_everybodys_old();
      const auto waits = [](const auto& one) { return one.second.state == JobState::waiting; };
      const auto any_waits = [&] { return std::any_of(jobs_.begin(), jobs_.end(), waits); };
      const bool there_is_one = asked_.wait_for(lock, stop, limits_.looks_every, any_waits);
      if (stop.stop_requested()) return;
      if (!there_is_one) continue;
      Job& first = std::find_if(jobs_.begin(), jobs_.end(), waits)->second;  // ids begin with the time
      first.state = JobState::running;
      stop_running_ = std::stop_source();
      cancelled = stop_running_.get_token();
      next = first;
    }
    do_one(*next, cancelled, stop);
  }
}

void Jobs::do_one(const Job& job, const std::stop_token& cancelled, const std::stop_token& stop) {
  const auto doing = [&](std::string_view text) {
    const std::lock_guard lock(mutex_);
    jobs_.at(job.job_id).doing = text;
  };
  JobEnd ended;
  try {
    // Alone, and not what it lies in: that is gone when its person was erased.
    fs::create_directory(folder_of(job) / kResults);
    ended = runner_(job, folder_of(job), doing, cancelled);
  } catch (const std::exception&) {
    ended = {false, "It could not be run on the server.", {}};  // its text may hold anything
  }
  const std::lock_guard lock(mutex_);
  jobs_.at(job.job_id).made_id = ended.made_id;
  if (ended.done)
    end_or_forget(job.job_id, JobState::done, std::move(ended.said));
  else if (stop.stop_requested())
    end_or_forget(job.job_id, JobState::interrupted, kStopped);
  else if (cancelled.stop_requested())
    end_or_forget(job.job_id, JobState::cancelled, "You cancelled it.");
  else
    end_or_forget(job.job_id, JobState::failed, std::move(ended.said));
}

}  // namespace seldinger::web
