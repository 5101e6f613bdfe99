// What the pages take from the world besides the library: time, chance, a hash, a place for complaints.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace seldinger::web {

class Jobs;

struct Surroundings {
  std::function<std::int64_t()> now_us;                     // monotonic: sessions outlive no change of the clock
  std::function<std::int64_t()> utc_us;                     // since 1970: how long ago something was
  std::function<std::string()> random_id;                   // 256 random bits as 64 hex digits
  std::function<std::string(std::string_view)> sha256_hex;  // 64 hex digits
  std::function<void(const std::string&)> log;              // one line; no patient data, no names
  std::string program_version;
  // Under which name a reverse proxy that adds TLS serves these pages, "sim.example.org"; empty: there is none.
  std::string public_authority;
  std::shared_ptr<Jobs> jobs{};  // nothing: long work is not done here
  int port = 0;  // cookies know no ports: their names tell ours from another program's on this machine
};

}  // namespace seldinger::web
