#include "reports/pages/answer_pages.h"

#include <algorithm>

#include "reports/pages/answer_items.h"
#include "reports/pages/page.h"

namespace seldinger::reports {
namespace {

namespace questionnaire = assessment::questionnaire;
using questionnaire::Item;
using questionnaire::ItemKind;

// As it was refused, else as it is kept.
std::string typed_of(const AnswerSection& view, const Item& item) {
  if (const auto refused = view.typed.find(item.id); refused != view.typed.end()) return refused->second;
  const auto kept = view.draft->set.answers.find(item.id);
  return kept == view.draft->set.answers.end() ? std::string() : questionnaire::text_of(item, kept->second);
}

void add_token(Html& html, std::string_view token) {
  html.raw("<input type=\"hidden\" name=\"token\" value=\"").text(token).raw("\">\n");
}

// What is there and what is not, before it is sent.
void add_last_look(Html& html, const AnswerSection& view) {
  const questionnaire::Form& form = view.draft->form.form;
  const auto sections = questionnaire::sections_of(form);
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
    html.raw("<p>Not answered; you may leave these blank:</p>\n<ul class=\"open-items\">\n")
        .add(open)
        .raw("</ul>\n");
  }
  html.raw("<p>Once sent, your answers cannot be changed.</p>\n");
}

}  // namespace

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
      "given to you.</p>\n<p><button>Next</button></p>\n</form>\n</div>\n");
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
  const auto sections = questionnaire::sections_of(form);
  const bool last = view.section >= sections.size();
  Html html;
  html.raw("<div class=\"answering\">\n<p class=\"sub\">").text(form.title).raw(" · ");
  if (last)
    html.raw("last check");
  else
    html.text(std::to_string(view.section + 1)).raw(" of ").text(std::to_string(sections.size()));
  html.raw("</p>\n<progress max=\"").text(std::to_string(sections.size())).raw("\" value=\"");
  html.text(std::to_string(view.section)).raw("\">").text(std::to_string(view.section)).raw("</progress>\n<h1>");
  if (last)
    html.raw("Ready to send?");
  else
    html.text(sections[view.section].front()->section.empty() ? form.title
                                                              : sections[view.section].front()->section);
  html.raw("</h1>\n<form method=\"post\" action=\"/answer/form\"");
  if (!last) html.raw(" data-keeps");
  html.raw(">\n");
  add_token(html, view.token);
  html.raw("<input type=\"hidden\" name=\"section\" value=\"").text(std::to_string(view.section + 1)).raw("\">\n");
  if (last)
    add_last_look(html, view);
  else
    for (const Item* item : sections[view.section]) {
      const auto problem = view.problems.find(item->id);
      html.add(
          answer_item(form, *item, typed_of(view, *item), problem == view.problems.end() ? "" : problem->second));
    }
  html.raw("<p class=\"turns\">");
  // The first button of a form is what Enter presses.
  if (last)
    html.raw("<button name=\"go\" value=\"send\">Send</button>");
  else
    html.raw("<button name=\"go\" value=\"next\">Next</button>");
  if (view.section > 0) html.raw(" <button class=\"quiet\" name=\"go\" value=\"back\">Back</button>");
  html.raw("</p>\n</form>\n<p class=\"why\">Your participant code: <strong>").text(view.draft->set.respondent);
  html.raw("</strong>. ").add(kept_words("What you send with Next is kept, should this page be closed."));
  html.raw("</p>\n</div>\n<script src=\"/answer.js\" defer></script>\n");
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
