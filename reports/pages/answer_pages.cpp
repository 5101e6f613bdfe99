#include "reports/pages/answer_pages.h"

#include <algorithm>

#include "reports/pages/page.h"

namespace seldinger::reports {
namespace {

namespace questionnaire = assessment::questionnaire;
using questionnaire::Item;
using questionnaire::ItemKind;

std::string whole_text(double value) {
  return std::to_string(static_cast<long long>(value));
}

void add_token(Html& html, std::string_view token) {
  html.raw("<input type=\"hidden\" name=\"token\" value=\"").text(token).raw("\">\n");
}

void add_problem(Html& html, std::string_view problem) {
  if (!problem.empty()) html.raw("<p class=\"problem\" role=\"alert\">").text(problem).raw("</p>\n");
}

// One thing to tick.
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
    add_tick(html, name, std::string(questionnaire::kNotApplicableWord), "", "Not applicable to me",
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
  html.raw("> <span>Not applicable to me</span></label>\n");
}

void add_item(Html& html, const AnswerSection& view, const Item& item) {
  const questionnaire::Form& form = view.draft->form.form;
  const auto kept = view.draft->set.answers.find(item.id);
  std::string typed = kept == view.draft->set.answers.end() ? "" : questionnaire::text_of(item, kept->second);
  if (const auto refused = view.typed.find(item.id); refused != view.typed.end()) typed = refused->second;
  const auto problem = view.problems.find(item.id);
  if (item.kind == ItemKind::scale || item.kind == ItemKind::choice) {
    html.raw("<fieldset class=\"item\">\n<legend>").text(item.text).raw("</legend>\n");
    if (problem != view.problems.end()) add_problem(html, problem->second);
    html.raw("<div class=\"options\">\n");
    add_options(html, form, item, typed);
    html.raw("</div>\n</fieldset>\n");
    return;
  }
  html.raw("<div class=\"item\">\n<label for=\"").text(field_of(item)).raw("\">").text(item.text).raw("</label>\n");
  if (problem != view.problems.end()) add_problem(html, problem->second);
  if (item.kind == ItemKind::number) {
    add_number(html, item, typed);
  } else {
    html.raw("<textarea id=\"").text(field_of(item)).raw("\" name=\"").text(field_of(item));
    html.raw("\" rows=\"4\" maxlength=\"").text(std::to_string(questionnaire::kMostCommentBytes / 4)).raw("\">\n");
    html.text(typed).raw("</textarea>\n<p class=\"why\">Please name no patient and no colleague.</p>\n");
  }
  html.raw("</div>\n");
}

// What is there and what is not, before it is sent.
void add_last_look(Html& html, const AnswerSection& view) {
  const questionnaire::Form& form = view.draft->form.form;
  const auto sections = sections_of(form);
  Html open;
  std::size_t missing = 0;
  for (std::size_t i = 0; i < sections.size(); ++i)
    for (const Item* item : sections[i]) {
      const auto found = view.draft->set.answers.find(item->id);
      const bool there =
          found != view.draft->set.answers.end() && found->second.state != questionnaire::AnswerState::missing;
      if (there || item->kind == ItemKind::comment) continue;
      ++missing;
      open.raw("<li><a href=\"/answer/form?section=").text(std::to_string(i + 1)).raw("\">").text(item->text);
      open.raw("</a></li>\n");
    }
  if (missing == 0) {
    html.raw("<p class=\"note\">Every question has an answer.</p>\n");
  } else {
    html.raw("<p>Not answered, which you may leave so:</p>\n<ul class=\"open-items\">\n").add(open).raw("</ul>\n");
  }
  html.raw("<p>Once sent, your answers cannot be changed.</p>\n");
}

}  // namespace

std::string field_of(const Item& item) {
  return "item-" + item.id;
}

std::vector<std::vector<const Item*>> sections_of(const questionnaire::Form& form) {
  std::vector<std::vector<const Item*>> sections;
  for (const Item& item : form.items) {
    if (sections.empty() || sections.back().back()->section != item.section) sections.emplace_back();
    sections.back().push_back(&item);
  }
  return sections;
}

std::string answer_start_page(const AnswerStart& start) {
  Html html;
  html.raw("<div class=\"answering\">\n<h1>Answer a questionnaire</h1>\n");
  add_problem(html, start.problem);
  if (start.begun)
    html.raw(
        "<p class=\"note\">Answers were begun on this device and not sent. <a href=\"/answer/form\">Go on with "
        "them</a>, or begin anew below.</p>\n");
  html.raw("<form method=\"post\" action=\"/answer\">\n");
  add_token(html, start.token);
  html.raw(
      "<p><label for=\"code\">Code</label>\n<input id=\"code\" name=\"code\" autocomplete=\"off\" "
      "autocapitalize=\"characters\" maxlength=\"8\" required></p>\n<p class=\"why\">Six letters and digits, as "
      "they "
      "were told to you.</p>\n<p><button>Next</button></p>\n</form>\n</div>\n");
  return page("Answer a questionnaire", {}, html);
}

std::string answer_who_page(const AnswerWho& who) {
  const questionnaire::Form& form = who.forms.front().form;
  Html html;
  html.raw("<div class=\"answering\">\n<p class=\"sub\">").text(who.round.title).raw("</p>\n<h1>").text(form.title);
  html.raw("</h1>\n");
  add_problem(html, who.problem);
  if (!form.introduction.empty()) html.raw("<p>").text(form.introduction).raw("</p>\n");
  html.raw(
      "<p class=\"note\">Taking part is voluntary, and you may leave any question open. Your name is not asked; "
      "whoever opened this questionnaire reads the answers by code and group.</p>\n"
      "<form method=\"post\" action=\"/answer\">\n");
  add_token(html, who.token);
  html.raw("<input type=\"hidden\" name=\"code\" value=\"").text(who.round.code).raw("\">\n");
  if (!who.round.groups.empty()) {
    html.raw("<fieldset class=\"item\">\n<legend>You are here as</legend>\n<div class=\"options\">\n");
    for (const std::string& one : who.round.groups)
      add_tick(html, "group", one, "", one, who.typed.group == one, false);
    html.raw("</div>\n</fieldset>\n");
  }
  if (who.forms.size() > 1) {
    html.raw("<fieldset class=\"item\">\n<legend>Language</legend>\n<div class=\"options\">\n");
    for (const casedb::StoredForm& one : who.forms)
      add_tick(html, "language", one.form.language, one.form.language, one.form.title,
               one.form.language == (who.typed.language.empty() ? form.language : who.typed.language), false);
    html.raw("</div>\n</fieldset>\n");
  }
  html.raw(
      "<div class=\"item\"><label for=\"respondent\">Your participant code, if you were given one</label>\n"
      "<input id=\"respondent\" name=\"respondent\" autocomplete=\"off\" maxlength=\"16\" value=\"");
  html.text(who.typed.code)
      .raw("\"></div>\n<p><button name=\"begin\" value=\"yes\">Begin</button></p>\n</form>\n</div>\n");
  return page(form.title, {}, html);
}

std::string answer_section_page(const AnswerSection& view) {
  const questionnaire::Form& form = view.draft->form.form;
  const auto sections = sections_of(form);
  const bool last = view.section >= sections.size();
  Html html;
  html.raw("<div class=\"answering\">\n<p class=\"sub\">").text(form.title).raw(" · ");
  if (last)
    html.raw("last look");
  else
    html.text(std::to_string(view.section + 1)).raw(" of ").text(std::to_string(sections.size()));
  html.raw("</p>\n<progress max=\"").text(std::to_string(sections.size())).raw("\" value=\"");
  html.text(std::to_string(view.section)).raw("\">").text(std::to_string(view.section)).raw("</progress>\n<h1>");
  if (last)
    html.raw("Ready to send?");
  else
    html.text(sections[view.section].front()->section.empty() ? form.title
                                                              : sections[view.section].front()->section);
  html.raw("</h1>\n<form method=\"post\" action=\"/answer/form\">\n");
  add_token(html, view.token);
  html.raw("<input type=\"hidden\" name=\"section\" value=\"").text(std::to_string(view.section + 1)).raw("\">\n");
  if (last)
    add_last_look(html, view);
  else
    for (const Item* item : sections[view.section]) add_item(html, view, *item);
  html.raw("<p class=\"steps\">");
  // The first button of a form is what Enter presses.
  if (last)
    html.raw("<button name=\"go\" value=\"send\">Send</button>");
  else
    html.raw("<button name=\"go\" value=\"next\">Next</button>");
  if (view.section > 0) html.raw(" <button class=\"quiet\" name=\"go\" value=\"back\">Back</button>");
  html.raw("</p>\n</form>\n<p class=\"why\">Your participant code: <strong>").text(view.draft->set.respondent);
  html.raw("</strong>. What you send with Next is kept, should this page be closed.</p>\n</div>\n");
  return page(form.title, {}, html);
}

std::string answer_thanks_page() {
  Html html;
  html.raw(
      "<div class=\"message\">\n<h1>Thank you</h1>\n<p>Your answers are kept.</p>\n"
      "<p><a href=\"/answer\">Next person</a></p>\n</div>\n");
  return page("Thank you", {}, html);
}

}  // namespace seldinger::reports
