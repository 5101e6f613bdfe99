// A questionnaire answered by whoever has its code: nobody is logged in. What the browser keeps is the draft's
// secret in a cookie that outlives it by a day; the token of the forms is bound to it.
#pragma once

#include "web/http.h"

namespace seldinger::web {

class Site;
struct Call;

Response show_answer_start(Site& site, const Call& call);
Response begin_answers(Site& site, const Call& call);
Response show_answer_section(Site& site, const Call& call);
Response keep_answers(Site& site, const Call& call);
Response show_answer_thanks(Site& site, const Call& call);

}  // namespace seldinger::web
