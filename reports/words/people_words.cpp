#include "reports/words/people_words.h"

namespace seldinger::reports {

std::string and_simulated_text(int simulated) {
  return simulated == 0 ? std::string() : " and " + std::to_string(simulated) + " simulated";
}

std::string study_people_words(const casedb::StudyPeople& people) {
  if (people.simulated) return people.count == 1 ? "simulated person" : "simulated people";
  return people.count == 1 ? "consents" : "consent";
}

std::string study_people_text(const casedb::StudyPeople& people) {
  return std::to_string(people.count) + " " + study_people_words(people);
}

std::string_view whose_attempts_words(assessment::study::People people) {
  return people == assessment::study::People::real ? "of people" : "of simulated people";
}

std::string with_outcome_text(int people, bool simulated_study) {
  return std::to_string(people) + (simulated_study ? " simulated" : "") +
         (people == 1 ? " person with an outcome" : " people with an outcome");
}

}  // namespace seldinger::reports
