// Failure: the environment is gone (disk, database, GL). Thrown, and caught in app/main.cpp (exit 4) and at the top
// of web/server.cpp (503). `what()` never holds patient data.
#pragma once

#include <stdexcept>
#include <string>

namespace seldinger::base {

class Failure : public std::runtime_error {
 public:
  Failure(std::string code, const std::string& text) : std::runtime_error(text), code_(std::move(code)) {}
  const std::string& code() const noexcept { return code_; }  // e.g. "disk", "database", "gl"

 private:
  std::string code_;
};

}  // namespace seldinger::base
