#include "reports/sheets/blinded_replay.h"

#include "reports/charts/timeline.h"
#include "reports/sheets/sheet_parts.h"

namespace seldinger::reports {

std::string blinded_replay(ReplaySheet sheet) {
  sheet.blinded = true;
  sheet.course.lanes.clear();
  sheet.course.bands.clear();
  sheet.course.forces.clear();
  for (CoursePoint& point : sheet.course.points) point.tip_seen = true;  // all of the way is drawn alike
  std::vector<double> moments_s;
  for (const SheetMoment& moment : sheet.moments) moments_s.push_back(moment.t_s);
  Html html;
  html.raw("<div class=\"replay\">\n<p class=\"soft\">");
  html.text(picture_text(sheet.attempt.row.picture) + " · " + instrument_text(sheet.attempt.row.instrument));
  html.raw("</p>\n").add(sheet_film(sheet)).add(sheet_strip(sheet)).add(sheet_planes(sheet));
  if (const Html drawn = timeline(sheet.course, moments_s); !drawn.empty()) {
    html.raw("<section aria-labelledby=\"time\"><h2 id=\"time\">Over time</h2>\n<div class=\"scroll\">").add(drawn);
    html.raw(
        "</div>\n<p class=\"soft\"><span class=\"key\">depth of the tip</span> <span class=\"key "
        "target-key\">where the target lies for this entry</span> Numbers above: the pictures.</p></section>\n");
  }
  html.raw("</div>\n");
  return html.str();
}

}  // namespace seldinger::reports
