#include "web/json/jobs_json.h"

#include "casedb/database/values_json.h"

namespace seldinger::web {
namespace {

nlohmann::ordered_json json_of_job(const reports::JobView& job) {
  nlohmann::ordered_json results = nlohmann::ordered_json::array();
  for (const reports::JobResult& one : job.results) results.push_back({{"name", one.name}, {"bytes", one.bytes}});
  const double share = reports::share_done(job.doing);
  return {{"job_id", job.job_id},
          {"kind", job.kind},
          {"title", job.title},
          {"state", job.state},
          {"state_words", reports::job_state_text(job.state)},
          {"ended", job.ended()},
          {"asked_us", job.asked_us},
          {"files", job.files},
          {"sent_bytes", job.sent_bytes},
          {"doing", job.doing},
          {"share_done", share < 0.0 ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(share)},
          {"said", job.said},
          {"case_id", casedb::maybe(job.case_id)},
          {"results", results}};
}

}  // namespace

std::string jobs_json(std::span<const reports::JobView> jobs) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const reports::JobView& one : jobs) list.push_back(json_of_job(one));
  return casedb::line({{"jobs", list}});
}

std::string job_json(const reports::JobView& job) {
  return casedb::line(json_of_job(job));
}

}  // namespace seldinger::web
