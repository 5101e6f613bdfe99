// haptics stability: does what the hand feels come to rest?
#include <cstdio>

#include "app/cli/command.h"
#include "app/measure/stability/cmd_stability.h"
#include "app/measure/stability/stability_answer.h"

namespace seldinger::measure {

int run_haptics_stability(const app::Arguments& arguments) {
  const StabilitySurvey survey = survey_stability();
  std::fputs((arguments.has("--json") ? json_of_stability(survey) : markdown_of_stability(survey)).c_str(), stdout);
  return survey.holds() ? app::kDone : app::kCheckFailed;
}

}  // namespace seldinger::measure
