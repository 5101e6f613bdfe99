// The frame of every page: title, navigation, the training-only notice.
#pragma once

#include <string>
#include <string_view>

#include "reports/markup/html.h"
#include "sim/base/training_only.h"

namespace seldinger::reports {

using base::kTrainingOnly;

// Who looks. Empty name: nobody is logged in, so there is no navigation.
struct Visitor {
  std::string name;
  std::string role;
  std::string form_token;  // goes into every form that changes something
};

// A whole document; `content` is what stands inside <main>.
std::string page(std::string_view title, const Visitor& visitor, const Html& content);

// The same of a page of lists, which a script orders and narrows where there is one (tables.js).
std::string list_page(std::string_view title, const Visitor& visitor, const Html& content);

// A document of its own, outside the dashboard: `style` is a whole style sheet, trusted and put in as it is.
std::string page_with_style(std::string_view title, std::string_view style, const Html& content);

// Markup of ours that is kept as text stands where the page has kKeptMarkup. Text cannot hold that, as < is
// escaped.
inline constexpr const char kKeptMarkup[] = "<!-- kept -->";
std::string with_kept_markup(std::string page, const std::string& markup);

// A page that says one thing: an error, or that there is nothing to see.
std::string message_page(std::string_view title, std::string_view message, const Visitor& visitor);

}  // namespace seldinger::reports
