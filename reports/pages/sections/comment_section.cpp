#include "reports/pages/sections/comment_section.h"

#include "reports/words/metric_words.h"

namespace seldinger::reports {

Html comment_section(const AttemptView& attempt, const std::string& form_token) {
  Html html;
  if (attempt.comments.empty() && form_token.empty()) return html;
  html.raw("<section class=\"comments\" aria-labelledby=\"comments\">\n<h2 id=\"comments\">Comments</h2>\n");
  if (attempt.comments.empty()) html.raw("<p class=\"note\">Nobody has commented on it yet.</p>\n");
  if (!attempt.comments.empty()) html.raw("<dl class=\"definitions\">\n");
  for (const CommentView& one : attempt.comments) {
    html.raw("<dt data-at-s=\"").text(number_text(one.comment.at_s, 1)).raw("\">At ");
    html.text(number_text(one.comment.at_s, 1)).raw(" s</dt><dd>").text(one.comment.body);
    html.raw(" <span class=\"why\">").name(one.author).raw(", ").text(utc_text(one.comment.written_us));
    html.raw("</span></dd>\n");
  }
  if (!attempt.comments.empty()) html.raw("</dl>\n");
  if (form_token.empty()) return html.raw("</section>\n");
  html.raw("<form method=\"post\" action=\"/attempts/").text(attempt.row.attempt_id).raw("/comments\">\n");
  html.raw("<input type=\"hidden\" name=\"token\" value=\"").text(form_token).raw("\">\n");
  html.raw(
      "<p><label for=\"at\">At second</label>\n<input id=\"at\" name=\"at\" inputmode=\"decimal\" "
      "value=\"0\"></p>\n");
  html.raw("<p class=\"why\">From 0 to ").text(number_text(attempt.row.duration_s, 1));
  html.raw(", as the course above counts; the trainee sees it there.</p>\n");
  html.raw(
      "<p><label for=\"text\">Comment</label>\n<textarea id=\"text\" name=\"text\" rows=\"3\" maxlength=\"500\" "
      "required>");
  return html.raw("</textarea></p>\n<p><button>Add comment</button></p>\n</form>\n</section>\n");
}

}  // namespace seldinger::reports
