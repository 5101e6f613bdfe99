// Reading a file that somebody wrote by hand, as studies' plans and questionnaires are: every wrong place is noted
// and named, and so is what nobody asked for.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "sim/base/result.h"

namespace seldinger::assessment {

using Json = nlohmann::json;  // its objects are in the order of their keys

// The file's object; nothing where it holds none, and `code` with what is wrong of the text itself.
std::optional<Json> object_in(const std::string& text, const char* code, std::vector<base::Problem>& wrong);

// The fields of one object. What they may be is for who derives from it.
class ObjectReader {
 public:
  // `whole` stands for the object that has no place: "the plan". `json` and `wrong` outlive the reader.
  ObjectReader(const Json& json, std::string where, std::vector<base::Problem>& wrong, const char* code,
               const char* whole);
  ObjectReader(const ObjectReader&) = delete;
  ObjectReader& operator=(const ObjectReader&) = delete;
  ~ObjectReader();  // notes fields that nobody asked for

  void bad(const std::string& field, const std::string& what);
  bool has(const char* field);
  // The list's elements with their places; nothing where it is none.
  std::vector<std::pair<const Json*, std::string>> list(const char* field, std::size_t least, std::size_t most);

 protected:
  const Json& json_;
  std::string where_;
  std::vector<base::Problem>& wrong_;

 private:
  const char *code_, *whole_;
  std::set<std::string> asked_;
};

}  // namespace seldinger::assessment
