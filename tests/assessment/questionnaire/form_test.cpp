// Questionnaires: what is a form and what is none, and that an answer is read as it was given, with missing, not
// applicable and "don't know" apart.
#include "assessment/questionnaire/form.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "assessment/questionnaire/shipped_forms.h"

namespace seldinger::assessment::questionnaire {
namespace {

using Json = nlohmann::json;

Json sample() {
  return Json::parse(R"({"id": "after", "version": 2, "language": "en", "title": "After the attempt",
    "scales": [{"id": "agree", "points": [{"value": 1, "label": "no"}, {"value": 2}, {"value": 3, "label": "don't know",
      "no_opinion": true}, {"value": 4}, {"value": 5, "label": "yes"}]}],
    "items": [{"id": "1", "text": "It felt real", "kind": "scale", "scale": "agree", "not_applicable": true},
      {"id": "2", "text": "It felt wrong", "kind": "scale", "scale": "agree", "reverse": true},
      {"id": "3", "text": "Your post", "kind": "choice", "choices": ["registrar", "consultant"]},
      {"id": "4", "text": "Your years", "kind": "number", "least": 0, "most": 70},
      {"id": "5", "text": "Punctures", "kind": "number", "least": 0, "most": 500, "whole": true, "unit": "punctures"},
      {"id": "6", "text": "Anything else?", "kind": "comment"}]})");
}
Form form_of(const Json& json) {
  auto form = form_from_json(json.dump());
  EXPECT_TRUE(form.has_value()) << (form ? "" : form.error().findings.at(0).text);
  return form ? *form : Form{};
}

TEST(Form, IsTheSameWhateverTheOrderOfItsFields) {
  const Form form = form_of(sample());
  const std::string canonical = canonical_json(form);
  EXPECT_EQ(canonical, canonical_json(form_of(Json::parse(canonical))));
  EXPECT_EQ(canonical, canonical_json(form_of(Json::parse(sample().dump(4)))));
  Json other = sample();
  other["items"][0]["text"] = "It felt true";
  EXPECT_NE(canonical, canonical_json(form_of(other)));
}

TEST(Form, HasOneStructureInEveryLanguage) {
  Json french = sample();
  french["language"] = "fr";
  french["title"] = "Après l'essai";
  french["items"][0]["text"] = "C'était réaliste";
  french["items"][2]["choices"] = {"interne", "praticien"};
  french["scales"][0]["points"][0]["label"] = "non";
  EXPECT_EQ(structure_of(form_of(sample())), structure_of(form_of(french)));
  for (const auto& [pointer, value] : {std::pair<const char*, Json>{"/items/1/reverse", false},
                                       {"/items/3/most", 60},
                                       {"/items/0/id", "1a"},
                                       {"/items/0/not_applicable", false},
                                       {"/scales/0/points/2/no_opinion", false},
                                       {"/version", 3}}) {
    Json other = french;
    other[Json::json_pointer(pointer)] = value;
    EXPECT_NE(structure_of(form_of(sample())), structure_of(form_of(other))) << pointer;
  }
}

TEST(Form, IsRefusedWithThePlaceThatIsWrong) {
  const std::vector<std::tuple<const char*, Json, const char*>> wrong = {
      {"/id", "After 1", "id"},
      {"/version", 0, "version"},
      {"/version", 1.5, "version"},
      {"/language", "", "language"},
      {"/title", " ", "title"},
      {"/title", 7, "title"},
      {"/colour", "red", "1 fields"},
      {"/items", Json::array(), "items"},
      {"/items", "all", "items"},
      {"/items/0", 4, "items[0]"},
      {"/items/0/kind", "slider", "items[0].kind"},
      {"/items/0/scale", "none", "items[0].scale"},
      {"/items/1/id", "1", "items[1].id"},
      {"/items/1/text", "It felt real", "items[1].text"},
      {"/items/2/choices", Json::array({"one"}), "items[2].choices"},
      {"/items/2/choices", Json::array({"one", "one"}), "items[2].choices"},
      {"/items/2/choices", Json::array({"one", "n/a"}), "items[2].choices"},
      {"/items/3/most", -1, "items[3].most"},
      {"/items/3/most", Json::parse("1e9"), "items[3].most"},
      {"/items/3/reverse", true, "items[3].reverse"},
      {"/items/5/not_applicable", true, "items[5].not_applicable"},
      {"/items/5/text", "a\nb", "items[5].text"},
      {"/items/0/not_applicable", "yes", "items[0].not_applicable"},
      {"/scales/0/points/1/value", 3, "scales[0].points[1].value"},
      {"/scales/0/points/4/label", "", "scales[0].points"},
      {"/scales/0/points", Json::array({{{"value", 1}, {"label", "a"}}}), "scales[0].points"}};
  for (const auto& [pointer, value, place] : wrong) {
    Json json = sample();
    json[Json::json_pointer(pointer)] = value;
    const auto form = form_from_json(json.dump());
    ASSERT_FALSE(form.has_value()) << pointer << " " << value;
    EXPECT_EQ(form.error().code, "bad_form");
    bool told = false;
    for (const base::Problem& one : form.error().findings) told = told || one.text.find(place) != std::string::npos;
    EXPECT_TRUE(told) << pointer << " " << value << ": " << form.error().findings.at(0).text;
  }
  for (const char* text : {"", "[]", "{", "{\"id\": \"a\", \"id\": \"b\"}", "null", "[[[[[["})
    EXPECT_FALSE(form_from_json(text).has_value()) << text;
  Json twice = sample();
  twice["scales"].push_back(twice["scales"][0]);
  EXPECT_FALSE(form_from_json(twice.dump()).has_value());
}

TEST(Form, KeepsMissingNotApplicableAndAnswersApart) {
  const Form form = form_of(sample());
  const auto read = [&](const char* item, const char* typed) {
    return answer_from_text(form, *form.find_item(item), typed);
  };
  EXPECT_EQ(read("1", "")->state, AnswerState::missing);
  EXPECT_EQ(read("1", "  ")->state, AnswerState::missing);
  EXPECT_EQ(read("1", "n/a")->state, AnswerState::not_applicable);
  EXPECT_EQ(read("1", " 4 ")->value, 4.0);
  EXPECT_EQ(read("3", "consultant")->value, 2.0);
  EXPECT_EQ(read("4", "7,5")->value, 7.5) << "as paper is typed in France";
  EXPECT_EQ(read("6", "n/a")->text, "n/a") << "a comment is what was written";
  EXPECT_EQ(read("6", "two\r\nlines")->text, "two\nlines");
  for (const auto& [item, typed] : {std::pair{"1", "0"},
                                    {"1", "6"},
                                    {"1", "2.5"},
                                    {"1", "yes"},
                                    {"1", "nan"},
                                    {"1", "1e0"},
                                    {"1", "4 5"},
                                    {"2", "n/a"},
                                    {"3", "nurse"},
                                    {"3", "1"},
                                    {"4", "-1"},
                                    {"4", "71"},
                                    {"4", "inf"},
                                    {"4", "0x1"},
                                    {"5", "2.5"},
                                    {"6", "a\x01"}})
    EXPECT_FALSE(read(item, typed).has_value()) << item << " " << typed;
  EXPECT_FALSE(read("6", std::string(kMostCommentBytes + 1, 'a').c_str()).has_value());
  for (const Item& item : form.items)
    for (const char* typed : {"", "n/a", "1", "4", "5", "registrar", "7.5", "-0", "words, \"quoted\"\nlines"}) {
      const auto once = answer_from_text(form, item, typed);
      if (!once) continue;
      const auto again = answer_from_text(form, item, text_of(item, *once));
      ASSERT_TRUE(again.has_value()) << item.id << " " << typed;
      EXPECT_EQ(*again, *once) << item.id << " " << typed;
    }
}

TEST(Form, ScoresReverseItemsMirroredAndNoOpinionNotAtAll) {
  const Form form = form_of(sample());
  const auto score = [&](const char* item, const char* typed) {
    const Item& of = *form.find_item(item);
    return scored(form, of, answer_from_text(form, of, typed).value());
  };
  EXPECT_EQ(score("1", "5"), 5.0);
  EXPECT_EQ(score("2", "5"), 1.0);
  EXPECT_EQ(score("2", "2"), 4.0);
  EXPECT_EQ(score("1", "3"), std::nullopt) << "\"don't know\" is no midpoint";
  EXPECT_EQ(score("1", "n/a"), std::nullopt);
  EXPECT_EQ(score("1", ""), std::nullopt);
  EXPECT_EQ(score("3", "consultant"), std::nullopt);
  EXPECT_EQ(score("4", "12"), 12.0);
}

// Appendix C of the thesis, as far as it is words that can be counted.
TEST(ShippedForms, AreThoseOfTheThreeWorkshops) {
  ASSERT_EQ(shipped_forms().size(), 5U) << "and two for raters";
  const Form& first = find_shipped_form("workshop-2005")->form;
  EXPECT_EQ(first.items.size(), 6U);
  EXPECT_EQ(first.scales.at(0).points.size(), 7U);
  EXPECT_TRUE(first.scales[0].points[3].no_opinion);
  EXPECT_EQ(first.scales[0].points[3].label, "Don't know");
  for (const char* id : {"workshop-2006", "workshop-2007"}) {
    const Form& form = find_shipped_form(id)->form;
    EXPECT_EQ(form.items.size(), 17U) << "1 to 5, 6a, 6b, 7, 8a to 8h, 9";
    EXPECT_EQ(form.find_scale("confidence-10")->points.size(), 10U);
    EXPECT_EQ(form.find_item("8d")->text, "Needle insertion through tissues is realistic");
    EXPECT_FALSE(form.corrections.empty());
  }
  EXPECT_EQ(find_shipped_form("workshop-2006")->form.find_item("8a")->text,
            "CT visual elements were of high quality");
  EXPECT_EQ(find_shipped_form("workshop-2007")->form.find_item("8a")->text,
            "US visual elements were of high quality");
  EXPECT_EQ(find_shipped_form("workshop-2008"), nullptr);
}

TEST(ShippedForms, OfRatersHaveOneMeasure) {
  for (const ShippedForm& one : shipped_forms())
    EXPECT_EQ(has_one_measure(one.form),
              one.form.id == "osats-grs" || one.form.id == "needle-checklist" || one.form.id == "workshop-2005")
        << one.form.id;
  const Form& grs = find_shipped_form("osats-grs")->form;
  std::map<std::string, ItemAnswer> answers;
  for (const Item& item : grs.items) answers[item.id] = *answer_from_text(grs, item, "4");
  EXPECT_EQ(mean_score(grs, answers), 4.0) << "a comment has no part in it";
  answers["flow"] = *answer_from_text(grs, *grs.find_item("flow"), "1");
  answers["time"] = *answer_from_text(grs, *grs.find_item("time"), "n/a");
  EXPECT_DOUBLE_EQ(mean_score(grs, answers).value(), (4 * 4 + 1) / 5.0);
  answers["flow"] = {};
  EXPECT_EQ(mean_score(grs, answers), std::nullopt);
}

}  // namespace
}  // namespace seldinger::assessment::questionnaire
