#include "web/jobs/job_json.h"

#include <nlohmann/json.hpp>

namespace seldinger::web {
namespace {

using Json = nlohmann::ordered_json;

Json json_of_files(const std::vector<JobFile>& files) {
  Json list = Json::array();
  for (const JobFile& one : files) list.push_back({{"name", one.name}, {"bytes", one.bytes}});
  return list;
}

std::vector<JobFile> files_from(const Json& list) {
  std::vector<JobFile> files;
  for (const Json& one : list) files.push_back({one.at("name"), one.at("bytes")});
  return files;
}

}  // namespace

std::string json_of_kept_job(const Job& job) {
  return Json{{"job_id", job.job_id},
              {"person_id", job.person_id},
              {"kind", base::name_of(kJobKindNames, job.kind)},
              {"state", base::name_of(kJobStateNames, job.state)},
              {"wish", job.wish},
              {"asked_us", job.asked_us},
              {"ended_us", job.ended_us},
              {"files", json_of_files(job.files)},
              {"said", job.said},
              {"made_id", job.made_id},
              {"results", json_of_files(job.results)}}
             .dump(-1, ' ', false, Json::error_handler_t::replace) +
         "\n";
}

std::optional<Job> job_from_json(const std::string& text) {
  try {
    const Json json = Json::parse(text);
    const auto kind = base::from_name(kJobKindNames, json.at("kind").get<std::string>());
    const auto state = base::from_name(kJobStateNames, json.at("state").get<std::string>());
    if (!kind || !state) return std::nullopt;
    Job job;
    job.job_id = json.at("job_id");
    job.person_id = json.at("person_id");
    job.kind = *kind;
    job.state = *state;
    job.wish = json.at("wish").get<std::map<std::string, std::string>>();
    job.asked_us = json.at("asked_us");
    job.ended_us = json.at("ended_us");
    job.files = files_from(json.at("files"));
    job.said = json.at("said");
    job.made_id = json.at("made_id");
    job.results = files_from(json.at("results"));
    return job;
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  }
}

}  // namespace seldinger::web
