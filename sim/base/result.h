// Result<T>: a value, or why outside data (file, tag, JSON, request, device) is refused. g++ 12 has no
// std::expected in C++20; the member names are the same, so that it can take over.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "sim/base/check.h"

namespace seldinger::base {

// One problem. `code` is stable snake_case; `text` says what and where in words and never holds patient data,
// attribute values or file names (a slice is named by its number).
struct Problem {
  std::string code;
  std::string text;
};

// Why something is refused: the first line a user reads, and every further finding.
struct Error {
  std::string code;
  std::string text;
  std::vector<Problem> findings{};
};

template <typename T>
class [[nodiscard]] Result {
 public:
  Result(T value) : content_(std::in_place_index<0>, std::move(value)) {}  // NOLINT: implicit like std::expected
  Result(Error error) : content_(std::in_place_index<1>, std::move(error)) {}  // NOLINT

  bool has_value() const noexcept { return content_.index() == 0; }
  explicit operator bool() const noexcept { return has_value(); }
  T& value() {
    CHECK(has_value());
    return std::get<0>(content_);
  }
  const T& value() const {
    CHECK(has_value());
    return std::get<0>(content_);
  }
  T& operator*() { return value(); }
  const T& operator*() const { return value(); }
  T* operator->() { return &value(); }
  const T* operator->() const { return &value(); }
  const Error& error() const {
    CHECK(!has_value());
    return std::get<1>(content_);
  }

 private:
  std::variant<T, Error> content_;
};

template <>
class [[nodiscard]] Result<void> {
 public:
  Result() = default;
  Result(Error error) : error_(std::move(error)) {}  // NOLINT

  bool has_value() const noexcept { return !error_.has_value(); }
  explicit operator bool() const noexcept { return has_value(); }
  const Error& error() const {
    CHECK(error_.has_value());
    return *error_;
  }

 private:
  std::optional<Error> error_;
};

}  // namespace seldinger::base
