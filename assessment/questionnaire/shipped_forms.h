// The forms that come with the program: the questionnaires of the thesis' three workshops (Vidal, appendix C), the
// first mended as its table 6.1 tells, and a global rating scale and a checklist for raters (Martin, 1997).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "assessment/questionnaire/form.h"

namespace seldinger::assessment::questionnaire {

struct ShippedForm {
  std::string_view json;
  Form form;
};
const std::vector<ShippedForm>& shipped_forms();  // by their ids
// nullptr: there is none.
const ShippedForm* find_shipped_form(std::string_view form_id);

}  // namespace seldinger::assessment::questionnaire
