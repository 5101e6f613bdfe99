#include "reports/pages/login_page.h"

#include "reports/markup/html.h"
#include "reports/pages/page.h"

namespace seldinger::reports {

std::string login_page(std::string_view form_token, std::string_view problem) {
  Html html;
  html.raw("<div class=\"login\">\n<h1>Log in</h1>\n");
  if (!problem.empty()) html.raw("<p class=\"problem\" role=\"alert\">").text(problem).raw("</p>\n");
  html.raw("<form method=\"post\" action=\"/login\">\n<input type=\"hidden\" name=\"token\" value=\"")
      .text(form_token)
      .raw(
          "\">\n<p><label for=\"name\">Name</label>\n<input id=\"name\" name=\"name\" autocomplete=\"username\" "
          "autocapitalize=\"none\" spellcheck=\"false\" maxlength=\"64\" required autofocus></p>\n"
          "<p><label for=\"password\">Password</label>\n<input id=\"password\" name=\"password\" type=\"password\" "
          "autocomplete=\"current-password\" maxlength=\"128\" required></p>\n"
          "<p><button>Log in</button></p>\n</form>\n"
          "<p class=\"note\">No account yet? Whoever runs this library adds one with <code>seldinger user "
          "add</code>."
          "</p>\n</div>\n");
  return page("Log in", Visitor{}, html);
}

}  // namespace seldinger::reports
