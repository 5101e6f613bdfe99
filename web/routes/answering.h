// A questionnaire answered by whoever has its code: nobody is logged in. What the browser keeps is the draft's
// secret in a cookie that outlives it by a day; the token of the forms is bound to it.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "assessment/questionnaire/form.h"
#include "sim/base/result.h"
#include "web/site/http.h"

namespace seldinger::web {

class Site;
struct Call;

// What a page without a log-in and its form share, also those on which replays are rated.
// What the browser keeps under that name, or something new, so that a form has a token.
struct KeptForm {
  std::string secret;
  bool is_new = false;
};
KeptForm form_kept(Site& site, const Call& call, const std::string& cookie_name);
bool has_form_token(const Site& site, const Call& call, const std::string& kept);
// A page that may run the scripts that there are, and shows pictures that stand in it.
Response answering_response(int status, std::string body);
// What the form holds of the items that it showed.
std::map<std::string, std::string> typed_of(const Call& call,
                                            const std::vector<const assessment::questionnaire::Item*>& items);
// What does not fit its item, in words; and what does.
std::map<std::string, std::string> problems_of(const assessment::questionnaire::Form& form,
                                               const std::map<std::string, std::string>& typed);
std::map<std::string, std::string> fitting(const assessment::questionnaire::Form& form,
                                           std::map<std::string, std::string> typed);
// To the script: 204 once it is kept.
Response kept_response(const base::Result<void>& kept);

}  // namespace seldinger::web
