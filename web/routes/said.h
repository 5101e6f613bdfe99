// What was said of an attempt, and how who said it is called: for whoever may read free text.
#pragma once

#include <string>
#include <vector>

#include "reports/words/attempt_words.h"
#include "web/site/site.h"

namespace seldinger::web {

std::vector<reports::CommentView> comments_of(Site& site, const std::string& attempt_id);

}  // namespace seldinger::web
