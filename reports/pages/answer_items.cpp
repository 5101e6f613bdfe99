#include "reports/pages/answer_items.h"

namespace seldinger::reports {
namespace {

namespace questionnaire = assessment::questionnaire;
using questionnaire::Item;
using questionnaire::ItemKind;

std::string whole_text(double value) {
  return std::to_string(static_cast<long long>(value));
}

void add_options(Html& html, const questionnaire::Form& form, const Item& item, const std::string& typed) {
  const std::string name = field_of(item);
  if (item.kind == ItemKind::choice)
    for (const std::string& one : item.choices) add_tick(html, name, one, "", one, typed == one, false);
  if (const questionnaire::Scale* scale = form.find_scale(item.scale))
    for (const questionnaire::ScalePoint& one : scale->points) {
      const std::string value = std::to_string(one.value);
      add_tick(html, name, value, value, one.label, typed == value, false);
    }
  if (item.not_applicable)
    add_tick(html, name, std::string(questionnaire::kNotApplicableWord), "", "Not applicable",
             typed == questionnaire::kNotApplicableWord, true);
  // A radio button cannot be cleared; this takes an answer back.
  add_tick(html, name, "", "", "No answer", false, true);
}

void add_number(Html& html, const Item& item, const std::string& typed) {
  const bool none = typed == questionnaire::kNotApplicableWord;
  html.raw("<p class=\"number-field\"><input id=\"").text(field_of(item)).raw("\" name=\"").text(field_of(item));
  html.raw("\" inputmode=\"").text(item.whole ? "numeric" : "decimal").raw("\" autocomplete=\"off\" value=\"");
  html.text(none ? "" : typed)
      .raw("\"> <span class=\"why\">")
      .text(item.unit)
      .raw("</span></p>\n<p class=\"why\">");
  html.text(item.whole ? "A whole number from " : "From ").text(whole_text(item.least)).raw(" to ");
  html.text(whole_text(item.most)).raw(".</p>\n");
  if (!item.not_applicable) return;
  html.raw("<label class=\"option quiet\"><input type=\"checkbox\" name=\"")
      .text(field_of(item))
      .raw("-none\" value=\"yes\"");
  if (none) html.raw(" checked");
  html.raw("> <span>Not applicable</span></label>\n");
}

}  // namespace

void add_tick(Html& html, const std::string& name, const std::string& value, std::string_view mark,
              std::string_view label, bool ticked, bool quiet) {
  if (quiet)
    html.raw("<label class=\"option quiet\">");
  else
    html.raw("<label class=\"option\">");
  html.raw("<input type=\"radio\" name=\"").text(name).raw("\" value=\"").text(value);
  if (ticked)
    html.raw("\" checked> ");
  else
    html.raw("\"> ");
  if (!mark.empty()) html.raw("<span class=\"mark-of\">").text(mark).raw("</span> ");
  html.raw("<span>").text(label).raw("</span></label>\n");
}

void add_problem(Html& html, std::string_view problem) {
  if (!problem.empty()) html.raw("<p class=\"problem\" role=\"alert\">").text(problem).raw("</p>\n");
}

std::string field_of(const Item& item) {
  return "item-" + item.id;
}

Html answer_item(const questionnaire::Form& form, const Item& item, const std::string& typed,
                 const std::string& problem) {
  Html html;
  if (item.kind == ItemKind::scale || item.kind == ItemKind::choice) {
    html.raw("<fieldset class=\"item\">\n<legend>").text(item.text).raw("</legend>\n");
    add_problem(html, problem);
    html.raw("<div class=\"options\">\n");
    add_options(html, form, item, typed);
    return html.raw("</div>\n</fieldset>\n");
  }
  html.raw("<div class=\"item\">\n<label for=\"").text(field_of(item)).raw("\">").text(item.text).raw("</label>\n");
  add_problem(html, problem);
  if (item.kind == ItemKind::number) {
    add_number(html, item, typed);
  } else {
    html.raw("<textarea id=\"").text(field_of(item)).raw("\" name=\"").text(field_of(item));
    html.raw("\" rows=\"4\" maxlength=\"").text(std::to_string(questionnaire::kMostCommentBytes / 4)).raw("\">\n");
    html.text(typed).raw("</textarea>\n<p class=\"why\">Please do not name patients or colleagues.</p>\n");
  }
  return html.raw("</div>\n");
}

Html kept_words(std::string_view without_script) {
  return Html{}
      .raw("<span data-kept=\"What you have typed so far is kept, should this page be closed.\" data-lost=\"")
      .raw("What you type is not kept right now.\" role=\"status\">")
      .text(without_script)
      .raw("</span>");
}

}  // namespace seldinger::reports
