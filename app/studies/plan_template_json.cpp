#include "app/studies/plan_template_json.h"

#include <nlohmann/json.hpp>

#include "assessment/registry.h"
#include "casedb/database/values_json.h"

namespace seldinger::app {
namespace {

using Json = nlohmann::ordered_json;

Json outcome(const std::string& name, const char* metric, const std::string& case_id, const char* better,
             double smallest) {
  return {{"name", name},
          {"metric", metric},
          {"version", assessment::find_metric(metric)->version},
          {"case", case_id},
          {"visit", "baseline"},
          {"test", "brunner_munzel"},
          {"compare", {"novices", "experienced"}},
          {"better", better},
          {"smallest_worthwhile", smallest}};
}

Json claim(const char* inference, const char* words, const char* rebuttal) {
  return {{"inference", inference}, {"claim", words}, {"evidence", ""}, {"rebuttals", {rebuttal}}};
}

}  // namespace

std::string plan_template(const std::string& case_id) {
  const Json plan = {
      {"title", "Needle placement by novices and experienced radiologists"},
      {"intended_use", "REPLACE: what are the numbers to be used for?"},
      {"decision", "REPLACE: what is decided by them, and about whom?"},
      {"people", "real"},
      {"argument",
       {claim("scoring", "The distance from the needle's tip to the target is measured as it was.",
              "Hands without force; poor tracking."),
        claim("generalisation", "Other attempts at such a case would give much the same.",
              "One case; attempts of one day."),
        claim("extrapolation", "Who punctures more often does better here.", "Groups that do not differ."),
        claim("implications", "Feedback by this number does more good than harm.",
              "People train for the number and not for the patient.")}},
      {"groups",
       {{{"name", "novices"},
         {"facts", Json::array({{{"fact", "years_in_radiology"}, {"comparison", "<="}, {"value", 1}}})}},
        {{"name", "experienced"},
         {"facts", Json::array({{{"fact", "years_in_radiology"}, {"comparison", ">="}, {"value", 5}}})}}}},
      {"visits", Json::array({{{"name", "baseline"}, {"from_day", -365}, {"to_day", 30}}})},
      {"primary", Json::array({outcome("Distance to the target", "tip_target_dist", case_id, "lower", 2.0)})},
      {"secondary", Json::array({outcome("Time", "time_total", case_id, "lower", 10.0)})},
      {"stopping", {{"per_group", 20}, {"rule", "REPLACE: why so many?"}}},
      {"missing", {{"absent", "left_out"}, {"why", "REPLACE: why does somebody have no attempt?"}}},
      {"exclusions", Json::array()},
      {"hands", "one"},
      {"alpha", 0.05}};
  return casedb::text(plan);
}

}  // namespace seldinger::app
