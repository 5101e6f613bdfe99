// Accounts: invitations and one-time links to set a password, made by an admin and used by whoever has them.
#include "casedb/database/credentials.h"
#include "reports/pages/people/accounts_page.h"
#include "web/json/lists_json.h"
#include "web/routes/shelves.h"
#include "web/site/site.h"

namespace seldinger::web {
namespace {

using casedb::Action;

Response accounts(Site& site, const Call& call, int status, const std::optional<reports::ShownLink>& link,
                  std::string_view problem) {
  return html_response(
      status, reports::accounts_page(call.reader->visitor(), site.questions.list_accounts(), link, problem));
}

Response list_accounts(Site& site, const Call& call) {
  return accounts(site, call, 200, {}, "");
}

Response list_accounts_json(Site& site, const Call&) {
  return json_response(accounts_json(site.questions.list_accounts()));
}

// As the browser reached us.
std::string url_of(const Site& site, const Call& call, const std::string& secret) {
  const std::string host = call.request.header("host");
  return (host == site.surroundings.public_authority ? "https://" : "http://") + host + "/password?link=" + secret;
}

Response make_link(Site& site, const Call& call) {
  const std::string& admin_id = call.reader->account.person_id;
  const std::string person_id = call.field("person");
  std::string name = call.field("name");
  auto link = base::Result<casedb::PasswordLink>(base::Error{});
  if (!person_id.empty()) {
    const auto account = site.questions.find_account(person_id);
    if (!account) return refusal(404, call.reader);
    name = account->login_name;
    link = site.questions.make_password_link(admin_id, name);
  } else {
    const auto role = casedb::role_from(call.field("role"));
    if (!role) return refusal(400, call.reader);
    link = site.questions.invite_user(admin_id, name, *role);
  }
  if (!link) return accounts(site, call, 400, {}, link.error().text);
  Response shown =
      accounts(site, call, 200, reports::ShownLink{name, url_of(site, call, link->secret), link->ends_us}, "");
  casedb::wipe(link->secret);
  return shown;
}

Response show_password(Site& site, const Call& call) {
  const auto asked = form_fields(call.request.query);
  const auto link = asked ? asked->find("link") : std::map<std::string, std::string>::iterator{};
  if (!asked || link == asked->end()) return html_response(200, reports::password_page("", "", ""));
  const auto account = site.questions.account_of_password_link(link->second);
  if (!account)
    return html_response(404, reports::password_page("", "", "This link is no longer valid. Ask for another."));
  return html_response(200, reports::password_page(link->second, account->login_name, ""));
}

Response set_password(Site& site, const Call& call) {
  const casedb::Secret password{call.field("password")}, again{call.field("again")};
  const std::string secret = call.field("link");
  const auto account = site.questions.account_of_password_link(secret);
  if (!account)
    return html_response(404, reports::password_page("", "", "This link is no longer valid. Ask for another."));
  if (password.text != again.text)
    return html_response(400, reports::password_page(secret, account->login_name, "The two passwords differ."));
  const auto set = site.questions.set_password_by_link(secret, account->person_id, password.text);
  if (!set) return html_response(400, reports::password_page(secret, account->login_name, set.error().text));
  site.security.note("password set by a one-time link", call.request.from, account->person_id);
  return redirect("/login");
}

constexpr Route kAccountRoutes[] = {
    {"GET", "/accounts", Action::manage_accounts, true, "", "who has an account; invitations and one-time links",
     list_accounts},
    {"GET", "/accounts.json", Action::manage_accounts, false, "", "who has an account", list_accounts_json},
    {"POST", "/accounts", Action::manage_accounts, true, "",
     "makes a one-time link to set a password and shows it once: person, or name and role of somebody new; token",
     make_link, Lane::log_in},
    {"GET", "/password", kOpen, true, "", "the form of a one-time link; ?link=SECRET", show_password},
    {"POST", "/password", kOpen, true, "", "sets a password by a one-time link: link, password, again",
     set_password, Lane::log_in},
};

}  // namespace

std::span<const Route> account_routes() {
  return kAccountRoutes;
}

}  // namespace seldinger::web
