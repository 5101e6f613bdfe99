#include <cmath>

#include "assessment/json/object_reader_json.h"
#include "assessment/questionnaire/form.h"

namespace seldinger::assessment::questionnaire {
namespace {

constexpr std::size_t kMostWords = 2'000, kMostId = 24, kMostItems = 100, kMostPoints = 11;
constexpr int kMostVersion = 1'000'000;
constexpr double kFarthest = 1e6;

class FormReader : public ObjectReader {
 public:
  FormReader(const Json& json, std::string where, std::vector<base::Problem>& wrong)
      : ObjectReader(json, std::move(where), wrong, "bad_form", "the form") {}

  std::string words(const char* field, bool needed) {
    if (!has(field)) {
      if (needed) bad(field, "is missing");
      return {};
    }
    const Json& value = json_.at(field);
    const std::string text = value.is_string() ? value.get<std::string>() : std::string();
    if (!value.is_string() || text.size() > kMostWords ||
        (needed && text.find_first_not_of(" \n\t") == std::string::npos) ||
        std::any_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; }))
      bad(field, "must be one line of 1 to " + std::to_string(kMostWords) + " bytes of text");
    return text;
  }
  // Small letters, digits and dashes: it stands in file names, addresses and columns.
  std::string id(const char* field, bool upper = false) {
    const std::string text = words(field, true);
    const auto fits = [&](char c) {
      return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' || (upper && c >= 'A' && c <= 'Z');
    };
    if (!text.empty() && (text.size() > kMostId || !std::all_of(text.begin(), text.end(), fits)))
      bad(field, "must be an id: up to " + std::to_string(kMostId) + " letters, digits and dashes");
    return text;
  }
  double number(const char* field, double least, double most) {
    const double value = has(field) && json_.at(field).is_number() ? json_.at(field).get<double>() : std::nan("");
    if (value >= least && value <= most) return value;
    bad(field, "is missing, or not a number in its range");
    return least;
  }
  int whole(const char* field, int least, int most) {
    const double value = number(field, least, most);
    if (value != std::floor(value)) bad(field, "must be a whole number");
    return static_cast<int>(value);
  }
  bool flag(const char* field) {
    if (!has(field)) return false;
    if (!json_.at(field).is_boolean()) bad(field, "must be true or false");
    return json_.at(field).is_boolean() && json_.at(field).get<bool>();
  }
  std::vector<std::string> lines(const char* field, std::size_t least, std::size_t most) {
    std::vector<std::string> all;
    for (const auto& [json, place] : list(field, least, most)) {
      const std::string text = json->is_string() ? json->get<std::string>() : std::string();
      if (text.empty() || text.size() > kMostWords)
        wrong_.push_back(
            {"bad_form", place + " must be one line of 1 to " + std::to_string(kMostWords) + " bytes of text"});
      all.push_back(text);
    }
    return all;
  }
};

Scale read_scale(const Json& json, const std::string& where, std::vector<base::Problem>& wrong) {
  FormReader reader(json, where, wrong);
  Scale scale;
  scale.id = reader.id("id");
  std::size_t positions = 0;
  for (const auto& [one, place] : reader.list("points", 2, kMostPoints)) {
    FormReader point(*one, place, wrong);
    scale.points.push_back(
        {point.whole("value", -100, 100), point.words("label", false), point.flag("no_opinion")});
    positions += scale.points.back().no_opinion ? 0U : 1U;
    if (scale.points.size() > 1 && scale.points.back().value != scale.points[scale.points.size() - 2].value + 1)
      point.bad("value", "does not follow the value before it");
  }
  if (scale.points.empty()) return scale;
  if (positions < 2) reader.bad("points", "are fewer than two positions");
  if (scale.points.front().label.empty() || scale.points.back().label.empty())
    reader.bad("points", "have no words at both ends");
  return scale;
}

void read_kind(FormReader& reader, const Form& form, Item& item) {
  const std::string kind = reader.words("kind", true);
  const auto found = base::from_name(kItemKindNames, kind);
  if (!found) reader.bad("kind", "must be one of: scale, choice, number, comment");
  item.kind = found.value_or(ItemKind::comment);
  const bool is_scale = item.kind == ItemKind::scale;
  if (is_scale) {
    item.scale = reader.id("scale");
    if (!item.scale.empty() && form.find_scale(item.scale) == nullptr)
      reader.bad("scale", "is not a scale of the form");
  }
  if (item.kind == ItemKind::choice) {
    item.choices = reader.lines("choices", 2, 20);
    for (const std::string& one : item.choices)
      if (one == kNotApplicableWord || one.front() == ' ' || one.back() == ' ')
        reader.bad("choices", "hold a word that cannot be typed: n/a, or blanks at an end");
    if (std::set<std::string>(item.choices.begin(), item.choices.end()).size() != item.choices.size())
      reader.bad("choices", "name one twice");
  }
  if (item.kind == ItemKind::number) {
    item.least = reader.number("least", -kFarthest, kFarthest);
    item.most = reader.number("most", -kFarthest, kFarthest);
    if (!(item.least < item.most)) reader.bad("most", "is not more than least");
    item.whole = reader.flag("whole");
    item.unit = reader.words("unit", false);
  }
  item.reverse = reader.flag("reverse");
  item.not_applicable = reader.flag("not_applicable");
  if (item.reverse && !is_scale) reader.bad("reverse", "is for items on a scale only");
  if (item.not_applicable && item.kind == ItemKind::comment) reader.bad("not_applicable", "is not for comments");
}

void read_form(const Json& json, Form& form, std::vector<base::Problem>& wrong) {
  FormReader reader(json, "", wrong);
  form.id = reader.id("id");
  form.version = reader.whole("version", 1, kMostVersion);
  form.language = reader.id("language", true);
  form.title = reader.words("title", true);
  form.introduction = reader.words("introduction", false);
  form.source = reader.words("source", false);
  form.corrections = reader.lines("corrections", 0, 20);
  for (const auto& [one, place] : reader.list("scales", 0, 20)) {
    Scale scale = read_scale(*one, place, wrong);
    if (!scale.id.empty() && form.find_scale(scale.id) != nullptr)
      wrong.push_back({"bad_form", place + ".id is also another scale's"});
    form.scales.push_back(std::move(scale));
  }
  for (const auto& [one, place] : reader.list("items", 1, kMostItems)) {
    FormReader read(*one, place, wrong);
    Item item;
    item.id = read.id("id");
    if (!item.id.empty() && form.find_item(item.id) != nullptr) read.bad("id", "is also another item's");
    item.section = read.words("section", false);
    item.text = read.words("text", true);
    for (const Item& other : form.items)
      if (!item.text.empty() && other.text == item.text && other.section == item.section)
        read.bad("text", "says the same as item " + other.id);
    read_kind(read, form, item);
    form.items.push_back(std::move(item));
  }
}

Json shortest(double value) {
  if (value == std::floor(value)) return static_cast<std::int64_t>(value);
  return value;
}

Json json_of(const Scale& scale, bool words) {
  Json points = Json::array();
  for (const ScalePoint& one : scale.points) {
    Json point = {{"value", one.value}};
    if (words && !one.label.empty()) point["label"] = one.label;
    if (one.no_opinion) point["no_opinion"] = true;
    points.push_back(std::move(point));
  }
  return {{"id", scale.id}, {"points", points}};
}

Json json_of(const Item& item, bool words) {
  Json json = {{"id", item.id}, {"kind", base::name_of(kItemKindNames, item.kind)}};
  if (words) json["text"] = item.text;
  if (words && !item.section.empty()) json["section"] = item.section;
  if (item.kind == ItemKind::scale) json["scale"] = item.scale;
  if (item.kind == ItemKind::choice) json["choices"] = words ? Json(item.choices) : Json(item.choices.size());
  if (item.kind == ItemKind::number) {
    json["least"] = shortest(item.least);
    json["most"] = shortest(item.most);
    if (words && !item.unit.empty()) json["unit"] = item.unit;
  }
  for (const auto& [field, set] :
       {std::pair{"whole", item.whole}, {"reverse", item.reverse}, {"not_applicable", item.not_applicable}})
    if (set) json[field] = true;
  return json;
}

Json json_of(const Form& form, bool words) {
  Json json = {{"id", form.id}, {"version", form.version}};
  if (words) {
    json["language"] = form.language;
    json["title"] = form.title;
    for (const auto& [field, text] : {std::pair{"introduction", &form.introduction}, {"source", &form.source}})
      if (!text->empty()) json[field] = *text;
    if (!form.corrections.empty()) json["corrections"] = form.corrections;
  }
  json["scales"] = json["items"] = Json::array();
  for (const Scale& one : form.scales) json["scales"].push_back(json_of(one, words));
  for (const Item& one : form.items) json["items"].push_back(json_of(one, words));
  return json;
}

std::string text_of_json(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

base::Result<Form> form_from_json(const std::string& text) {
  base::Error error{"bad_form", "the questionnaire is not as it should be"};
  const auto json = object_in(text, "bad_form", error.findings);
  if (!json) return error;
  Form form;
  read_form(*json, form, error.findings);
  if (!error.findings.empty()) return error;
  return form;
}

std::string canonical_json(const Form& form) {
  return text_of_json(json_of(form, true));
}

std::string structure_of(const Form& form) {
  return text_of_json(json_of(form, false));
}

}  // namespace seldinger::assessment::questionnaire
