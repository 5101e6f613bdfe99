#include "web/site/http.h"

#include <arpa/inet.h>

#include <array>

#include "casedb/database/credentials.h"
#include "sim/base/check.h"

namespace seldinger::web {
namespace {

std::string_view status_text(int status) {
  switch (status) {
    case 200:
      return "OK";
    case 204:
      return "No Content";
    case 303:
      return "See Other";
    case 304:
      return "Not Modified";
    case 400:
      return "Bad Request";
    case 401:
      return "Unauthorized";
    case 403:
      return "Forbidden";
    case 404:
      return "Not Found";
    case 405:
      return "Method Not Allowed";
    case 409:
      return "Conflict";
    case 408:
      return "Request Timeout";
    case 411:
      return "Length Required";
    case 413:
      return "Content Too Large";
    case 414:
      return "URI Too Long";
    case 415:
      return "Unsupported Media Type";
    case 417:
      return "Expectation Failed";
    case 421:
      return "Misdirected Request";
    case 429:
      return "Too Many Requests";
    case 431:
      return "Request Header Fields Too Large";
    case 500:
      return "Internal Server Error";
    case 503:
      return "Service Unavailable";
    case 505:
      return "HTTP Version Not Supported";
    default:
      return "Other";
  }
}

bool is_header_text(std::string_view text) {
  return text.find_first_of(std::string_view("\r\n\0", 3)) == text.npos;
}

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

std::optional<std::string> form_decoded(std::string_view encoded) {
  std::string out;
  out.reserve(encoded.size());  // a password leaves no pieces behind
  for (std::size_t i = 0; i < encoded.size(); ++i) {
    if (encoded[i] == '+') {
      out += ' ';
    } else if (encoded[i] == '%') {
      if (i + 2 >= encoded.size()) return std::nullopt;
      const int high = hex_digit(encoded[i + 1]), low = hex_digit(encoded[i + 2]);
      if (high < 0 || low < 0 || (high == 0 && low == 0)) return std::nullopt;
      out += static_cast<char>(high * 16 + low);
      i += 2;
    } else {
      out += encoded[i];
    }
  }
  return out;
}

}  // namespace

std::string Request::header(const std::string& lower_case_name) const {
  const auto found = headers.find(lower_case_name);
  return found == headers.end() ? "" : found->second;
}

Response html_response(int status, std::string body) {
  return {.status = status, .body = std::move(body)};
}

Response list_response(std::string body) {
  Response response = html_response(200, std::move(body));
  response.policy = Policy::list;
  return response;
}

Response json_response(std::string body) {
  return {.content_type = "application/json", .body = std::move(body)};
}

Response redirect(std::string_view path) {
  return {.status = 303, .headers = {{"Location", std::string(path)}}};
}

void wipe(std::map<std::string, std::string>& form) noexcept {
  for (auto& [name, value] : form) casedb::wipe(value);
}
void wipe(Request& request) noexcept {
  casedb::wipe(request.body);
  wipe(request.headers);
}
void wipe(Response& response) noexcept {
  casedb::wipe(response.body);
  for (auto& [name, value] : response.headers) casedb::wipe(value);
}

const std::vector<std::pair<std::string_view, std::string_view>>& security_headers(Policy policy) {
  using Headers = std::vector<std::pair<std::string_view, std::string_view>>;
  static const auto with = [](std::string_view content, std::string_view cache = "no-store") -> Headers {
    return {{"Content-Security-Policy", content},
            {"X-Content-Type-Options", "nosniff"},
            {"X-Frame-Options", "DENY"},
            {"Referrer-Policy", "no-referrer"},
            {"Cache-Control", cache},
            {"Cross-Origin-Opener-Policy", "same-origin"},
            {"Cross-Origin-Resource-Policy", "same-origin"}};
  };
  static const Headers page = with(
      "default-src 'none'; style-src 'self'; img-src 'self'; form-action 'self'; base-uri 'none'; "
      "frame-ancestors 'none'");
  static const Headers list = with(
      "default-src 'none'; style-src 'self'; img-src 'self'; script-src 'self'; form-action 'self'; base-uri "
      "'none'; "
      "frame-ancestors 'none'");
  static const Headers answering = with(
      "default-src 'none'; style-src 'self'; img-src 'self' data:; script-src 'self'; connect-src 'self'; "
      "form-action 'self'; base-uri 'none'; frame-ancestors 'none'");
  static const Headers replay = with(
      "default-src 'none'; style-src 'self'; img-src 'self'; script-src 'self'; connect-src 'self'; "
      "form-action 'self'; base-uri 'none'; frame-ancestors 'none'");
  static const Headers picture = with("default-src 'none'; frame-ancestors 'none'", "private, no-cache");
  switch (policy) {
    case Policy::picture:
      return picture;
    case Policy::list:
      return list;
    case Policy::replay:
      return replay;
    case Policy::answering:
      return answering;
    case Policy::page:
      break;
  }
  return page;
}

std::string bytes_of(const Response& response, bool with_body) {
  std::size_t size = 1024 + (with_body ? response.body.size() : 0);  // 1024: the first line and the headers of all
  for (const auto& [name, value] : response.headers) size += name.size() + value.size() + 4;
  std::string out;
  out.reserve(size);
  out += "HTTP/1.1 " + std::to_string(response.status) + " ";
  out += status_text(response.status);
  out += "\r\n";
  const auto add = [&](std::string_view name, std::string_view value) {
    CHECK(is_header_text(name) && is_header_text(value));
    out.append(name).append(": ").append(value).append("\r\n");
  };
  for (const auto& [name, value] : security_headers(response.policy)) add(name, value);
  for (const auto& [name, value] : response.headers) add(name, value);
  if (!response.body.empty()) add("Content-Type", response.content_type);
  if (response.status != 304) add("Content-Length", std::to_string(response.body.size()));  // else of what is kept
  add("Connection", "close");
  out += "\r\n";
  if (with_body) out += response.body;
  return out;
}

std::optional<std::map<std::string, std::string>> form_fields(std::string_view encoded) {
  std::map<std::string, std::string> fields;
  while (!encoded.empty()) {
    const std::string_view pair = encoded.substr(0, encoded.find('&'));
    encoded.remove_prefix(std::min(encoded.size(), pair.size() + 1));
    if (pair.empty()) continue;
    const std::size_t equals = pair.find('=');
    auto name = form_decoded(pair.substr(0, equals));
    auto value = form_decoded(equals == pair.npos ? "" : pair.substr(equals + 1));
    if (!name.has_value() || !value.has_value() || !fields.emplace(std::move(*name), std::move(*value)).second) {
      wipe(fields);
      return std::nullopt;
    }
    casedb::wipe(*value);  // a short one was copied, not moved
  }
  return fields;
}

std::string cookie(const Request& request, std::string_view name) {
  const auto all = request.headers.find("cookie");
  std::string_view rest = all == request.headers.end() ? std::string_view() : all->second;
  std::string found;
  bool seen = false;
  while (!rest.empty()) {
    std::string_view pair = rest.substr(0, rest.find(';'));
    rest.remove_prefix(std::min(rest.size(), pair.size() + 1));
    while (!pair.empty() && pair.front() == ' ') pair.remove_prefix(1);
    if (pair.size() <= name.size() || pair.substr(0, name.size()) != name || pair[name.size()] != '=') continue;
    if (seen) return "";
    seen = true;
    found = pair.substr(name.size() + 1);
  }
  return found;
}

bool is_loopback_address(std::string_view address) {
  if (address == "localhost") return true;
  const std::string text(address);
  in_addr v4{};
  if (inet_pton(AF_INET, text.c_str(), &v4) == 1)
    return text.find('\0') == text.npos && (ntohl(v4.s_addr) >> 24) == 127;
  return text == "::1";
}

bool is_loopback_host_header(std::string_view value) {
  std::string_view port;
  if (!value.empty() && value.front() == '[') {
    const std::size_t end = value.find(']');
    if (end == value.npos) return false;
    port = value.substr(end + 1);
    value = value.substr(1, end - 1);
    if (value != "::1") return false;
  } else {
    const std::size_t colon = value.find(':');
    port = colon == value.npos ? "" : value.substr(colon);
    value = value.substr(0, colon);
  }
  const bool port_is_sound = port.empty() || (port.size() >= 2 && port.size() <= 6 && port.front() == ':' &&
                                              port.find_first_not_of("0123456789", 1) == port.npos);
  return port_is_sound && is_loopback_address(value);
}

bool is_same_origin(const Request& request, std::string_view public_authority) {
  const std::string origin = request.header("origin");
  const std::string site = request.header("sec-fetch-site");
  const std::string host = request.header("host");
  const bool proxied = !public_authority.empty() && host == public_authority;
  const bool origin_fits = origin == (proxied ? "https://" : "http://") + host;
  if (!origin.empty() && origin != "null" && !origin_fits) return false;
  return site.empty() ? origin_fits : site == "same-origin";
}

std::optional<std::string> authority_of_https(std::string_view origin) {
  constexpr std::string_view kScheme = "https://";
  if (!origin.starts_with(kScheme)) return std::nullopt;
  const std::string_view authority = origin.substr(kScheme.size());
  const std::size_t colon = std::min(authority.find(':'), authority.size());
  const std::string_view name = authority.substr(0, colon), port = authority.substr(colon);
  constexpr std::string_view kOfName = "abcdefghijklmnopqrstuvwxyz0123456789-.";
  const bool name_fits = !name.empty() && name.size() <= 253 && name.find_first_not_of(kOfName) == name.npos &&
                         name.front() != '.' && name.front() != '-';
  const bool port_fits = port.empty() || (port.size() >= 2 && port.size() <= 6 &&
                                          port.find_first_not_of("0123456789", 1) == port.npos);
  if (!name_fits || !port_fits) return std::nullopt;
  return std::string(authority);
}

std::string asker_of(const Request& request, std::string_view public_authority) {
  if (public_authority.empty()) return request.from;
  std::string all = request.header("x-forwarded-for");
  std::string last = all.substr(all.rfind(',') + 1);  // npos + 1: from the start
  const std::size_t from = last.find_first_not_of(' ');
  last = from == last.npos ? "" : last.substr(from, last.find_last_not_of(' ') - from + 1);
  in6_addr any{};
  if (last.find('\0') != last.npos) return request.from;
  const bool is_one = inet_pton(AF_INET, last.c_str(), &any) == 1 || inet_pton(AF_INET6, last.c_str(), &any) == 1;
  return is_one ? last : request.from;
}

bool equal_in_constant_time(std::string_view a, std::string_view b) noexcept {
  if (a.size() != b.size()) return false;
  unsigned difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    difference |= static_cast<unsigned>(static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]));
  }
  return difference == 0;
}

}  // namespace seldinger::web
