#include "reports/pages/people/stations_page.h"

#include <algorithm>
#include <array>

#include "reports/charts/bar_chart.h"
#include "reports/charts/series_chart.h"
#include "reports/words/metric_words.h"
#include "sim/base/check.h"

namespace seldinger::reports {
namespace {

constexpr double kSecondsOfHour = 3600.0;
// The ends of the classes; beyond the last is one more.
constexpr std::array<double, 7> kLatenessEnds_us = {10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0};
constexpr std::array<double, 5> kFrameEnds_hz = {15.0, 24.0, 30.0, 45.0, 58.0};

template <std::size_t ends>
std::vector<TimingShare> classes_of(const std::array<double, ends>& limits) {
  std::vector<TimingShare> classes;
  std::string from;
  for (const double limit : limits) {
    const std::string to = number_text(limit, 0);
    classes.push_back({from.empty() ? "under " + to : from + "–" + to, 0.0});
    from = to;
  }
  classes.push_back({from + " and more", 0.0});
  return classes;
}

Html shares_chart(const std::string& said, const std::string& x_label, const std::vector<TimingShare>& shares) {
  BarChart chart{said, x_label, {}};
  for (const TimingShare& one : shares) chart.bars.push_back({one.label, one.share});
  return bar_chart(chart);
}

std::string us_text(std::uint64_t ns) {
  return number_text(static_cast<double>(ns) / 1000.0, ns < 100'000 ? 1 : 0) + " µs";
}

std::string middle_text(const std::vector<double>& values, int digits, const char* unit) {
  return values.empty() ? "—" : number_text(middle_of(values), digits) + unit;
}

std::string use_text(const casedb::StationUse& one) {
  return station_text(one.station) + (one.simulated ? ", simulated" : "");
}

void add_use_row(Html& html, const casedb::StationUse& one) {
  std::vector<double> durations_s, distances_mm;
  std::size_t hits = 0, with_hit = 0;  // as the cohorts count them: of those that came to an endpoint
  for (const casedb::StationResult& result : one.results) {
    durations_s.push_back(result.duration_s);
    if (result.target_mm) distances_mm.push_back(*result.target_mm);
    with_hit += result.hit ? 1U : 0U;
    hits += result.hit.value_or(false) ? 1U : 0U;
  }
  html.raw("<tr><th scope=\"row\">").name(station_text(one.station));
  if (one.simulated) html.raw(" <span class=\"mark\">simulated</span>");
  html.raw("</th><td class=\"number\" data-label=\"Hours\">").text(number_text(one.duration_s / kSecondsOfHour, 1));
  html.raw("</td><td class=\"number\" data-label=\"Attempts\">").text(std::to_string(one.attempts));
  html.raw("</td><td class=\"number\" data-label=\"People\">").text(std::to_string(one.people));
  html.raw("</td><td class=\"number\" data-label=\"Days used\">").text(std::to_string(one.days));
  html.raw("</td><td data-label=\"Last used\">").text(utc_text(one.last_us).substr(0, 10));
  html.raw("</td><td class=\"number\" data-label=\"Median time\">").text(middle_text(durations_s, 0, " s"));
  html.raw("</td><td class=\"number\" data-label=\"Median distance\">").text(middle_text(distances_mm, 1, " mm"));
  html.raw("</td><td class=\"number\" data-label=\"Hits\">");
  html.text(with_hit == 0 ? "—" : std::to_string(hits) + " of " + std::to_string(with_hit)).raw("</td></tr>\n");
}

void add_speed(Html& html, const casedb::StationUse& one) {
  SeriesChart chart;
  chart.said = "Distance from endpoint to target centre against time at " + use_text(one) +
               ": one point an attempt, hollow where it missed";
  chart.x_label = "Time of the attempt, s";
  chart.y_label = "Distance, mm";
  chart.y_low = 0.0;
  chart.measured_x = true;
  for (const casedb::StationResult& result : one.results)
    if (result.target_mm)
      chart.points.push_back({result.duration_s, *result.target_mm, result.hit.value_or(false)});
  std::sort(chart.points.begin(), chart.points.end(),
            [](const SeriesPoint& a, const SeriesPoint& b) { return a.x < b.x; });
  html.raw("<h3>").name(use_text(one)).raw("</h3>\n");
  if (chart.points.empty())
    html.raw("<p>None of its attempts reached an end at which a distance is measured.</p>\n");
  else
    html.add(series_chart(chart));
}

void add_pictures(Html& html, const casedb::StationTiming& one) {
  html.raw(
      "<div class=\"wide\">\n<table class=\"list\">\n<caption>Speed against accuracy: how the guidance's pictures "
      "were "
      "made, and "
      "how many were shown</caption>\n<thead><tr><th scope=\"col\">Pictures by</th><th "
      "scope=\"col\">Accuracy</th><th "
      "scope=\"col\" class=\"number\">Shown, median</th></tr></thead>\n<tbody>\n");
  for (const casedb::StationTiming::Pictures& pictures : one.pictures) {
    html.raw("<tr><th scope=\"row\">").text(pictures.method).raw("</th><td data-label=\"Accuracy\">");
    html.text(pictures.simplified ? "simplified: the machine was too slow" : "as asked");
    html.raw("</td><td class=\"number\" data-label=\"Shown, median\">");
    html.text(middle_text(pictures.shown_hz, 1, " Hz")).raw("</td></tr>\n");
  }
  html.raw("</tbody>\n</table>\n</div>\n");
}

void add_timing(Html& html, const casedb::StationTiming& one) {
  const std::string name = station_text(one.station);
  html.raw("<h2>").name(name).raw("</h2>\n");
  const double due = static_cast<double>(one.ticks + one.missed);
  html.raw("<h3>Servo</h3>\n<dl class=\"definitions\">\n<dt>Ticks missed</dt><dd>");
  html.text(share_text(due > 0.0 ? static_cast<double>(one.missed) / due : 0.0));
  html.raw("</dd>\n<dt>Begun late by</dt><dd>").text(us_text(one.latency.quantile_ns(0.5)) + " (median), ");
  html.text(us_text(one.latency.quantile_ns(0.99)) + " (99 %), " + us_text(one.latency.most_ns) + " (longest)");
  html.raw("</dd>\n<dt>Work of a tick</dt><dd>").text(us_text(one.compute.quantile_ns(0.5)) + " (median), ");
  html.text(us_text(one.compute.quantile_ns(0.99)) + " (99 %)");
  html.raw("</dd>\n<dt>Scheduler</dt><dd>")
      .text(one.real_time ? "real time (SCHED_FIFO)"
                          : "ordinary: `seldinger doctor` says how to give it real time");
  html.raw("</dd>\n</dl>\n");
  html.add(shares_chart("How late the servo's ticks began at " + name + ", as shares of all ticks",
                        "Late by, µs (a tick is due every 1000 µs)", lateness_shares(one.latency)));
  html.raw("<h3>Screen</h3>\n");
  if (one.window_hz.empty())
    html.raw("<p>No attempt in the window is recorded here.</p>\n");
  else
    html.add(shares_chart("Frames a second of the window at " + name + ", as shares of attempts",
                          "Frames a second, mean of an attempt", frame_shares(one.window_hz)));
  if (!one.pictures.empty()) add_pictures(html, one);
}

}  // namespace

std::string station_text(const std::string& station) {
  return station.empty() ? "not recorded" : station;
}

double middle_of(std::vector<double> values) {
  CHECK(!values.empty());
  std::sort(values.begin(), values.end());
  const std::size_t upper = values.size() / 2;
  return values.size() % 2 == 1 ? values[upper] : 0.5 * (values[upper - 1] + values[upper]);
}

std::vector<TimingShare> lateness_shares(const cases::TimeHistogram& latency) {
  std::vector<TimingShare> shares = classes_of(kLatenessEnds_us);
  for (std::size_t bin = 0; bin < cases::TimeHistogram::kBins; ++bin) {
    const double longest_us = static_cast<double>(cases::longest_of_time_bin_ns(bin)) / 1000.0;
    const auto at = std::upper_bound(kLatenessEnds_us.begin(), kLatenessEnds_us.end(), longest_us);
    if (latency.n > 0)
      shares[static_cast<std::size_t>(at - kLatenessEnds_us.begin())].share +=
          static_cast<double>(latency.counts[bin]) / static_cast<double>(latency.n);
  }
  return shares;
}

std::vector<TimingShare> frame_shares(std::span<const double> window_hz) {
  std::vector<TimingShare> shares = classes_of(kFrameEnds_hz);
  for (const double rate : window_hz) {
    const auto at = std::upper_bound(kFrameEnds_hz.begin(), kFrameEnds_hz.end(), rate);
    shares[static_cast<std::size_t>(at - kFrameEnds_hz.begin())].share +=
        1.0 / static_cast<double>(window_hz.size());
  }
  return shares;
}

std::string stations_page(const Visitor& visitor, std::span<const casedb::StationUse> stations) {
  Html html;
  html.raw(
      "<h1>Stations</h1>\n<p class=\"sub\">What your programmes did at each workstation. Each has the name given "
      "when the trainer was started there (<code>seldinger train --station-name NAME</code>).</p>\n");
  if (stations.empty()) {
    html.raw("<p>Nobody in your programmes has made an attempt yet.</p>\n");
    return page("Stations", visitor, html);
  }
  html.raw(
          "<div class=\"wide\">\n<table class=\"list\">\n<caption>Hours, attempts and people; medians and hits are "
          "for the newest attempts, at most ")
      .text(std::to_string(casedb::kStationResults));
  if (std::any_of(stations.begin(), stations.end(), [](const casedb::StationUse& one) { return one.simulated; }))
    html.raw("; simulated attempts are in rows of their own");
  html.raw(
      "</caption>\n<thead><tr><th scope=\"col\">Station</th><th scope=\"col\" class=\"number\">Hours</th><th "
      "scope=\"col\" "
      "class=\"number\">Attempts</th><th scope=\"col\" class=\"number\">People</th><th scope=\"col\" "
      "class=\"number\">Days "
      "used</th><th scope=\"col\">Last used</th><th scope=\"col\" class=\"number\">Median time</th><th "
      "scope=\"col\" "
      "class=\"number\">Median distance</th><th scope=\"col\" class=\"number\">Hits</th></tr></thead>\n<tbody>\n");
  for (const casedb::StationUse& one : stations) add_use_row(html, one);
  html.raw(
      "</tbody>\n</table>\n</div>\n<h2>Speed against accuracy</h2>\n<p>From the endpoint (the tip; with a core "
      "needle the "
      "middle of its notch) to the target's centre, against how long the attempt took. Hollow points "
      "missed.</p>\n");
  for (const casedb::StationUse& one : stations) add_speed(html, one);
  return list_page("Stations", visitor, html);
}

std::string station_timing_page(const Visitor& visitor, std::span<const casedb::StationTiming> stations) {
  Html html;
  html.raw(
          "<h1>Stations</h1>\n<p class=\"sub\">How well each workstation keeps time, over its newest attempts in "
          "real "
          "time, at "
          "most ")
      .text(std::to_string(casedb::kStationResults))
      .raw(".</p>\n");
  if (stations.empty()) html.raw("<p>No attempt in real time has been made yet.</p>\n");
  for (const casedb::StationTiming& one : stations) add_timing(html, one);
  return list_page("Stations", visitor, html);
}

}  // namespace seldinger::reports
