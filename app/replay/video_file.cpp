#include "app/replay/video_file.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <string>
#include <vector>

#include "sim/base/check.h"
#include "sim/base/failure.h"

extern char** environ;  // NOLINT: POSIX declares it nowhere else

namespace seldinger::app {
namespace {

[[noreturn]] void failed() {
  throw base::Failure("ffmpeg", "ffmpeg could not make the film");
}

std::string number(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

}  // namespace

VideoFile::VideoFile(const std::filesystem::path& file, int width_px, int height_px, double rate_hz) : file_(file) {
  CHECK(width_px % 2 == 0 && height_px % 2 == 0);  // of H.264's usual colours
  unfinished_ = file;
  unfinished_ += ".unfinished";
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) failed();
  const std::string size = std::to_string(width_px) + "x" + std::to_string(height_px);
  // "file:" keeps a name from being read as an option or an address.
  std::vector<std::string> words = {
      "ffmpeg",  "-hide_banner",  "-loglevel",  "error",  "-nostdin", "-y",
      "-f",      "rawvideo",      "-pix_fmt",   "rgb24",  "-s",       size,
      "-r",      number(rate_hz), "-i",         "pipe:0", "-an",      "-c:v",
      "libx264", "-preset",       "veryfast",   "-crf",   "20",       "-pix_fmt",
      "yuv420p", "-movflags",     "+faststart", "-f",     "mp4",      "file:" + unfinished_.string()};
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[0], STDIN_FILENO);
  const int error = ::posix_spawnp(&child_, "ffmpeg", &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  ::close(ends[0]);
  pipe_ = ends[1];
  if (error == 0) return;
  child_ = -1;
  ::close(pipe_);
  throw base::Failure("ffmpeg",
                      "a film needs the program ffmpeg, which is not installed: install it (Debian: apt-get "
                      "install ffmpeg), or give a folder for frames");
}

VideoFile::~VideoFile() {
  wait_for_end();
  std::error_code ignored;
  if (!unfinished_.empty()) std::filesystem::remove(unfinished_, ignored);
}

void VideoFile::wait_for_end() {
  if (pipe_ >= 0) ::close(pipe_);
  pipe_ = -1;
  if (child_ > 0)
    while (::waitpid(child_, &status_, 0) < 0 && errno == EINTR) {
    }
  child_ = -1;
}

// A child that is gone makes write() answer EPIPE: main() ignores SIGPIPE.
void VideoFile::add(std::span<const unsigned char> rgb) {
  while (!rgb.empty()) {
    const ssize_t written = ::write(pipe_, rgb.data(), rgb.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) failed();
    rgb = rgb.subspan(static_cast<std::size_t>(written));
  }
}

void VideoFile::keep() {
  wait_for_end();
  if (!WIFEXITED(status_) || WEXITSTATUS(status_) != 0) failed();
  std::error_code error;
  std::filesystem::rename(unfinished_, file_, error);
  if (error) throw base::Failure("disk", "a file cannot be renamed: " + error.message());
  unfinished_.clear();
}

}  // namespace seldinger::app
