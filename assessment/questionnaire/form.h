// A questionnaire as data: its items, the scales they are answered on, and what an answer may be. A form is known
// by its id, version and language; one of another version is another form, and answers to both are never pooled.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/base/names.h"
#include "sim/base/result.h"

namespace seldinger::assessment::questionnaire {

struct ScalePoint {
  int value = 0;
  std::string label;  // may be empty between labelled points
  // "Don't know" among the points of a scale: it can be ticked, and is no position on the scale.
  bool no_opinion = false;
};

struct Scale {
  std::string id;
  std::vector<ScalePoint> points;  // by value, without gaps
  int low() const { return points.front().value; }
  int high() const { return points.back().value; }
};

enum class ItemKind { scale, choice, number, comment };
inline constexpr auto kItemKindNames = base::names<ItemKind>({{ItemKind::scale, "scale"},
                                                              {ItemKind::choice, "choice"},
                                                              {ItemKind::number, "number"},
                                                              {ItemKind::comment, "comment"}});

struct Item {
  std::string id;       // "8a"; the same in every language
  std::string section;  // heading under which it stands; empty: none
  std::string text;
  ItemKind kind = ItemKind::scale;
  std::string scale;            // id of its scale, of ItemKind::scale
  bool reverse = false;         // agreement speaks against what the questionnaire measures
  bool not_applicable = false;  // "not applicable" may be ticked: not the same as no answer
  std::vector<std::string> choices;
  double least = 0.0, most = 0.0;  // of ItemKind::number
  bool whole = false;
  std::string unit;
};

struct Form {
  std::string id, language, title, introduction;
  int version = 1;
  std::string source;                    // where its wording is published
  std::vector<std::string> corrections;  // what differs from there, and why
  std::vector<Scale> scales;
  std::vector<Item> items;

  const Scale* find_scale(std::string_view scale_id) const noexcept;
  const Item* find_item(std::string_view item_id) const noexcept;
};

// `bad_form`, with every place that is wrong.
base::Result<Form> form_from_json(const std::string& text);
// The same form is the same text, whatever the order of fields and blanks in the file it came from.
std::string canonical_json(const Form& form);
// Which items are answered together: those of one heading that follow each other. At least one.
std::vector<std::vector<const Item*>> sections_of(const Form& form);
// What does not depend on the language: items, kinds, scales, limits. Translations of one version have the same.
std::string structure_of(const Form& form);

// Not answered, ticked as not applicable, and answered are three things; a comment is a fourth.
enum class AnswerState { missing, not_applicable, answered };
inline constexpr auto kAnswerStateNames = base::names<AnswerState>({{AnswerState::missing, "missing"},
                                                                    {AnswerState::not_applicable, "not_applicable"},
                                                                    {AnswerState::answered, "answered"}});

struct ItemAnswer {
  AnswerState state = AnswerState::missing;
  std::optional<double> value;  // of a scale or a number, and of a choice its place, from 1
  std::string text;             // of a comment
  bool operator==(const ItemAnswer&) const = default;
};

inline constexpr std::string_view kNotApplicableWord = "n/a";  // as it is typed and as a page sends it
inline constexpr std::size_t kMostCommentBytes = 2'000;

// What was typed or ticked for an item; nothing is missing. `bad_answer`, in words that go on from the item's name:
// "takes a whole number from 0 to 70".
base::Result<ItemAnswer> answer_from_text(const Form& form, const Item& item, std::string_view typed);
// Without needless digits: "4", "7.5".
std::string number_text(double value);
// As answer_from_text reads it again: "", "n/a", "4", a choice's word, a comment.
std::string text_of(const Item& item, const ItemAnswer& answer);

// The value as it counts: of a reverse item mirrored on its scale; none where there is no position on a scale.
std::optional<double> scored(const Form& form, const Item& item, const ItemAnswer& answer);
// Whether it can be summed up: it has items on scales, all from the same lowest to the same highest value.
bool has_one_measure(const Form& form);
// The mean of what counts among the items on scales; what is not applicable is left out. None where one is missing,
// where nothing counts, and of a form without one measure.
std::optional<double> mean_score(const Form& form, const std::map<std::string, ItemAnswer>& answers);
// The words of a scale's point or of a choice; empty where it has none.
std::string label_of(const Form& form, const Item& item, const ItemAnswer& answer);

}  // namespace seldinger::assessment::questionnaire
