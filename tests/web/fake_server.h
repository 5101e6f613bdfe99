// A server over the library in memory, on a free port of the loopback.
#pragma once

#include <memory>
#include <mutex>
#include <string>

#include "tests/web/fake_site.h"
#include "web/server.h"

namespace seldinger::web {

struct FakeLog {
  std::mutex mutex;
  std::string text;
};

// `log` may be null.
inline Surroundings plain_surroundings(std::shared_ptr<FakeLog> log = nullptr) {
  Surroundings surroundings;
  surroundings.now_us = surroundings.utc_us = [] { return std::int64_t{1}; };
  surroundings.random_id = [count = std::make_shared<std::atomic<int>>()] {
    return fake_hash(std::to_string(++*count));
  };
  surroundings.sha256_hex = fake_hash;
  surroundings.log = [log](const std::string& line) {
    if (!log) return;
    const std::lock_guard lock(log->mutex);
    log->text += line + "\n";
  };
  surroundings.program_version = "1.2.3";
  return surroundings;
}

inline base::Result<Server> open_fake(const ServeOptions& options, FakeQuestions** questions = nullptr,
                                      std::shared_ptr<FakeLog> log = nullptr) {
  auto fake = std::make_unique<FakeQuestions>();
  fill(*fake);
  if (questions != nullptr) *questions = fake.get();
  return Server::open(std::move(fake), plain_surroundings(std::move(log)), options);
}

struct FakeServer {
  FakeQuestions* questions = nullptr;
  std::shared_ptr<FakeLog> log = std::make_shared<FakeLog>();
  Server server = std::move(open_fake({"127.0.0.1", 0}, &questions, log).value());
  std::string log_text() {
    const std::lock_guard lock(log->mutex);
    return log->text;
  }
};

}  // namespace seldinger::web
