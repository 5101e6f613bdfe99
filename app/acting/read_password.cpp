#include "app/acting/read_password.h"

#include <termios.h>
#include <unistd.h>

#include <cstdio>
#include <iostream>

#include "app/cli/file.h"
#include "casedb/database/credentials.h"

namespace seldinger::app {

std::string read_password() {
  const bool terminal = ::isatty(STDIN_FILENO) != 0;
  termios before{};
  if (terminal) {
    std::fputs("Password: ", stderr);
    ::tcgetattr(STDIN_FILENO, &before);
    termios silent = before;
    silent.c_lflag &= ~static_cast<tcflag_t>(ECHO);
    ::tcsetattr(STDIN_FILENO, TCSAFLUSH, &silent);
  }
  std::string line;
  std::getline(std::cin, line);
  if (terminal) {
    ::tcsetattr(STDIN_FILENO, TCSAFLUSH, &before);
    std::fputs("\n", stderr);
  }
  if (!line.empty() && line.back() == '\r') line.pop_back();
  return line;
}

base::Result<std::string> read_password_of(const std::string& file) {
  if (file == "-") return read_password();
  auto text = read_text(file, 4096);
  if (!text) return text.error();
  std::string line = text->substr(0, text->find_first_of("\r\n"));
  casedb::wipe(*text);
  return line;
}

}  // namespace seldinger::app
