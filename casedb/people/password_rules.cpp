#include "casedb/people/password_rules.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <vector>

#include "sim/base/ascii.h"

namespace seldinger::casedb {
namespace {

// Our own list: what stands for "a password" or for the door itself in the languages around us, seasons and days,
// names and teams that people take, and what a training centre for needle puncture calls its things. Years, digits
// and signs around them, and 0 for o, need no rows.
constexpr std::string_view kCommonWords[] = {
    "password",    "passwort",   "passwd",     "passphrase",  "kennwort",      "pass",       "secret",
    "geheim",      "letmein",    "login",      "logon",       "welcome",       "willkommen", "bienvenue",
    "hello",       "hallo",      "changeme",   "default",     "test",          "testing",    "guest",
    "gast",        "user",       "username",   "admin",       "administrator", "root",       "master",
    "computer",    "internet",   "server",     "access",      "trustno",       "iloveyou",   "love",
    "princess",    "sunshine",   "dragon",     "monkey",      "football",      "fussball",   "soccer",
    "baseball",    "shadow",     "superman",   "batman",      "starwars",      "pokemon",    "spring",
    "summer",      "autumn",     "fall",       "winter",      "fruehling",     "sommer",     "herbst",
    "monday",      "tuesday",    "wednesday",  "thursday",    "friday",        "saturday",   "sunday",
    "montag",      "january",    "february",   "march",       "april",         "june",       "july",
    "august",      "september",  "october",    "november",    "december",      "hospital",   "klinik",
    "clinic",      "doctor",     "nurse",      "patient",     "radiology",     "radiologie", "surgery",
    "anaesthesia", "anesthesia", "ultrasound", "fluoroscopy", "xray",          "needle",     "puncture",
    "biopsy",      "medicine",   "medical",    "training",    "trainee",       "trainer",    "mentor",
    "researcher",  "research",   "director",   "student",     "teacher",       "simulator",  "seldinger",
    "university",  "school",     "station",    "library",     "qazwsx",        "1qaz",       "2wsx",
    "3edc",        "zaq1",       "xsw2",       "1q2w",        "3e4r",          "5t6y",       "q1w2",
    "e3r4",
};

// Rows of keyboards (US, German, French), the alphabet and the digits; runs go either way.
constexpr std::string_view kRuns[] = {
    "qwertyuiop", "qwertzuiop", "azertyuiop", "asdfghjkl",  "qsdfghjklm",
    "zxcvbnm",    "yxcvbnm",    "1234567890", "0123456789", "abcdefghijklmnopqrstuvwxyz"};

constexpr std::size_t kLeastRun = 3, kMostDigits = 4, kLongestUnit = 4;
constexpr int kGuessablePieces = 3;

bool is_digit(char c) noexcept {
  return c >= '0' && c <= '9';
}

// Bytes beyond ASCII are letters of somebody's.
bool is_sign(char c) noexcept {
  const auto byte = static_cast<unsigned char>(c);
  return byte < 0x80 && !is_digit(c) && !(c >= 'a' && c <= 'z') && !base::is_capital(c);
}

// A letter, or what is typed for it.
bool stands_for(char typed, char letter) noexcept {
  constexpr std::pair<char, std::string_view> kTypedFor[] = {{'a', "4@"}, {'b', "8"},  {'e', "3"},
                                                             {'g', "9"},  {'i', "1!"}, {'l', "1"},
                                                             {'o', "0"},  {'s', "5$"}, {'t', "7"}};
  if (typed == letter) return true;
  for (const auto& [meant, others] : kTypedFor)
    if (meant == letter && others.find(typed) != std::string_view::npos) return true;
  return false;
}

std::size_t word_at(std::string_view text, std::string_view word) {
  if (text.size() < word.size()) return 0;
  return std::equal(word.begin(), word.end(), text.begin(),
                    [](char letter, char c) { return stands_for(c, letter); })
             ? word.size()
             : 0;
}

// How long `text` begins with neighbours of a row, or with one character again and again; 0: less than kLeastRun.
std::size_t run_at(std::string_view text) {
  std::size_t longest = std::min(text.find_first_not_of(text.front()), text.size());
  for (const std::string_view row : kRuns)
    for (const int way : {1, -1}) {
      std::size_t length = 0;
      auto at = static_cast<std::ptrdiff_t>(row.find(text.front()));
      if (at < 0) continue;
      for (; length < text.size() && at >= 0 && at < static_cast<std::ptrdiff_t>(row.size()); ++length, at += way)
        if (row[static_cast<std::size_t>(at)] != text[length]) break;
      longest = std::max(longest, length);
    }
  return longest >= kLeastRun ? longest : 0;
}

// The name as it is, and its parts of three letters or more: "Jane Doe", "Jane", "Doe".
std::vector<std::string> words_of(std::string_view login_name) {
  std::vector<std::string> words;
  const std::string name = base::lower(login_name) + ' ';
  for (std::size_t from = 0, at = 0; at < name.size(); ++at)
    if (is_sign(name[at])) {
      if (at - from >= 3) words.push_back(name.substr(from, at - from));
      from = at + 1;
    }
  return words;
}

// The fewest guessable pieces that make all of it up; a great number: something else is left.
int pieces_of(const std::string& password, const std::vector<std::string>& own_words) {
  constexpr int kNever = std::numeric_limits<int>::max() / 2;
  std::vector<int> pieces(password.size() + 1, kNever);  // of what lies before
  pieces[0] = 0;
  for (std::size_t at = 0; at < password.size(); ++at) {
    const std::string_view rest = std::string_view(password).substr(at);
    const auto take = [&](std::size_t length, int more) {
      if (length > 0) pieces[at + length] = std::min(pieces[at + length], pieces[at] + more);
    };
    if (is_sign(rest.front())) take(1, 0);
    for (const std::string_view word : kCommonWords) take(word_at(rest, word), 1);
    for (const std::string& word : own_words) take(word_at(rest, word), 1);
    for (std::size_t length = run_at(rest); length >= kLeastRun; --length) take(length, 1);
    for (std::size_t length = 1; length <= std::min(kMostDigits, rest.size()) && is_digit(rest[length - 1]);
         ++length)
      take(length, 1);
  }
  return pieces.back();
}

// "abcabcabc": one unit of a few characters.
bool repeats(std::string_view text) {
  for (std::size_t unit = 1; unit <= kLongestUnit && 2 * unit <= text.size(); ++unit)
    if (text.substr(unit) == text.substr(0, text.size() - unit)) return true;
  return false;
}

}  // namespace

base::Result<void> check_password(std::string_view password, std::string_view login_name) {
  const auto characters = std::count_if(password.begin(), password.end(),
                                        [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; });
  if (static_cast<std::size_t>(characters) < kLeastPasswordCharacters || password.size() > kMostPasswordBytes)
    return base::Error{"weak_password", "a password has at least 8 characters and at most 128 bytes"};
  const std::string small = base::lower(password);
  if (repeats(small))
    return base::Error{"weak_password",
                       "a few characters again and again are guessed first: choose another password"};
  if (pieces_of(small, words_of(login_name)) <= kGuessablePieces)
    return base::Error{
        "weak_password",
        "a password of common words, the user's name, rows of keys and a few digits is guessed first: "
        "choose another, such as four unrelated words"};
  return {};
}

}  // namespace seldinger::casedb
