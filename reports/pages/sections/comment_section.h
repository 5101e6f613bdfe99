// What mentors say of moments of an attempt, and, for who may, the form to say something.
#pragma once

#include <string>
#include <vector>

#include "reports/markup/html.h"
#include "reports/words/attempt_words.h"

namespace seldinger::reports {

// `form_token`: of who may write here; empty: nobody may. Nothing at all where there is no comment and no form.
Html comment_section(const AttemptView& attempt, const std::string& form_token);

}  // namespace seldinger::reports
