#include "assessment/statistics/standards/cut_notes.h"

#include <string>

namespace seldinger::assessment::statistics {

void say_of_draws(Answer& answer, const Bootstrapped& drawn) {
  if (drawn.draws == 0) return;
  answer.method += "; expanded percentile bootstrap over persons";
  answer.ci95 = drawn.ci95;
  if (drawn.without > 0)
    answer.notes.push_back("In " + std::to_string(drawn.without) + " of " + std::to_string(drawn.draws) +
                           " draws of persons there is no cut" +
                           (drawn.ci95 ? "." : ": an interval would leave them out, so there is none."));
}

}  // namespace seldinger::assessment::statistics
