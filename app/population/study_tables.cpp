#include "app/population/study_tables.h"

#include <charconv>
#include <string>

#include "app/cli/file.h"

namespace seldinger::app {
namespace {

namespace population = assessment::population;

// As short as it reads back.
std::string digits(double value) {
  char text[40];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

std::string cell_text(std::string_view words) {
  std::string text = "\"";
  for (const char letter : words) text += letter == '"' ? std::string("\"\"") : std::string(1, letter);
  return text + '"';
}

std::string people_csv(const population::SimulatedStudy& study) {
  std::string text = "synthetic,person,group,site,device,years_in_radiology";
  for (const auto& [ability, name] : population::kAbilityNames) text += ",true_" + std::string(name);
  text += ",true_strategy\n";
  for (const population::StudiedPerson& one : study.people) {
    text += "1," + one.name + "," + cell_text(one.group) + "," + std::to_string(one.site) + "," +
            std::to_string(one.device) + "," + digits(one.person.years);
    for (const double ability : one.person.ability) text += "," + digits(ability);
    text += "," + digits(one.person.strategy) + "\n";
  }
  return text;
}

std::string metrics_csv(const population::SimulatedStudy& study) {
  std::string text = "synthetic,person,group,visit_day,device_lost,metric,version,value\n";
  for (const auto& person : study.data)
    for (const auto& attempt : person.attempts)
      for (const assessment::MetricValue& one : attempt.metrics)
        text += "1," + person.name + "," + cell_text(person.group) + "," + digits(attempt.day) + "," +
                (attempt.cut_off.empty() ? "0" : "1") + "," + one.id + "," + std::to_string(one.version) + "," +
                (one.value ? digits(*one.value) : "") + "\n";
  return text;
}

std::string ratings_csv(const population::SimulatedStudy& study) {
  std::string text = "synthetic,person,visit,rater,item,points\n";
  for (const population::Rating& one : study.ratings)
    text += "1," + one.person + "," + std::to_string(one.visit + 1) + "," + std::to_string(one.rater) + "," +
            cell_text(population::rated_items()[one.item].name) + "," + std::to_string(one.points) + "\n";
  return text;
}

std::string answers_csv(const population::SimulatedStudy& study) {
  std::string text = "synthetic,person,group,statement,points\n";
  for (const population::StudiedPerson& one : study.people)
    for (std::size_t s = 0; s < population::statements().size(); ++s)
      text += "1," + one.name + "," + cell_text(one.group) + "," + cell_text(population::statements()[s].words) +
              "," + std::to_string(population::answer_of(one.person, s)) + "\n";
  return text;
}

}  // namespace

base::Result<void> write_study(const std::filesystem::path& folder, const population::SimulatedStudy& study) {
  std::error_code failed;
  if (std::filesystem::exists(folder, failed))
    return base::Error{"exists", "there is already something of that name"};
  std::filesystem::create_directories(folder);
  write_file(folder / "people.csv", people_csv(study));
  write_file(folder / "metrics.csv", metrics_csv(study));
  write_file(folder / "ratings.csv", ratings_csv(study));
  write_file(folder / "answers.csv", answers_csv(study));
  return {};
}

}  // namespace seldinger::app
