// A request as it leaves the guard, and a response as it leaves the program. No sockets here.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace seldinger::web {

struct Request {
  std::string method;                          // GET, HEAD, POST, or any other token
  std::string path;                            // letters, digits and -._~/ only, begins with /
  std::string query;                           // after the ?, not decoded
  std::map<std::string, std::string> headers;  // names in lower case; only those the guard lets through
  std::string body;
  std::string from{};  // the address that sent it

  std::string header(const std::string& lower_case_name) const;  // empty when absent
};

// What a page may load and run: nothing but the style sheet and pictures of this server; where it is answered or
// rated also the scripts, of which one sends what is typed, and pictures that stand in the page itself; a replay's
// and a job's scripts ask this server; a list's script runs and fetches nothing. A picture may be kept by the
// browser that got it, which asks each time whether it is still the same and still theirs to see; all else is kept
// nowhere.
enum class Policy { page, list, replay, answering, picture };

struct Response {
  int status = 200;
  std::string content_type = "text/html; charset=utf-8";
  std::string body{};
  std::vector<std::pair<std::string, std::string>> headers{};
  Policy policy = Policy::page;
};

Response html_response(int status, std::string body);
Response list_response(std::string body);  // 200, of a page of lists
Response json_response(std::string body);
Response redirect(std::string_view path);  // 303: the browser asks again with GET

// Overwrites what may be secret: bodies, cookies.
void wipe(Request& request) noexcept;
void wipe(std::map<std::string, std::string>& form) noexcept;
void wipe(Response& response) noexcept;

// The headers every response carries: content security policy, no sniffing, no referrer, no framing, caching.
const std::vector<std::pair<std::string_view, std::string_view>>& security_headers(Policy policy = Policy::page);

// The response as bytes, closing the connection. A line break in a header value is a programmer's mistake.
std::string bytes_of(const Response& response, bool with_body);

// application/x-www-form-urlencoded. None when an escape is broken, a name comes twice or a value holds a NUL.
std::optional<std::map<std::string, std::string>> form_fields(std::string_view encoded);

// The value of one cookie; empty when absent or given twice.
std::string cookie(const Request& request, std::string_view name);

// "localhost", 127.0.0.0/8 or ::1, as an address or as a Host header's value ("[::1]:8080").
bool is_loopback_address(std::string_view address);
bool is_loopback_host_header(std::string_view value);

// Whether a browser sent this from a page of this server. Our own policy `no-referrer` makes browsers send
// `Origin: null` with forms, so Sec-Fetch-Site decides where it is sent; else Origin must name this very host, by
// https under the name that a reverse proxy serves (empty: there is none), by http under any other.
bool is_same_origin(const Request& request, std::string_view public_authority = {});

// "sim.example.org" of "https://sim.example.org", with a port where it has one; none: it is no such origin.
std::optional<std::string> authority_of_https(std::string_view origin);

// Who asked: the address that sent the request, or behind a proxy the one that asked that, by the last word of
// X-Forwarded-For, which the proxy itself has written.
std::string asker_of(const Request& request, std::string_view public_authority);

// Compares without telling by its time where two texts of one length differ.
bool equal_in_constant_time(std::string_view a, std::string_view b) noexcept;

}  // namespace seldinger::web
