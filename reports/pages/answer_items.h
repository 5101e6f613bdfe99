// The items of a form on a page, as whoever answers or rates meets them.
#pragma once

#include <string>
#include <string_view>

#include "assessment/questionnaire/form.h"
#include "reports/markup/html.h"

namespace seldinger::reports {

// The field of an item in the form of a page.
std::string field_of(const assessment::questionnaire::Item& item);

// `typed`: as answer_from_text reads it. `problem`: what is wrong with it; empty: nothing.
Html answer_item(const assessment::questionnaire::Form& form, const assessment::questionnaire::Item& item,
                 const std::string& typed, const std::string& problem);

// One thing to tick.
void add_tick(Html& html, const std::string& name, const std::string& value, std::string_view mark,
              std::string_view label, bool ticked, bool quiet);
void add_problem(Html& html, std::string_view problem);  // nothing where there is none

// What of a form with `data-keeps` is kept: said by keep_typed.js, else `without_script`.
Html kept_words(std::string_view without_script);

}  // namespace seldinger::reports
