#include "assessment/json/object_reader_json.h"

namespace seldinger::assessment {

std::optional<Json> object_in(const std::string& text, const char* code, std::vector<base::Problem>& wrong) {
  std::vector<std::set<std::string>> keys;  // of the objects that are open
  bool twice = false;
  Json json = Json::parse(
      text,
      [&](int, Json::parse_event_t event, Json& parsed) {
        if (event == Json::parse_event_t::object_start) keys.emplace_back();
        if (event == Json::parse_event_t::object_end && !keys.empty()) keys.pop_back();
        if (event == Json::parse_event_t::key && !keys.empty())
          twice = twice || !keys.back().insert(parsed.get<std::string>()).second;
        return true;
      },
      false);
  if (!json.is_object()) {
    wrong.push_back({code, "the file holds no JSON object"});
    return std::nullopt;
  }
  if (twice) wrong.push_back({code, "an object names a field twice"});
  return json;
}

ObjectReader::ObjectReader(const Json& json, std::string where, std::vector<base::Problem>& wrong, const char* code,
                           const char* whole)
    : json_(json), where_(std::move(where)), wrong_(wrong), code_(code), whole_(whole) {
  if (!json_.is_object()) bad("", "must be an object");
}

ObjectReader::~ObjectReader() {
  if (!json_.is_object()) return;
  std::size_t unknown = 0;
  for (const auto& [key, value] : json_.items()) unknown += asked_.contains(key) ? 0U : 1U;
  if (unknown > 0) bad("", "holds " + std::to_string(unknown) + " fields that " + whole_ + " does not know");
}

void ObjectReader::bad(const std::string& field, const std::string& what) {
  const std::string place = where_.empty() ? field : field.empty() ? where_ : where_ + "." + field;
  wrong_.push_back({code_, (place.empty() ? std::string(whole_) : place) + " " + what});
}

bool ObjectReader::has(const char* field) {
  asked_.insert(field);
  return json_.is_object() && json_.contains(field);
}

std::vector<std::pair<const Json*, std::string>> ObjectReader::list(const char* field, std::size_t least,
                                                                    std::size_t most) {
  std::vector<std::pair<const Json*, std::string>> elements;
  if (!has(field)) {
    if (least > 0) bad(field, "is missing");
    return elements;
  }
  const Json& value = json_.at(field);
  if (!value.is_array() || value.size() < least || value.size() > most) {
    bad(field, "must be a list of " + std::to_string(least) + " to " + std::to_string(most));
    return elements;
  }
  const std::string place = where_.empty() ? std::string(field) : where_ + "." + field;
  for (std::size_t i = 0; i < value.size(); ++i)
    elements.emplace_back(&value[i], place + "[" + std::to_string(i) + "]");
  return elements;
}

}  // namespace seldinger::assessment
