// The jobs of a server: one runs at a time, the others wait in the order in which they were asked for. Each has a
// folder of its own, `folder`/PERSON/JOB, so that what is somebody's is found by their id, and a server that starts
// again knows what was asked: what had not ended by then says that it was interrupted. A folder's jobs are those of
// one server at a time (`folder`/.lock): a second one has none, and touches nothing. Called from several threads.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "sim/base/result.h"
#include "web/jobs/job.h"

namespace seldinger::web {

struct JobLimits {
  std::size_t most_open_of_one = 3;                                  // not ended, of one person
  std::size_t most_kept_of_one = 20;                                 // the oldest that have ended make room
  std::size_t most_files = 4000;                                     // sent for one job
  std::uint64_t most_sent_bytes = std::uint64_t{2} << 30;            // for one job
  std::uint64_t most_result_bytes = std::uint64_t{12} << 20;         // of one file: an answer is held in memory
  std::uint64_t free_bytes = std::uint64_t{2} << 30;                 // that stay free where jobs lie
  std::int64_t kept_us = std::int64_t{7} * 86'400'000'000;           // after its end
  std::int64_t silent_us = 3'600'000'000;                            // of which nothing more is sent ends
  std::chrono::milliseconds looks_every = std::chrono::minutes(10);  // for old ones, when nobody asks
};

class Jobs {
 public:
  // `now_us` since 1970.
  Jobs(std::filesystem::path folder, JobRunner runner, std::function<std::int64_t()> now_us,
       const JobLimits& limits = {});
  ~Jobs();  // what runs is asked to stop, and is interrupted
  Jobs(const Jobs&) = delete;
  Jobs& operator=(const Jobs&) = delete;

  // The id of a new one: an import receives its files first, others wait for their turn. Refused: `too_many_jobs`;
  // `no_job`: another server has the jobs.
  base::Result<std::string> ask(const std::string& person_id, JobKind kind,
                                const std::map<std::string, std::string>& wish);
  // Newest first; and one of them. Nobody learns of another's.
  std::vector<Job> list(const std::string& person_id);
  std::optional<Job> find(const std::string& person_id, const std::string& job_id);

  // More of the file of that number, which begins with the next number and is called `number`.`ending`; the first
  // one's beginning begins all anew. Refused: `no_job`, `bad_piece` (not the next one, or of a name that is none),
  // `too_large`, `disk`.
  base::Result<void> receive(const std::string& person_id, const std::string& job_id, std::size_t number,
                             const std::string& ending, std::uint64_t at, std::span<const std::byte> piece);
  base::Result<void> all_sent(const std::string& person_id, const std::string& job_id);
  // Nothing happens to what has ended. `no_job`.
  base::Result<void> cancel(const std::string& person_id, const std::string& job_id);
  // Only what has ended, with its results. `no_job`.
  base::Result<void> remove(const std::string& person_id, const std::string& job_id);
  base::Result<std::vector<std::byte>> load_result(const std::string& person_id, const std::string& job_id,
                                                   std::size_t number);  // `no_job`

 private:
  using ById = std::map<std::string, Job>;

  std::filesystem::path folder_of(const Job& job) const { return folder_ / job.person_id / job.job_id; }
  Job* own(const std::string& person_id, const std::string& job_id);
  void load();
  void keep(const Job& job) const;
  void end(Job& job, JobState state, std::string said);
  void end_or_forget(const std::string& job_id, JobState state, std::string said);
  bool is_kept(const Job& job) const;
  void forget(const std::string& job_id);
  void drop_old(const std::string& person_id);
  void drop_everybodys_old();
  void run(const std::stop_token& stop);
  void do_one(const Job& job, const std::stop_token& cancelled, const std::stop_token& stop);

  const std::filesystem::path folder_;
  const JobRunner runner_;
  const std::function<std::int64_t()> now_us_;
  const JobLimits limits_;
  const int lock_;    // held as long as it is open; negative: another has it
  std::mutex mutex_;  // guards what follows
  std::condition_variable_any asked_;
  ById jobs_;
  std::map<std::string, std::int64_t> heard_us_;  // of those that receive: when something came last
  std::string running_;                           // its id
  std::stop_source stop_running_;
  std::jthread thread_;
};

}  // namespace seldinger::web
