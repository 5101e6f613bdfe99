#include "reports/questionnaires/board_page.h"

#include <algorithm>

#include "reports/pages/answer_items.h"
#include "reports/pages/page.h"

namespace seldinger::reports {
namespace {

// Who is to be at which station now.
void add_stations(Html& html, const casedb::Workshop& workshop, const std::vector<casedb::Participant>& all) {
  html.raw("<ul class=\"board-now\">\n");
  for (std::size_t place = 0; place < workshop.stations.size(); ++place) {
    html.raw("<li><h2>").name(workshop.stations[place].title).raw("</h2><p>");
    bool any = false;
    for (const casedb::Participant& one : all) {
      if (one.next() != place) continue;
      html.raw("<span>").text(std::to_string(one.number)).raw("</span> ");
      any = true;
    }
    if (!any) html.raw("nobody");
    html.raw("</p></li>\n");
  }
  html.raw("</ul>\n");
}

void add_turn(Html& html, const casedb::Workshop& workshop, const casedb::Participant& one, std::size_t place) {
  const std::string& title = workshop.stations[place].title;
  if (one.done[place])
    html.raw("<td class=\"done\">✓ ").name(title).raw("<span class=\"for-ears\">, done</span></td>");
  else if (one.next() == place)
    html.raw("<td class=\"now\">▶ ").name(title).raw("<span class=\"for-ears\">, now</span></td>");
  else
    html.raw("<td>").name(title).raw("</td>");
}

}  // namespace

std::string board_page(const casedb::Workshop& workshop, const std::vector<casedb::Participant>& all) {
  const auto through = std::count_if(all.begin(), all.end(), [](const auto& one) { return !one.next(); });
  Html html;
  html.raw("<div class=\"board\">\n<h1>").name(workshop.title).raw("</h1>\n<p class=\"sub\">");
  html.text(std::to_string(through)).raw(" of ").text(std::to_string(all.size()));
  html.text(all.size() == 1 ? " person is" : " people are").raw(" through all stations.");
  if (!workshop.is_open()) html.raw(" No more people are coming.");
  html.raw("</p>\n");
  add_stations(html, workshop, all);
  html.raw("<div class=\"scroll\"><table>\n<thead><tr><th scope=\"col\">Number</th>");
  for (std::size_t turn = 1; turn <= workshop.stations.size(); ++turn)
    html.raw("<th scope=\"col\">Turn ").text(std::to_string(turn)).raw("</th>");
  html.raw("</tr></thead>\n<tbody>\n");
  for (const casedb::Participant& one : all) {
    html.raw("<tr><th scope=\"row\">").text(std::to_string(one.number)).raw("</th>");
    for (const std::size_t place : one.order) add_turn(html, workshop, one, place);
    html.raw("</tr>\n");
  }
  html.raw("</tbody></table></div>\n<p class=\"why\">✓ done · ▶ now. This page asks again every ");
  html.text(std::to_string(kBoardEveryS)).raw(" seconds.</p>\n</div>\n");
  return page(workshop.title, {}, html);
}

std::string board_start_page(const std::string& problem) {
  Html html;
  html.raw("<div class=\"answering\">\n<h1>A workshop’s board</h1>\n");
  add_problem(html, problem);
  html.raw(
      "<form method=\"get\" action=\"/board\">\n<p><label for=\"code\">Code</label>\n<input id=\"code\" "
      "name=\"code\" autocomplete=\"off\" autocapitalize=\"characters\" maxlength=\"8\" required></p>\n"
      "<p><button>Show it</button></p>\n</form>\n</div>\n");
  return page("A workshop’s board", {}, html);
}

}  // namespace seldinger::reports
