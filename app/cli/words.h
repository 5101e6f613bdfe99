// What somebody typed, as messages show it and as it may have been meant.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/base/result.h"

namespace seldinger::app {

// In quotes, on one line and without what a terminal would obey; the first 200 bytes of it.
std::string shown(std::string_view typed);

// The one of `known` that is meant by a mistyped word: a swap, loss, surplus or change of few letters (Damerau's
// distance of at most a third of its length, in the form of optimal string alignment), or its only continuation.
// None where two are as near.
std::optional<std::string> nearest(std::string_view typed, std::span<const std::string> known);
// "; did you mean NAME?", or nothing.
std::string did_you_mean(std::string_view typed, std::span<const std::string> known);

// "a, b or c".
std::string one_of(std::span<const std::string> words);

// An error of what was typed: "--ct "neck": there is no such file". `what` is an option, or a word's name in the
// synopsis.
base::Error error_of(const std::string& what, std::string_view typed, base::Error error);

}  // namespace seldinger::app
