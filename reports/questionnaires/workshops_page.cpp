#include "reports/questionnaires/workshops_page.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <set>

#include "assessment/questionnaire/published.h"
#include "assessment/questionnaire/shipped_forms.h"
#include "reports/charts/mean_chart.h"
#include "reports/pages/page.h"
#include "reports/pages/style_sheet.h"
#include "sim/base/embedded.h"

namespace seldinger::embedded {
std::span<const base::EmbeddedFile> questionnaire_report_files();
}

namespace seldinger::reports {
namespace {

namespace questionnaire = assessment::questionnaire;
using questionnaire::Reconstruction;
using questionnaire::SummaryReading;

const SummaryReading* reading_of(std::string_view table, std::string_view item, std::string_view group) {
  for (const SummaryReading& one : questionnaire::thesis_readings())
    if (one.published.table == table && one.published.item == item && one.published.group == group) return &one;
  return nullptr;
}

std::string plain_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

std::string decimals_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3f", value);
  return text;
}

std::string list_of_n(const std::vector<std::size_t>& n) {
  std::string text;
  for (std::size_t i = 0; i < n.size();) {
    std::size_t end = i;
    while (end + 1 < n.size() && n[end + 1] == n[end] + 1) ++end;
    text += (text.empty() ? "" : ", ") + std::to_string(n[i]);
    if (end > i) text += (end > i + 1 ? "–" : ", ") + std::to_string(n[end]);
    i = end + 1;
  }
  return text;
}

// "1 ×2, 4 ×7"
std::string answers_text(const std::vector<double>& answers) {
  std::string text;
  for (std::size_t i = 0; i < answers.size();) {
    const auto same = static_cast<std::size_t>(std::count(answers.begin(), answers.end(), answers[i]));
    text += (text.empty() ? "" : ", ") + plain_number(answers[i]);
    if (same > 1) text += " ×" + std::to_string(same);
    i += same;
  }
  return text;
}

MeanMark mark_of(const SummaryReading& one) {
  return {std::stod(std::string(one.published.mean)), std::stod(std::string(one.published.sd))};
}

struct Series {
  std::string_view table, group;
  std::string name;
};

// A figure of the thesis, from the printed means and SDs.
void add_figure(Html& html, const char* number, const std::vector<Series>& series,
                const std::vector<std::string_view>& items, const std::string& caption) {
  const SummaryReading* first = reading_of(series.front().table, items.front(), series.front().group);
  const questionnaire::Form& form = questionnaire::find_shipped_form(first->published.form_id)->form;
  MeanChart chart;
  const questionnaire::Scale& scale = *form.find_scale(form.find_item(items.back())->scale);
  chart.low = scale.low();
  chart.high = scale.high();
  chart.low_label = plain_number(chart.low) + " " + scale.points.front().label;
  chart.high_label = scale.points.back().label + " " + plain_number(chart.high);
  std::string own_scale;
  if (form.find_item(items.front())->scale != scale.id) {
    const questionnaire::Scale& other = *form.find_scale(form.find_item(items.front())->scale);
    own_scale = " Question " + std::string(items.front()) + " is from “" + other.points.front().label + "” to “" +
                other.points.back().label + "”.";
  }
  for (const Series& one : series) chart.series.push_back(one.name);
  for (const std::string_view item : items) {
    MeanRow row;
    const bool both = std::any_of(series.begin(), series.end(),
                                  [&](const Series& one) { return one.table != series.front().table; });
    row.label = std::string(item) + "  " +
                (both && item == "8a" ? "CT (2006), US (2007) visual elements were of high quality"
                                      : form.find_item(item)->text);
    for (const Series& one : series) {
      const SummaryReading* reading = reading_of(one.table, item, one.group);
      row.marks.push_back(reading == nullptr ? std::nullopt : std::optional(mark_of(*reading)));
    }
    chart.rows.push_back(std::move(row));
  }
  chart.said =
      std::string("Figure ") + number + ": mean and standard deviation of each item, as the tables print them";
  html.raw("<figure class=\"of-thesis\">\n").add(mean_chart(chart)).raw("<figcaption><strong>Figure ").text(number);
  html.raw("</strong> ").text(caption + own_scale).raw("</figcaption>\n</figure>\n");
}

void add_reading(Html& html, const SummaryReading& one) {
  html.raw("<tr><th scope=\"row\">").text(one.published.item).raw("  ").text(one.item->text).raw("</th><td>");
  html.text(one.published.group).raw("</td><td class=\"number\">").text(one.published.mean).raw(" ± ");
  html.text(one.published.sd).raw("</td><td class=\"number\">").text(std::to_string(one.published.group_size));
  const bool capital = one.n_is_certain() && one.possible_n.front() == one.published.group_size;
  html.raw("</td><td class=\"number\">");
  if (one.n_is_certain() && !capital)
    html.raw("<span class=\"differs\">").text(list_of_n(one.possible_n)).raw("</span>");
  else
    html.text(one.possible_n.empty() ? "none" : list_of_n(one.possible_n));
  if (one.halves) html.raw(" <span class=\"differs\">in halves</span>");
  html.raw("</td><td>");
  if (one.reconstruction == Reconstruction::determined)
    html.raw("<span class=\"mark sure\">determined</span>");
  else if (one.sets == 1 && one.all_sets)
    html.raw("alone, if n = ").text(std::to_string(one.n));
  else if (one.reconstruction == Reconstruction::one_of_many)
    html.raw("one of ").text(std::to_string(one.sets) + (one.all_sets ? "" : " and more"));
  else
    html.raw("not reconstructed");
  html.raw("<div class=\"answers\">").text(answers_text(one.answers)).raw("</div></td><td class=\"number\">");
  if (one.mean) html.text(decimals_text(*one.mean)).raw(" ± ").text(decimals_text(*one.sd));
  html.raw("</td><td>");
  if (!one.mean)
    html.raw("–");
  else if (questionnaire::is_printed_as(*one.mean, one.published.mean) &&
           questionnaire::is_printed_as(*one.sd, one.published.sd))
    html.raw("<span class=\"yes\">yes</span>");
  else
    html.raw("<span class=\"no\">no</span>");
  html.raw("</td></tr>\n");
}

void add_table(Html& html, std::string_view table, const std::string& caption) {
  html.raw("<div class=\"wide\"><table class=\"summaries\">\n<caption>Table ").text(table).raw(". ").text(caption);
  html.raw(
      "</caption>\n<thead><tr><th>Item</th><th>Group</th><th class=\"number\">As published</th><th "
      "class=\"number\">n "
      "by caption</th><th class=\"number\">n possible</th><th>Answers</th><th class=\"number\">Recomputed</th>"
      "<th>As printed</th></tr></thead>\n<tbody>\n");
  for (const SummaryReading& one : questionnaire::thesis_readings())
    if (one.published.table == table) add_reading(html, one);
  html.raw("</tbody></table></div>\n");
}

// "table 6.2, 8e, trainees"
std::string place_of(const SummaryReading& one) {
  return "table " + std::string(one.published.table) + ", " + std::string(one.published.item) + ", " +
         std::string(one.published.group);
}

std::string printed_of(const SummaryReading& one) {
  return std::string(one.published.mean) + " ± " + std::string(one.published.sd);
}

// What the numbers alone say against captions: nothing here is typed by hand.
void add_exceptions(Html& html) {
  html.raw("<ul class=\"exceptions\">\n");
  for (const SummaryReading& one : questionnaire::thesis_readings()) {
    const std::size_t size = one.published.group_size;
    const bool fewer = !one.possible_n.empty() && one.possible_n.back() < size;
    if (!one.halves && !fewer && one.mean) continue;
    html.raw("<li><strong>").text(place_of(one)).raw("</strong>, ").text(printed_of(one)).raw(": ");
    if (one.halves)
      html.raw("no number of people up to ")
          .text(std::to_string(size))
          .raw(" has this mean and SD in whole numbers; in halves it is ")
          .text(list_of_n(one.possible_n))
          .raw(". ");
    else if (fewer)
      html.raw("not ").text(std::to_string(size)).raw(" people, but ").text(list_of_n(one.possible_n)).raw(". ");
    if (!one.mean)
      html.raw("printed to so few digits that too many sets of answers fit to look for one: not recomputed.");
    html.raw("</li>\n");
  }
  html.raw("</ul>\n");
}

void add_claim(Html& html, const char* claim, const char* year, const std::string& against) {
  html.raw("<li>“").text(claim).raw("” (").text(year).raw("): ").text(against).raw("</li>\n");
}

// Sentences of section 6.3 that its own tables do not bear; the numbers come from the tables.
void add_claims(Html& html) {
  const auto printed = [](std::string_view table, std::string_view item, std::string_view group) {
    return printed_of(*reading_of(table, item, group));
  };
  html.raw("<ul class=\"exceptions\">\n");
  add_claim(html,
            "This feature was the least disputed in both groups, indeed results from Question 8.a got the lowest "
            "standard deviation",
            "2006",
            "among trainees 8a is " + printed("6.2", "8a", "trainees") + ", 8b " +
                printed("6.2", "8b", "trainees") + " and 8d " + printed("6.2", "8d", "trainees") + ".");
  add_claim(html, "trainees rated higher the level of complexity of simulated cases than experts", "2006 and 2007",
            "8e in 2006 is " + printed("6.2", "8e", "trainees") + " of trainees and " +
                printed("6.2", "8e", "experts") + " of experts, in 2007 " + printed("6.3", "8e", "trainees") +
                " and " + printed("6.3", "8e", "experts") + "; only 8f in 2006 is higher of trainees (" +
                printed("6.2", "8f", "trainees") + ", experts " + printed("6.2", "8f", "experts") + ").");
  add_claim(html, "five experts fully confident in performing image guided needle puncture", "2007",
            "their confidence is " + printed("6.3", "5", "experts") + " of 10.");
  add_claim(html, "it was unanimously accepted that two haptic devices should be simultaneously used", "2005",
            "item 2 is " + printed("6.1", "2", "trainees") +
                " of 7, and no set of answers with that mean and SD is all agreement: each holds a “slightly "
                "disagree” or worse, or a “don't know”.");
  html.raw("</ul>\n");
}

void add_forms(Html& html) {
  for (const questionnaire::ShippedForm& one : questionnaire::shipped_forms()) {
    html.raw("<h3>").text(one.form.title).raw("</h3>\n<p class=\"sub\"><code>").text(one.form.id);
    html.raw("</code>, version ")
        .text(std::to_string(one.form.version))
        .raw(". ")
        .text(one.form.source)
        .raw("</p>\n<ul class=\"exceptions\">\n");
    for (const std::string& correction : one.form.corrections) html.raw("<li>").text(correction).raw("</li>\n");
    html.raw("</ul>\n");
  }
}

void add_figures(Html& html) {
  const std::vector<std::string_view> first{"1", "2", "3", "4", "5"};
  const std::vector<std::string_view> later{"7", "8a", "8b", "8c", "8d", "8e", "8f", "8g", "8h"};
  html.raw(
      "<section>\n<h2>Figures 6.14 to 6.18</h2>\n<p class=\"note\">Drawn from the tables as printed: a mean, and "
      "one "
      "standard deviation to either side. The thesis' own figure 6.14 shows the share of each answer in percent; "
      "those shares are in no table and are not determined by one, so means stand in their place.</p>\n");
  add_figure(html, "6.14", {{"6.1", "trainees", "trainees"}}, first,
             "Early version, 2005, twenty trainees. 4 was “don't know”, and was counted as 4.");
  html.raw("<p class=\"note\">Figure 6.15 is a photograph of the simulator.</p>\n");
  add_figure(html, "6.16", {{"6.2", "trainees", "trainees"}, {"6.2", "experts", "experts"}}, later,
             "Midterm version, 2006, nineteen trainees and three experts by the caption.");
  add_figure(html, "6.17", {{"6.3", "trainees", "trainees"}, {"6.3", "experts", "experts"}}, later,
             "Final version, 2007, ten trainees and five experts by the caption. Experts: 8f and 8g N.A.");
  add_figure(html, "6.18",
             {{"6.2", "trainees", "trainees 2006"},
              {"6.2", "experts", "experts 2006"},
              {"6.3", "trainees", "trainees 2007"},
              {"6.3", "experts", "experts 2007"}},
             later,
             "Midterm (filled) and final version (outlined) together. Not the same people, and not the same "
             "guidance: CT slices in 2006, simulated ultrasound in 2007.");
  html.raw("</section>\n");
}

}  // namespace

std::string workshops_page() {
  Html html;
  html.raw(
      "<h1>The three workshops</h1>\n<p class=\"sub\">F. P. Vidal's thesis, section 6.3: Royal Preston Hospital, "
      "July "
      "2005, 2006 and 2007. What is printed there, read again.</p>\n"
      "<p class=\"note\">These are opinions of three small groups about three early versions of another program. "
      "They "
      "say nothing of this one, and nothing of anybody's skill.</p>\n"
      "<section>\n<h2>How this was read</h2>\n<p>An item's answers are whole numbers, so a mean and a standard "
      "deviation "
      "can come from few numbers of people only (GRIM, Brown and Heathers 2017; GRIMMER, Anaya 2016). For each "
      "item "
      "every number of people up to the caption's was tried, from two on, with n − 1 in the standard deviation. "
      "Where "
      "one alone is possible it is certain as far as the printed digits are; else all that are possible are shown. "
      "Where one set of answers alone has the printed mean and SD, these are the answers: “determined”. Else one "
      "set of "
      "those that fit is shown, which is an example and not what people said. That answers of experts to 8c and 8d "
      "in 2006 range from 1 to 4 is taken from the text.</p>\n</section>\n");
  add_figures(html);
  html.raw("<section>\n<h2>Tables 6.1 to 6.3</h2>\n");
  add_table(html, "6.1", "Early version, 2005; 1 strongly disagree to 7 strongly agree, 4 don't know.");
  add_table(html, "6.2", "Midterm version, 2006. Experts' 6a and 6b: N.A.");
  add_table(html, "6.3", "Final version, 2007. Experts' 6a, 6b, 8f and 8g: N.A.");
  html.raw("</section>\n<section>\n<h2>What cannot be as the captions say</h2>\n");
  add_exceptions(html);
  html.raw("</section>\n<section>\n<h2>Where the text and the tables differ</h2>\n");
  add_claims(html);
  html.raw("</section>\n<section>\n<h2>The questionnaires</h2>\n");
  add_forms(html);
  html.raw("</section>\n");
  const std::string style = std::string(style_sheet()) +
                            std::string(base::content_of(embedded::questionnaire_report_files(), "workshops.css"));
  return page_with_style("The three workshops", style, html);
}

}  // namespace seldinger::reports
