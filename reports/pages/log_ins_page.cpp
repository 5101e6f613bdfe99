#include "reports/pages/log_ins_page.h"

#include "reports/markup/html.h"

namespace seldinger::reports {

std::string log_ins_page(const Visitor& visitor, const std::vector<DelayedLogIn>& delayed) {
  Html html;
  html.raw(
      "<h1>Log-ins</h1>\n<p>After five wrong passwords for a name, the next try from the same place has to wait, "
      "up to a minute. A browser that has been logged in under that name waits only for its own failures.</p>\n");
  if (delayed.empty()) html.raw("<p>Nobody has to wait now.</p>\n");
  for (const DelayedLogIn& one : delayed) {
    html.raw("<form method=\"post\" action=\"/log-ins\"><input type=\"hidden\" name=\"token\" value=\"")
        .text(visitor.form_token)
        .raw("\"><input type=\"hidden\" name=\"person\" value=\"")
        .text(one.person_id)
        .raw("\">\n<p>")
        .name(one.login_name)
        .raw(": ")
        .text(std::to_string(one.wait_s))
        .raw(" s <button class=\"quiet\">Let try again at once</button></p></form>\n");
  }
  return page("Log-ins", visitor, html);
}

}  // namespace seldinger::reports
