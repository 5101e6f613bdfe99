#include "reports/pages/me_page.h"

#include <algorithm>

#include "reports/words/metric_words.h"

namespace seldinger::reports {
namespace {

void begin_form(Html& html, const Visitor& visitor, std::string_view action) {
  html.raw("<form method=\"post\" action=\"").text(action);
  html.raw("\"><input type=\"hidden\" name=\"token\" value=\"").text(visitor.form_token).raw("\">\n");
}

void add_paragraphs(Html& html, std::string_view body) {
  while (!body.empty()) {
    const std::size_t end = std::min(body.find('\n'), body.size());
    if (end > 0) html.raw("<p>").text(body.substr(0, end)).raw("</p>\n");
    body.remove_prefix(std::min(end + 1, body.size()));
  }
}

std::string standing_of(const casedb::Consent& one) {
  if (one.stands()) return "You consented on " + utc_text(*one.given_us) + ".";
  if (one.refused()) return "You refused on " + utc_text(*one.given_us) + ".";
  if (one.given_us) return "You withdrew your consent on " + utc_text(*one.withdrawn_us) + ".";
  return "You have not answered.";
}

// `covered`: consent to research with the library, which stands, covers this study that was never answered.
void add_consent(Html& html, const Visitor& visitor, const casedb::Consent& one, bool covered) {
  html.raw("<article class=\"consent\">\n<h3>");
  if (one.study_id)
    html.raw("Study: ").name(one.study_title);
  else
    html.raw("Research with this library");
  html.raw("</h3>\n<p class=\"sub\">Version ").text(std::to_string(one.version));
  if (!one.newest) html.raw(" (an earlier wording)");
  html.raw(", SHA-256 ").text(one.body_hash.substr(0, 12)).raw("…</p>\n");
  add_paragraphs(html, one.body);
  html.raw("<p class=\"standing\"><strong>").text(standing_of(one)).raw("</strong>");
  if (covered) html.raw(" Your consent to research with this library covers this study.");
  html.raw("</p>\n");
  begin_form(html, visitor, "/me/consent");
  html.raw("<input type=\"hidden\" name=\"text\" value=\"").text(one.text_id).raw("\">\n");
  if (one.stands())
    html.raw(
        "<p><label class=\"tick\"><input type=\"checkbox\" name=\"delete\" value=\"yes\"> Also delete my "
        "recordings "
        "and results</label></p>\n<p><button class=\"quiet\" name=\"answer\" value=\"withdraw\">Withdraw my "
        "consent</button></p>\n");
  else
    html.raw("<p><button name=\"answer\" value=\"give\">I consent</button></p>\n");
  if (covered)
    html.raw("<p><button class=\"quiet\" name=\"answer\" value=\"withdraw\">Not for this study</button></p>\n");
  html.raw("</form>\n</article>\n");
}

void add_fact(Html& html, const casedb::FactInfo& fact, const casedb::FactGiven* last, const std::string& value) {
  html.raw("<p><label for=\"").text(fact.id).raw("\">").text(fact.words);
  html.raw("</label>\n");
  if (fact.is_choice()) {
    html.raw("<select id=\"").text(fact.id).raw("\" name=\"").text(fact.id).raw("\"><option value=\"\"></option>");
    for (const std::string& choice : casedb::choices_of(fact)) {
      html.raw("<option value=\"").text(choice);
      if (choice == value)
        html.raw("\" selected>");
      else
        html.raw("\">");
      html.text(choice).raw("</option>");
    }
    html.raw("</select>");
  } else {
    html.raw("<input id=\"").text(fact.id).raw("\" name=\"").text(fact.id).raw("\" type=\"number\" min=\"");
    html.text(std::to_string(static_cast<int>(fact.least))).raw("\" max=\"");
    html.text(std::to_string(static_cast<int>(fact.most))).raw("\" step=\"").text(fact.whole ? "1" : "any");
    html.raw("\" value=\"").text(value).raw("\">");
  }
  html.raw("\n<span class=\"why\">");
  if (!fact.least_words.empty())
    html.text(std::to_string(static_cast<int>(fact.least)))
        .raw(" ")
        .text(fact.least_words)
        .raw("; ")
        .text(std::to_string(static_cast<int>(fact.most)))
        .raw(" ")
        .text(fact.most_words)
        .raw(". ");
  if (last != nullptr) html.raw("Given on ").text(utc_text(last->given_us)).raw(".");
  html.raw("</span></p>\n");
}

}  // namespace

std::string me_page(const Visitor& visitor, const AboutMe& about, const Told& told) {
  Html html;
  html.raw("<h1>About you</h1>\n");
  if (!told.problem.empty()) html.raw("<p class=\"problem\" role=\"alert\">").text(told.problem).raw("</p>\n");
  if (!told.done.empty()) html.raw("<p class=\"note\" role=\"status\">").text(told.done).raw("</p>\n");
  html.raw(
      "<section>\n<h2>Consent to research</h2>\n<p class=\"note\">You decide freely. Your training is the same "
      "whatever you answer, and you can withdraw at any time without giving a reason. Researchers see a pseudonym, "
      "never your name.</p>\n");
  if (about.consents.empty()) html.raw("<p>No study is asking for your consent.</p>\n");
  const auto any = [&](const auto& is) { return std::any_of(about.consents.begin(), about.consents.end(), is); };
  const bool to_library = any([](const casedb::Consent& one) { return !one.study_id && one.stands(); });
  for (const casedb::Consent& one : about.consents) {
    const bool answered =
        any([&](const casedb::Consent& other) { return other.study_id == one.study_id && other.given_us; });
    if (one.newest || one.stands()) add_consent(html, visitor, one, one.study_id && to_library && !answered);
  }
  html.raw(
      "</section>\n<section>\n<h2>Your experience</h2>\n<p class=\"note\">Studies compare people by these facts. "
      "Leave blank what you do not want to say; an answer counts from the day you give it.</p>\n");
  begin_form(html, visitor, "/me/facts");
  const auto last = casedb::newest_facts(about.facts);
  for (const casedb::FactInfo& fact : casedb::fact_infos()) {
    const auto found = last.find(std::string(fact.id));
    const casedb::FactGiven* given = found == last.end() ? nullptr : &found->second;
    const auto typed = told.typed.find(std::string(fact.id));
    add_fact(html, fact, given, typed != told.typed.end() ? typed->second : given != nullptr ? given->answer : "");
  }
  html.raw(
      "<p><button>Save</button></p>\n</form>\n</section>\n<section>\n<h2>Delete what you recorded</h2>\n"
      "<p class=\"note\">Your recordings, results and grades are deleted from this library and cannot be brought "
      "back; your account stays. Backups and exports made before are not changed by this.</p>\n");
  begin_form(html, visitor, "/me/erase");
  html.raw(
      "<p><label class=\"tick\"><input type=\"checkbox\" name=\"sure\" value=\"yes\" required> Delete all my "
      "recordings and results</label></p>\n<p><button class=\"quiet\">Delete</button></p>\n</form>\n</section>\n");
  return page("About you", visitor, html);
}

}  // namespace seldinger::reports
