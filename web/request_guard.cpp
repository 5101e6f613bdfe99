#include "web/request_guard.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "sim/base/ascii.h"
#include "sim/base/check.h"

namespace seldinger::web {
namespace {

constexpr std::string_view kLineEnd = "\r\n";
constexpr std::string_view kPathCharacters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~/";
// RFC 9110: token.
constexpr std::string_view kTokenCharacters =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789!#$%&'*+-.^_`|~";

constexpr std::array<std::string_view, 9> kKept = {"host",           "x-forwarded-for", "content-type",
                                                   "content-length", "cookie",          "origin",
                                                   "sec-fetch-site", "accept",          "if-none-match"};

bool is_token(std::string_view text) {
  return !text.empty() && text.find_first_not_of(kTokenCharacters) == text.npos;
}

std::string_view next_line(std::string_view& rest) {
  const std::string_view line = rest.substr(0, rest.find(kLineEnd));
  rest.remove_prefix(std::min(rest.size(), line.size() + kLineEnd.size()));
  return line;
}

// 0 when sound, else the status of the refusal.
int parse_request_line(std::string_view line, Request& request) {
  const std::size_t first = line.find(' ');
  const std::size_t last = line.rfind(' ');
  if (first == line.npos || last == first) return 400;
  const std::string_view method = line.substr(0, first);
  const std::string_view target = line.substr(first + 1, last - first - 1);
  const std::string_view version = line.substr(last + 1);
  if (!is_token(method)) return 400;
  if (target.size() > kMaxTargetBytes) return 414;
  if (version != "HTTP/1.1" && version != "HTTP/1.0") return version.substr(0, 5) == "HTTP/" ? 505 : 400;
  const std::string_view path = target.substr(0, target.find('?'));
  // No path of ours needs an escape, so none is decoded: no NUL, no second slash in disguise.
  if (path.empty() || path.front() != '/' || path.find_first_not_of(kPathCharacters) != path.npos) return 400;
  const std::string_view query = path.size() == target.size() ? "" : target.substr(path.size() + 1);
  if (std::any_of(query.begin(), query.end(), [](char c) { return c <= ' ' || c > '~' || c == '#'; })) return 400;
  request.method = method;
  request.path = path;
  request.query = query;
  return 0;
}

int parse_header(std::string_view line, Request& request) {
  const std::size_t colon = line.find(':');
  if (colon == line.npos || !is_token(line.substr(0, colon))) return 400;  // also a folded line
  const std::string name = base::lower(line.substr(0, colon));
  std::string_view value = line.substr(colon + 1);
  const auto is_blank = [](char c) { return c == ' ' || c == '\t'; };
  while (!value.empty() && is_blank(value.front())) value.remove_prefix(1);
  while (!value.empty() && is_blank(value.back())) value.remove_suffix(1);
  for (const char c : value) {
    if ((static_cast<unsigned char>(c) < 0x20 && c != '\t') || c == 0x7F) return 400;  // NUL, bare CR or LF
  }
  if (name == "transfer-encoding") return 411;
  if (name == "content-encoding") return 415;
  if (name == "expect") return 417;
  if (std::find(kKept.begin(), kKept.end(), name) == kKept.end()) return 0;
  return request.headers.emplace(name, value).second ? 0 : 400;  // which of two should hold?
}

int find_body_size(Head& head) {
  const auto found = head.request.headers.find("content-length");
  const bool may_have_body = head.request.method == "POST";
  if (found == head.request.headers.end()) return may_have_body ? 411 : 0;
  const std::string& digits = found->second;
  if (digits.empty() || digits.find_first_not_of("0123456789") != digits.npos) return 400;
  // Nine digits cannot overflow; more are too large whatever they say.
  if (digits.size() > 9 || std::stoul(digits) > kMaxBodyBytes) return 413;
  head.body_bytes = std::stoul(digits);
  return head.body_bytes > 0 && !may_have_body ? 400 : 0;
}

}  // namespace

std::optional<std::size_t> head_size(std::string_view received) {
  const std::size_t end = received.find("\r\n\r\n");
  return end == received.npos ? std::nullopt : std::optional<std::size_t>(end + 4);
}

std::variant<Head, Refusal> parse_head(std::string_view head) {
  CHECK(head_size(head) == head.size());
  if (head.size() > kMaxHeadBytes) return Refusal{431};
  std::string_view rest = head.substr(0, head.size() - kLineEnd.size());
  Head parsed;
  if (const int status = parse_request_line(next_line(rest), parsed.request); status != 0) return Refusal{status};
  for (std::size_t count = 1; !rest.empty(); ++count) {
    if (count > kMaxHeaders) return Refusal{431};
    if (const int status = parse_header(next_line(rest), parsed.request); status != 0) return Refusal{status};
  }
  if (const int status = find_body_size(parsed); status != 0) return Refusal{status};
  return parsed;
}

}  // namespace seldinger::web
