// HTML text that cannot forget to escape: markup comes from string literals only, everything else goes through
// text().
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace seldinger::reports {

// Escapes for element content and quoted attributes. Invalid UTF-8, control characters and bidirectional controls
// (which can make a name read as another) become U+FFFD.
std::string escaped(std::string_view text);

class Html {
 public:
  // Markup. Only literals bind here, so no outside text can.
  template <std::size_t N>
  Html& raw(const char (&literal)[N]) {
    text_.append(literal, N - 1);
    return *this;
  }
  // Content or the inside of a quoted attribute.
  Html& text(std::string_view text) {
    text_ += escaped(text);
    return *this;
  }
  // Names and titles that people wrote: kept apart from the direction of the text around them.
  Html& name(std::string_view text) { return raw("<bdi>").text(text).raw("</bdi>"); }
  Html& add(const Html& other) {
    text_ += other.text_;
    return *this;
  }
  bool empty() const noexcept { return text_.empty(); }
  const std::string& str() const noexcept { return text_; }

 private:
  std::string text_;
};

}  // namespace seldinger::reports
