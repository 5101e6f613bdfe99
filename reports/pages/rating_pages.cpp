#include "reports/pages/rating_pages.h"

#include <algorithm>

#include "reports/pages/answer_items.h"
#include "reports/pages/page.h"
#include "reports/words/metric_words.h"

namespace seldinger::reports {
namespace {

namespace rated = assessment::rating;
using assessment::questionnaire::Form;

Html token_field(std::string_view token) {
  return Html{}.raw("<input type=\"hidden\" name=\"token\" value=\"").text(token).raw("\">\n");
}

std::string title_of(const casedb::RatingPage& page) {
  return "Replay " + std::to_string(page.task.number);
}

void add_form(Html& html, const RatingView& view) {
  const casedb::RatingPage& page = *view.page;
  const Form& form = page.form.form;
  html.raw("<form method=\"post\" action=\"/rate/replay\" data-keeps>\n").add(token_field(view.token));
  html.raw("<input type=\"hidden\" name=\"n\" value=\"").text(std::to_string(page.task.number)).raw("\">\n");
  std::string section;
  for (const auto& item : form.items) {
    if (item.section != section) html.raw("<h3>").text(item.section).raw("</h3>\n");
    section = item.section;
    const auto kept = page.answers.find(item.id);
    std::string typed = kept == page.answers.end() ? "" : assessment::questionnaire::text_of(item, kept->second);
    if (const auto refused = view.typed.find(item.id); refused != view.typed.end()) typed = refused->second;
    const auto problem = view.problems.find(item.id);
    html.add(answer_item(form, item, typed, problem == view.problems.end() ? "" : problem->second));
  }
  html.raw(
      "<p class=\"turns\"><button name=\"go\" value=\"send\">Send</button> <button class=\"quiet\" name=\"go\" "
      "value=\"later\">Later</button></p>\n</form>\n<p class=\"why\">Once sent, a rating cannot be changed. ");
  html.add(kept_words("With Later it is kept as it is.")).raw("</p>\n<script src=\"/answer.js\" defer></script>\n");
}

// What was sent; of the calibration set beside what is known.
void add_sent(Html& html, const casedb::RatingPage& page) {
  const Form& form = page.form.form;
  html.raw("<p class=\"note\">Sent.</p>\n");
  if (page.known.empty()) {
    html.raw("<p><a href=\"/rate/bench\">Go on</a></p>\n");
    return;
  }
  html.raw(
      "<p>This replay is of the calibration set: its scores were agreed on beforehand. Where yours differ by more "
      "than a point, look again before you go on.</p>\n<table><thead><tr><th scope=\"col\">Item</th><th "
      "scope=\"col\">Yours</th><th scope=\"col\">Agreed</th></tr></thead><tbody>\n");
  for (const auto& item : form.items) {
    const auto known = page.known.find(item.id);
    if (known == page.known.end()) continue;
    const auto given = page.answers.find(item.id);
    const std::string yours =
        given == page.answers.end() ? "" : assessment::questionnaire::text_of(item, given->second);
    html.raw("<tr><th scope=\"row\">").text(item.text).raw("</th><td>").text(yours.empty() ? "none" : yours);
    html.raw("</td><td>").text(number_text(known->second, 0)).raw("</td></tr>\n");
  }
  html.raw("</tbody></table>\n<p><a href=\"/rate/bench\">Go on</a></p>\n");
}

void add_tasks(Html& html, const casedb::RatingBench& bench, bool calibration) {
  html.raw("<ol class=\"bench\">\n");
  for (const casedb::RatingTask& task : bench.tasks) {
    if ((task.part == rated::Part::calibration) != calibration) continue;
    html.raw("<li><a href=\"/rate/replay?n=").text(std::to_string(task.number)).raw("\">Replay ");
    html.text(std::to_string(task.number)).raw("</a> <span class=\"why\">").text(task.sent ? "sent" : "open");
    html.raw("</span></li>\n");
  }
  html.raw("</ol>\n");
}

}  // namespace

std::string rating_start_page(const std::string& token, const std::string& problem) {
  Html html;
  html.raw("<div class=\"answering\">\n<h1>Rate replays</h1>\n");
  add_problem(html, problem);
  html.raw("<form method=\"post\" action=\"/rate\">\n").add(token_field(token));
  html.raw(
      "<p><label for=\"key\">Your key</label>\n<input id=\"key\" name=\"key\" autocomplete=\"off\" "
      "autocapitalize=\"none\" spellcheck=\"false\" maxlength=\"20\" required></p>\n<p class=\"why\">Twelve "
      "letters and digits that only you were given.</p>\n<p><button>Open the "
      "bench</button></p>\n</form>\n</div>\n");
  return page("Rate replays", {}, html);
}

std::string rating_bench_page(const casedb::RatingBench& bench) {
  const auto sent = static_cast<std::size_t>(std::count_if(bench.tasks.begin(), bench.tasks.end(),
                                                           [](const casedb::RatingTask& one) { return one.sent; }));
  const auto next =
      std::find_if(bench.tasks.begin(), bench.tasks.end(), [](const casedb::RatingTask& one) { return !one.sent; });
  const bool calibrates = std::any_of(bench.tasks.begin(), bench.tasks.end(), [](const casedb::RatingTask& one) {
    return one.part == rated::Part::calibration;
  });
  Html html;
  html.raw("<div class=\"answering\">\n<p class=\"sub\">").text(bench.round.title).raw("</p>\n<h1>");
  html.text(bench.form_title).raw("</h1>\n<progress max=\"").text(std::to_string(bench.tasks.size()));
  html.raw("\" value=\"").text(std::to_string(sent)).raw("\"></progress>\n<p>").text(std::to_string(sent));
  html.raw(" of ").text(std::to_string(bench.tasks.size())).raw(" sent.</p>\n");
  if (!bench.introduction.empty()) html.raw("<p>").text(bench.introduction).raw("</p>\n");
  html.raw(
      "<p class=\"note\">You cannot see whose a replay is, and its number reveals nothing: each rater has an order "
      "of their own. You may meet a replay twice. Please rate in this order, and talk to nobody about it until all "
      "have finished.</p>\n");
  if (!bench.round.is_open())
    html.raw("<p class=\"problem\" role=\"alert\">The round is closed: no more ratings are accepted.</p>\n");
  else if (next != bench.tasks.end())
    html.raw("<p><a class=\"button\" href=\"/rate/replay?n=")
        .text(std::to_string(next->number))
        .raw("\">Go on with replay ")
        .text(std::to_string(next->number))
        .raw("</a></p>\n");
  else
    html.raw("<p><strong>Everything is sent. Thank you.</strong></p>\n");
  if (calibrates) {
    html.raw(
        "<h2>To calibrate</h2>\n<p>Their scores were agreed on; they are shown when you have sent yours.</p>\n");
    add_tasks(html, bench, true);
    html.raw("<h2>To rate</h2>\n");
  }
  add_tasks(html, bench, false);
  html.raw("</div>\n");
  return page(bench.form_title, {}, html);
}

std::string rating_page(const RatingView& view) {
  const casedb::RatingPage& shown = *view.page;
  Html html;
  html.raw("<p class=\"back\"><a href=\"/rate/bench\">All replays</a></p>\n<h1>")
      .text(title_of(shown))
      .raw("</h1>\n");
  html.raw("<div class=\"rating\">\n<div class=\"rated\">\n")
      .raw(kKeptMarkup)
      .raw("</div>\n<div class=\"answering\">\n<h2>");
  html.text(shown.form.form.title).raw("</h2>\n");
  if (shown.task.sent)
    add_sent(html, shown);
  else if (!shown.round.is_open())
    html.raw("<p class=\"problem\" role=\"alert\">The round is closed: no more ratings are accepted.</p>\n");
  else
    add_form(html, view);
  html.raw("</div>\n</div>\n<script src=\"/film.js\" defer></script>\n");
  return with_kept_markup(page(title_of(shown), {}, html), shown.sheet);
}

}  // namespace seldinger::reports
