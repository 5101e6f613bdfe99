#include "reports/words/people_words.h"

namespace seldinger::reports {

std::string and_simulated_text(int simulated) {
  return simulated == 0 ? std::string() : " and " + std::to_string(simulated) + " simulated";
}

std::string consent_text(const casedb::Study& study) {
  return std::to_string(study.consenting) +
         (study.consenting == 1 && study.simulated == 0 ? " consents" : " consent") +
         and_simulated_text(study.simulated);
}

std::string with_outcome_text(int people, bool simulated_study) {
  return std::to_string(people) + (simulated_study ? " simulated" : "") +
         (people == 1 ? " person with an outcome" : " people with an outcome");
}

}  // namespace seldinger::reports
