#include "web/routes/openapi_json.h"

#include <nlohmann/json.hpp>

#include "sim/base/training_only.h"

namespace seldinger::web {
namespace {

using Json = nlohmann::ordered_json;

// What a path's end says of its answer.
std::string content_of(std::string_view pattern) {
  for (const auto& [end, type] : {std::pair{std::string_view(".json"), "application/json"},
                                  {".png", "image/png"},
                                  {".css", "text/css"},
                                  {".js", "text/javascript"},
                                  {".svg", "image/svg+xml"},
                                  {"/prometheus", "text/plain"},
                                  {"/healthz", "application/json"}})
    if (pattern.ends_with(end)) return type;
  return "text/html";
}

Json operation(const Route& route) {
  Json json;
  json["summary"] = route.summary;
  if (!route.scope.empty()) json["description"] = "Scope: " + std::string(route.scope);
  Json roles = Json::array();
  for (const casedb::Role role : casedb::kAllRoles)
    if (route.who.roles.has(role)) roles.push_back(casedb::name_of(role));
  json["x-roles"] = roles;
  json["security"] = roles.empty() ? Json::array() : Json{{{"session", Json::array()}}};
  if (const std::size_t hole = route.pattern.find('{'); hole != route.pattern.npos) {
    const std::string name(route.pattern.substr(hole + 1, route.pattern.find('}') - hole - 1));
    json["parameters"] = Json{
        {{"name", name}, {"in", "path"}, {"required", true}, {"schema", {{"type", "string"}, {"format", "uuid"}}}}};
  }
  const bool is_change = route.method == "POST";
  if (is_change)
    json["requestBody"] = {{"required", true},
                           {"content", {{"application/x-www-form-urlencoded", Json::object()}}}};
  Json& responses = json["responses"];
  if (is_change)
    responses["303"] = {{"description", "Done; where to go on"}};
  else
    responses["200"] = {{"description", "As the summary says"},
                        {"content", {{content_of(route.pattern), Json::object()}}}};
  if (!roles.empty()) {
    if (route.is_page)
      responses["303"] = {{"description", is_change ? "Done, or nobody is logged in" : "Nobody is logged in"}};
    else
      responses["401"] = {{"description", "Nobody is logged in"}};
    responses["404"] = {{"description", "There is nothing here, or it is not the reader's to see"}};
  }
  return json;
}

}  // namespace

std::string openapi_json(std::span<const Route> routes, const std::string& program_version) {
  Json json;
  json["openapi"] = "3.1.0";
  json["info"] = {
      {"title", "Seldinger's dashboard"}, {"description", base::kTrainingOnly}, {"version", program_version}};
  json["paths"] = Json::object();
  for (const Route& route : routes)
    json["paths"][std::string(route.pattern)][route.method == "POST" ? "post" : "get"] = operation(route);
  json["components"]["securitySchemes"]["session"] = {
      {"type", "apiKey"}, {"in", "cookie"}, {"name", "seldinger_PORT"}};
  return json.dump(2) + "\n";
}

}  // namespace seldinger::web
