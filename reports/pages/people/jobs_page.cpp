#include "reports/pages/people/jobs_page.h"

#include <cstdio>

#include "casedb/cases/cases.h"
#include "reports/words/metric_words.h"

namespace seldinger::reports {
namespace {

std::string bytes_text(std::uint64_t bytes) {
  constexpr double kKilo = 1000.0;
  if (bytes < 1000) return std::to_string(bytes) + " bytes";
  const double kilos = static_cast<double>(bytes) / kKilo;
  return kilos < kKilo ? number_text(kilos, 0) + " kB" : number_text(kilos / kKilo, 1) + " MB";
}

void add_form_token(Html& html, const Visitor& visitor) {
  html.raw("<input type=\"hidden\" name=\"token\" value=\"").text(visitor.form_token).raw("\">\n");
}

void add_import_form(Html& html, const Visitor& visitor, std::string_view problem) {
  html.raw("<section>\n<h2>Import a CT</h2>\n");
  if (!problem.empty()) html.raw("<p class=\"problem\" role=\"alert\">").text(problem).raw("</p>\n");
  html.raw("<form method=\"post\" action=\"/jobs\">\n<input type=\"hidden\" name=\"kind\" value=\"import\">\n");
  add_form_token(html, visitor);
  html.raw(
      "<p><label for=\"title\">Title of the case</label>\n<input id=\"title\" name=\"title\" maxlength=\"100\" "
      "autocomplete=\"off\" aria-describedby=\"about-title\">\n<span class=\"why\" id=\"about-title\">Never a "
      "patient’s name. If left out, the case is named after its size.</span></p>\n<p><label "
      "for=\"modality\">Practised with</label>\n<select id=\"modality\" name=\"modality\"><option "
      "value=\"mpr\">slices of the CT</option><option value=\"xray\">fluoroscopy</option><option "
      "value=\"ultrasound\">ultrasound</option></select></p>\n<p><label for=\"position\">The patient "
      "lies</label>\n<select id=\"position\" name=\"position\"><option value=\"supine\">on the "
      "back</option><option value=\"prone\">face down</option><option value=\"lateral_left\">on the left "
      "side</option><option value=\"lateral_right\">on the right side</option></select></p>\n<p><label "
      "for=\"face\">A face in the volume</label>\n<select id=\"face\" name=\"face\"><option value=\"refuse\">is "
      "refused</option><option value=\"crop\">is cut off below the chin</option><option value=\"deface\">has its "
      "front taken away</option></select></p>\n<p><label class=\"tick\"><input type=\"checkbox\" "
      "name=\"no_burned_in_text\" value=\"yes\"> I looked through the slices and saw no text in "
      "them</label></p>\n<p><button>Choose its files</button></p>\n</form>\n</section>\n");
}

void add_results(Html& html, const JobView& job) {
  if (!job.case_id.empty())
    html.raw("<p><a class=\"button\" href=\"/cases/").text(job.case_id).raw("\">Go to the case</a></p>\n");
  if (job.results.empty()) return;
  html.raw("<h2>Files</h2>\n<ul>\n");
  for (std::size_t i = 0; i < job.results.size(); ++i) {
    const JobResult& one = job.results[i];
    html.raw("<li>");
    if (one.too_large)
      html.text(one.name);
    else
      html.raw("<a download href=\"/jobs/")
          .text(job.job_id)
          .raw("/result?n=")
          .text(std::to_string(i))
          .raw("\">")
          .text(one.name)
          .raw("</a>");
    html.raw(" <span class=\"why\">").text(bytes_text(one.bytes));
    if (one.too_large) html.raw(", too large for a page: get it with <code>seldinger export</code>");
    html.raw("</span></li>\n");
  }
  html.raw("</ul>\n");
}

void add_receiving(Html& html, const JobView& job) {
  html.raw("<div data-send=\"/jobs/").text(job.job_id);
  html.raw(
      "\" hidden>\n<p><label for=\"folder\">The folder of a DICOM series</label>\n<input id=\"folder\" "
      "type=\"file\" webkitdirectory data-files></p>\n<p><label for=\"file\">Or one file: .nii, .nii.gz, .nrrd, "
      ".mha or DICOM</label>\n<input id=\"file\" type=\"file\" "
      "accept=\".nii,.gz,.nrrd,.mha,.dcm,application/dicom\" data-files></p>\n</div>\n<noscript><p>Files are sent "
      "by a script, and scripts do not run in this browser. On the server itself <code>seldinger import</code> "
      "reads them.</p></noscript>\n");
}

}  // namespace

std::string job_kind_text(const std::string& kind) {
  if (kind == "import") return "Import of a CT";
  if (kind == "study_report") return "Validity report";
  return "Export of a study";
}

std::string job_state_text(const std::string& state) {
  if (state == "receiving") return "Waits for its files";
  if (state == "waiting") return "Waits for its turn";
  if (state == "running") return "Runs";
  if (state == "done") return "Done";
  if (state == "failed") return "Failed";
  return state == "cancelled" ? "Cancelled" : "Interrupted";
}

double share_done(const std::string& doing) {
  unsigned done = 0, all = 0;
  if (std::sscanf(doing.c_str(), "%u of %u", &done, &all) != 2 || all == 0 || done > all) return -1.0;
  return static_cast<double>(done) / static_cast<double>(all);
}

std::string jobs_page(const Visitor& visitor, std::span<const JobView> jobs, bool may_import,
                      std::string_view problem) {
  Html html;
  html.raw(
      "<h1>Jobs</h1>\n<p class=\"sub\">Work that takes a while runs here while you do something else, one job at a "
      "time. Only you see your jobs; they are kept for a week.</p>\n");
  if (may_import)
    add_import_form(html, visitor, problem);
  else if (!problem.empty())
    html.raw("<p class=\"problem\" role=\"alert\">").text(problem).raw("</p>\n");
  html.raw("<section>\n<h2>Yours</h2>\n");
  if (jobs.empty()) {
    html.raw("<p>You have none.");
    if (!may_import) html.raw(" A study’s page starts its report and its export.");
    html.raw("</p>\n");
  }
  if (!jobs.empty())
    html.raw(
        "<div class=\"wide\">\n<table class=\"list\">\n<caption>Newest first</caption>\n<thead><tr><th "
        "scope=\"col\">Job</th><th scope=\"col\">Of</th><th scope=\"col\">State</th><th scope=\"col\">Asked for "
        "(UTC)</th></tr></thead>\n<tbody>\n");
  for (const JobView& one : jobs) {
    html.raw("<tr><th scope=\"row\"><a href=\"/jobs/").text(one.job_id).raw("\">").text(job_kind_text(one.kind));
    html.raw("</a></th><td data-label=\"Of\">").name(one.title.empty() ? "—" : one.title);
    html.raw("</td><td data-label=\"State\">").text(job_state_text(one.state));
    html.raw("</td><td data-label=\"Asked for\">").text(utc_text(one.asked_us)).raw("</td></tr>\n");
  }
  if (!jobs.empty()) html.raw("</tbody>\n</table>\n</div>\n");
  html.raw("</section>\n");
  return list_page("Jobs", visitor, html);
}

std::string job_page(const Visitor& visitor, const JobView& job) {
  Html html;
  html.raw("<p class=\"back\"><a href=\"/jobs\">All jobs</a></p>\n<h1>")
      .text(job_kind_text(job.kind))
      .raw("</h1>\n");
  if (!job.title.empty()) html.raw("<p class=\"sub\">").name(job.title).raw("</p>\n");
  html.raw("<div class=\"job\" data-job=\"/jobs/").text(job.job_id).raw("\" data-state=\"").text(job.state);
  html.raw("\">\n<p role=\"status\"><strong data-words>")
      .text(job_state_text(job.state))
      .raw("</strong> <span data-doing>");
  html.text(job.doing).raw("</span></p>\n");
  if (!job.ended()) {
    const double share = job.state == "receiving" ? 0.0 : share_done(job.doing);
    html.raw("<progress aria-label=\"How far it is\" max=\"1\"");
    if (share >= 0.0) html.raw(" value=\"").text(number_text(share, 3)).raw("\"");
    html.raw("></progress>\n");
  }
  if (!job.said.empty()) html.raw("<pre>").text(job.said).raw("</pre>\n");
  add_results(html, job);
  if (job.state == "receiving") add_receiving(html, job);
  if (!job.ended() && job.state != "receiving")
    html.raw("<noscript><p><a href=\"/jobs/").text(job.job_id).raw("\">Look again</a></p></noscript>\n");
  html.raw("<form method=\"post\" action=\"/jobs/").text(job.job_id).raw("/cancel\">\n");
  add_form_token(html, visitor);
  html.raw("<p><button class=\"quiet\"");
  if (job.ended()) html.raw(" name=\"remove\" value=\"yes\"");  // without it, what has ended stays
  html.raw(">");
  html.text(!job.ended() ? "Cancel" : job.results.empty() ? "Remove it from the list" : "Remove it and its files");
  html.raw("</button></p>\n</form>\n</div>\n<script src=\"/jobs.js\" defer></script>\n");
  return page(job_kind_text(job.kind), visitor, html);
}

}  // namespace seldinger::reports
