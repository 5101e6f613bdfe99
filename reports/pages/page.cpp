#include "reports/pages/page.h"

namespace seldinger::reports {

std::string page(std::string_view title, const Visitor& visitor, const Html& content) {
  Html html;
  html.raw(
          "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
          "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
          "<meta name=\"color-scheme\" content=\"light dark\">\n<title>")
      .text(title)
      .raw(
          " · Seldinger</title>\n<link rel=\"stylesheet\" href=\"/style.css\">\n<link rel=\"icon\" "
          "href=\"/icon.svg\" type=\"image/svg+xml\">\n</head>\n<body>\n"
          "<a class=\"skip\" href=\"#content\">Skip to the content</a>\n"
          "<header class=\"top\">\n<p class=\"brand\">");
  if (visitor.name.empty())
    html.raw("Seldinger</p>\n");
  else
    html.raw("<a href=\"/\">Seldinger</a></p>\n");
  if (!visitor.name.empty()) {
    const bool answers_for_others = visitor.role == "mentor" || visitor.role == "director";
    html.raw("<nav aria-label=\"Main\">");
    if (visitor.role == "trainee" || answers_for_others) html.raw("<a href=\"/progress\">Progress</a> ");
    if (visitor.role == "researcher") html.raw("<a href=\"/studies\">Studies</a> ");
    html.raw("<a href=\"/attempts\">Attempts</a>");
    if (visitor.role != "admin") html.raw(" <a href=\"/curricula\">Curriculum</a>");
    if (visitor.role != "trainee") html.raw(" <a href=\"/cases\">Cases</a>");
    if (answers_for_others) html.raw(" <a href=\"/cohorts\">Cohorts</a>");
    if (visitor.role == "director") html.raw(" <a href=\"/stations\">Stations</a>");
    if (visitor.role == "admin")
      html.raw(
          " <a href=\"/stations/timing\">Stations</a> <a href=\"/accounts\">Accounts</a> <a "
          "href=\"/log-ins\">Log-ins</a> <a href=\"/audit\">Audit</a>");
    if (visitor.role != "trainee" && visitor.role != "director") html.raw(" <a href=\"/jobs\">Jobs</a>");
    html.raw(" <a href=\"/me\">About you</a>");
    html.raw(" <a href=\"/metrics\">Metrics</a>");
    html.raw("</nav>\n<div class=\"who\"><span>")
        .name(visitor.name)
        .raw(" <span class=\"role\">")
        .text(visitor.role)
        .raw(
            "</span></span>\n<form method=\"post\" action=\"/logout\"><input type=\"hidden\" name=\"token\" "
            "value=\"")
        .text(visitor.form_token)
        .raw("\"><button class=\"quiet\">Log out</button></form></div>\n");
  }
  html.raw("</header>\n<main id=\"content\" tabindex=\"-1\">\n")
      .add(content)
      .raw("</main>\n<footer><p><strong>")
      .text(kTrainingOnly)
      .raw("</strong></p></footer>\n</body>\n</html>\n");
  return html.str();
}

std::string list_page(std::string_view title, const Visitor& visitor, const Html& content) {
  return page(title, visitor, Html(content).raw("<script src=\"/tables.js\" defer></script>\n"));
}

std::string page_with_style(std::string_view title, std::string_view style, const Html& content) {
  Html head, body;
  head.raw(
          "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
          "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
          "<meta name=\"color-scheme\" content=\"light dark\">\n<title>")
      .text(title)
      .raw(" · Seldinger</title>\n<style>\n");
  body.raw(
          "</style>\n</head>\n<body>\n<header class=\"top\">\n<p class=\"brand\">Seldinger</p>\n</header>\n"
          "<main id=\"content\" tabindex=\"-1\">\n")
      .add(content)
      .raw("</main>\n<footer><p><strong>")
      .text(kTrainingOnly)
      .raw("</strong></p></footer>\n</body>\n</html>\n");
  return head.str() + std::string(style) + body.str();
}

std::string with_kept_markup(std::string page, const std::string& markup) {
  return page.replace(page.find(kKeptMarkup), sizeof kKeptMarkup - 1, markup);
}

std::string message_page(std::string_view title, std::string_view message, const Visitor& visitor) {
  Html content;
  content.raw("<div class=\"message\">\n<h1>")
      .text(title)
      .raw("</h1>\n<p>")
      .text(message)
      .raw("</p>\n<p><a href=\"/\">Go to the start page</a></p>\n</div>\n");
  return page(title, visitor, content);
}

}  // namespace seldinger::reports
