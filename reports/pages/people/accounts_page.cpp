#include "reports/pages/people/accounts_page.h"

#include "casedb/cases/permissions.h"
#include "reports/words/metric_words.h"

namespace seldinger::reports {
namespace {

void add_token(Html& html, const Visitor& visitor) {
  html.raw("<form method=\"post\" action=\"/accounts\"><input type=\"hidden\" name=\"token\" value=\"")
      .text(visitor.form_token)
      .raw("\">");
}

void add_account(Html& html, const Visitor& visitor, const casedb::Account& account) {
  html.raw("<tr><th scope=\"row\">")
      .name(account.login_name)
      .raw("</th><td data-label=\"Role\">")
      .text(casedb::name_of(account.role))
      .raw("</td><td data-label=\"Account\">")
      .text(account.enabled ? "open" : "closed")
      .raw("</td><td data-label=\"Password\">");
  if (account.enabled) {
    add_token(html, visitor);
    html.raw("<input type=\"hidden\" name=\"person\" value=\"")
        .text(account.person_id)
        .raw("\"><button class=\"quiet\" aria-label=\"One-time link for ")
        .text(account.login_name)
        .raw("\">One-time link</button></form>");
  }
  html.raw("</td></tr>\n");
}

}  // namespace

std::string accounts_page(const Visitor& visitor, const std::vector<casedb::Account>& accounts,
                          const std::optional<ShownLink>& link, std::string_view problem) {
  Html html;
  html.raw(
      "<h1>Accounts</h1>\n<p class=\"sub\">With a one-time link people set their own password. It is shown once, "
      "here; "
      "hand it over yourself.</p>\n");
  if (!problem.empty()) html.raw("<p class=\"problem\" role=\"alert\">").text(problem).raw("</p>\n");
  if (link)
    html.raw("<div class=\"message\" role=\"status\"><p>For ")
        .name(link->name)
        .raw(", until ")
        .text(utc_text(link->ends_us))
        .raw(" and once:</p>\n<p><code>")
        .text(link->url)
        .raw("</code></p></div>\n");
  html.raw("<section>\n<h2>Invite somebody</h2>\n");
  add_token(html, visitor);
  html.raw(
      "\n<p><label for=\"name\">Name</label>\n<input id=\"name\" name=\"name\" autocomplete=\"off\" "
      "autocapitalize=\"none\" spellcheck=\"false\" maxlength=\"64\" required></p>\n"
      "<p><label for=\"role\">Role</label>\n<select id=\"role\" name=\"role\">");
  for (const casedb::Role role : casedb::kAllRoles)
    html.raw("<option>").text(casedb::name_of(role)).raw("</option>");
  html.raw(
      "</select></p>\n<p><button>Make a one-time link</button></p></form>\n</section>\n"
      "<div class=\"wide\">\n<table class=\"list\">\n<caption>Everybody with an account</caption>\n<thead><tr><th "
      "scope=\"col\">Name</th><th scope=\"col\">Role</th><th scope=\"col\">Account</th><th "
      "scope=\"col\">Password</th></tr></thead>\n<tbody>\n");
  for (const casedb::Account& one : accounts) add_account(html, visitor, one);
  html.raw("</tbody>\n</table>\n</div>\n");
  return page("Accounts", visitor, html);
}

std::string password_page(std::string_view link, std::string_view login_name, std::string_view problem) {
  Html html;
  html.raw("<div class=\"login\">\n<h1>Set your password</h1>\n");
  if (!problem.empty()) html.raw("<p class=\"problem\" role=\"alert\">").text(problem).raw("</p>\n");
  if (login_name.empty()) {
    html.raw("<p>A one-time link opens this page. Whoever keeps the accounts makes one for you.</p>\n</div>\n");
    return page("Set your password", Visitor{}, html);
  }
  html.raw("<form method=\"post\" action=\"/password\">\n<input type=\"hidden\" name=\"link\" value=\"")
      .text(link)
      .raw("\">\n<p>Your name: <strong>")
      .name(login_name)
      .raw(
          "</strong></p>\n<p><label for=\"password\">New password</label>\n<input id=\"password\" "
          "name=\"password\" type=\"password\" autocomplete=\"new-password\" minlength=\"8\" maxlength=\"128\" "
          "required autofocus></p>\n<p><label for=\"again\">Repeat password</label>\n<input id=\"again\" "
          "name=\"again\" type=\"password\" autocomplete=\"new-password\" minlength=\"8\" maxlength=\"128\" "
          "required></p>\n<p><button>Set it</button></p>\n</form>\n</div>\n");
  return page("Set your password", Visitor{}, html);
}

}  // namespace seldinger::reports
