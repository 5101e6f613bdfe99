#include "app/window/surface/screen_words.h"

#include <imgui.h>
#include <imgui_internal.h>
#include <stdlib.h>

#include <cstdio>
#include <iostream>
#include <sstream>

#include "sim/base/check.h"
#include "sim/base/failure.h"

namespace seldinger::app {
namespace {

// What Dear ImGui logs of its widgets goes into a file in memory, which outlives the windows of a frame.
struct Gathered {
  bool wanted = false;
  FILE* file = nullptr;
  char* text = nullptr;
  std::size_t size = 0;
};

Gathered& gathered() {
  static Gathered all;
  return all;
}

std::string trimmed(const std::string& line) {
  constexpr const char* kBlank = " \t\r";
  const std::size_t first = line.find_first_not_of(kBlank);
  if (first == std::string::npos) return "";
  return line.substr(first, line.find_last_not_of(kBlank) - first + 1);
}

}  // namespace

void want_words(bool wanted) {
  gathered().wanted = wanted;
}

void gather_words() {
  Gathered& all = gathered();
  ImGuiContext& g = *ImGui::GetCurrentContext();
  if (!all.wanted || g.LogEnabled) return;
  if (all.file == nullptr) {
    all.file = open_memstream(&all.text, &all.size);
    CHECK(all.file != nullptr);
  }
  ImGui::LogToBuffer();
  g.LogFile = all.file;
}

void say_words(const std::string& line) {
  if (gathered().wanted && ImGui::GetCurrentContext()->LogEnabled) ImGui::LogText("\n%s\n", line.c_str());
}

std::string take_words() {
  Gathered& all = gathered();
  if (all.file == nullptr) return "";
  ImGui::GetCurrentContext()->LogFile = nullptr;
  fclose(all.file);
  std::string words(all.text, all.size);
  free(all.text);  // NOLINT: as open_memstream has it
  all = {};
  return words;
}

ScreenWords::ScreenWords(const std::filesystem::path& path) {
  if (path.empty()) return;
  if (path == "-") {
    out_ = &std::cout;
    return;
  }
  file_.open(path, std::ios::binary | std::ios::trunc);
  if (!file_) throw base::Failure("disk", "the words cannot be written");
  out_ = &file_;
}

void ScreenWords::write(const std::string& screen, const std::string& words, const std::string& focus) {
  if (out_ == nullptr || (screen == screen_ && words == words_ && focus == focus_)) return;
  const bool another = screen != screen_;
  if (another) *out_ << "\n## " << screen << "\n";
  std::set<std::string> lines;
  std::istringstream from(words);
  for (std::string line; std::getline(from, line);) {
    line = trimmed(line);
    if (line.empty()) continue;
    if (another || !lines_.contains(line)) *out_ << line << "\n";
    lines.insert(std::move(line));
  }
  if ((another || focus != focus_) && !focus.empty()) *out_ << "> " << focus << "\n";
  out_->flush();
  screen_ = screen;
  words_ = words;
  focus_ = focus;
  lines_ = std::move(lines);
}

}  // namespace seldinger::app
