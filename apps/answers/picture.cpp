#include "answers/picture.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "hydro/base/error.hpp"
#include "hydro/io/atomic_file.hpp"

namespace froude::plot {
namespace {

namespace fs = std::filesystem;
using hydro::InputError;

constexpr const char* converter = "rsvg-convert";

enum class Format { svg, png, pdf };

Format format_of(const fs::path& file) {
  const fs::path ending = file.extension();
  if (ending.empty() || ending == ".svg") return Format::svg;
  if (ending == ".png") return Format::png;
  if (ending == ".pdf") return Format::pdf;
  throw InputError(fmt::format("a picture is SVG, PNG or PDF, so its file cannot end in \"{}\"", ending.string()),
                   {.file = file.string()}, "end it in .svg, .png or .pdf");
}

void require_memory(bool there_is) {
  if (!there_is)
    throw InputError(fmt::format("a picture finds no memory: {}", std::strerror(errno)), {}, "end its name in .svg");
}

/// A file in memory, which no name leads to.
class Memory {
 public:
  Memory() : descriptor_(memfd_create("froude-picture", MFD_CLOEXEC)) { require_memory(descriptor_ >= 0); }
  ~Memory() { close(descriptor_); }
  Memory(const Memory&) = delete;
  Memory& operator=(const Memory&) = delete;

  int descriptor() const { return descriptor_; }
  void fill(const std::string& text) {
    for (std::size_t at = 0; at < text.size();) {
      const ssize_t written = write(descriptor_, text.data() + at, text.size() - at);
      if (written < 0 && errno == EINTR) continue;
      require_memory(written > 0);
      at += static_cast<std::size_t>(written);
    }
    lseek(descriptor_, 0, SEEK_SET);
  }
  std::string text() const {
    std::string out;
    std::array<char, 1 << 16> part;
    lseek(descriptor_, 0, SEEK_SET);
    for (ssize_t n = 0; (n = read(descriptor_, part.data(), part.size())) != 0;) {
      if (n < 0 && errno == EINTR) continue;
      require_memory(n > 0);
      out.append(part.data(), static_cast<std::size_t>(n));
    }
    return out;
  }

 private:
  int descriptor_;
};

/// Exit status of `rsvg-convert ARGUMENTS < in > out 2> said`, 127 where there is no such program.
int convert(const std::vector<std::string>& arguments, const Memory& in, const Memory& out, const Memory& said) {
  std::vector<char*> words{const_cast<char*>(converter)};  // posix_spawn takes them as they were before const
  for (const std::string& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
  words.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, in.descriptor(), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, out.descriptor(), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, said.descriptor(), STDERR_FILENO);
  pid_t child = 0;
  const int failed = posix_spawnp(&child, converter, &actions, nullptr, words.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  constexpr int not_found = 127;
  if (failed != 0) return not_found;
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

void require_converter(const fs::path& file) {
  const Memory nothing, out, said;
  if (convert({"--version"}, nothing, out, said) != 0)
    throw InputError(fmt::format("PNG and PDF are made by the program {}, which is not here", converter),
                     {.file = file.string()}, "install librsvg2-bin, or end the name in .svg");
}

std::string converted(const fs::path& file, const std::string& svg, Format format) {
  Memory in, out, said;
  in.fill(svg);
  std::vector<std::string> arguments{"--format", "png", "--zoom", "2", "--background-color", "white"};
  if (format == Format::pdf) arguments = {"--format", "pdf"};
  if (const int status = convert(arguments, in, out, said); status != 0)
    throw InputError(fmt::format("{} made no picture, exit status {}: {}", converter, status, said.text()),
                     {.file = file.string()}, "end the name in .svg");
  return out.text();
}

}  // namespace

void require_picture(const fs::path& file) {
  if (format_of(file) != Format::svg) require_converter(file);
}

void write_picture(const fs::path& file, const Figure& figure) { write_svg(file, svg(figure)); }

void write_svg(const fs::path& file, const std::string& drawn) {
  const Format format = format_of(file);
  hydro::io::write_atomically(file, format == Format::svg ? drawn : converted(file, drawn, format));
}

}  // namespace froude::plot
