// The log-in form.
#pragma once

#include <string>
#include <string_view>

namespace seldinger::reports {

// `problem`: why the last try failed, empty on the first; never tells whether the name exists.
std::string login_page(std::string_view form_token, std::string_view problem);

}  // namespace seldinger::reports
