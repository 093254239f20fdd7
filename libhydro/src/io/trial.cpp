#include "hydro/io/trial.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <exception>
#include <fstream>
#include <string_view>
#include <system_error>

#include "hydro/base/error.hpp"

namespace hydro::io {
namespace {

/// In the child: says nothing, leaves no core, and ends whatever happens.
[[noreturn]] void read_and_end(const TrialLimits& limits, const std::function<void()>& read) {
  for (const int ends : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGXCPU, SIGALRM}) std::signal(ends, SIG_DFL);
  if (const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC); nowhere >= 0) {
    ::dup2(nowhere, STDOUT_FILENO);
    ::dup2(nowhere, STDERR_FILENO);
  }
  const rlimit none{0, 0}, time{limits.processor, limits.processor + 1};
  ::setrlimit(RLIMIT_CORE, &none);
  ::setrlimit(RLIMIT_CPU, &time);
  ::alarm(limits.clock);
  try {
    read();
  } catch (...) {  // told where the caller reads
    ::_exit(0);
  }
  ::_exit(0);
}

/// The child's status at its end.
int status_of_child(const std::filesystem::path& file, const TrialLimits& limits, const std::function<void()>& read) {
  const pid_t child = ::fork();
  if (child < 0)
    throw std::system_error(errno, std::generic_category(), "no process to read " + file.string() + " in first");
  if (child == 0) read_and_end(limits, read);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0)
    if (errno != EINTR) throw std::system_error(errno, std::generic_category(), "waiting for a reader");
  return status;
}

bool ended_by(int status, int signal) { return WIFSIGNALED(status) && WTERMSIG(status) == signal; }

}  // namespace

TrialLimits limits_of(const std::filesystem::path& file) {
  constexpr std::uintmax_t start = 2, bytes_a_second = 10'000'000;
  std::error_code unknown;
  const std::uintmax_t size = std::filesystem::file_size(file, unknown);
  const auto processor = static_cast<unsigned>(start + (unknown ? 0 : size / bytes_a_second));
  return {processor, 10 * processor + 10};
}

void try_in_child(const std::filesystem::path& file, const std::function<void()>& read, const TrialLimits& limits) {
  // A child that was born while another thread was inside HDF5 has its lock, and nobody who opens it: it waits without
  // working. Another one hardly meets the same.
  constexpr int tries = 3;
  int status = status_of_child(file, limits, read);
  for (int i = 1; i < tries && ended_by(status, SIGALRM); ++i) status = status_of_child(file, limits, read);
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  const bool endless = ended_by(status, SIGXCPU) || ended_by(status, SIGALRM);
  throw InputError(endless
                       ? fmt::format("the file is damaged: the library that reads it was not done after {} s of work",
                                     limits.processor)
                       : "the file is damaged: the library that reads it does not survive it",
                   {.file = file.string()}, "write it again or fetch it once more");
}

bool is_hdf5(const std::filesystem::path& file) {
  constexpr std::string_view magic = "\x89HDF\r\n\x1a\n";
  std::array<char, magic.size()> head{};
  std::ifstream in(file, std::ios::binary);
  in.read(head.data(), head.size());
  return in && std::string_view(head.data(), head.size()) == magic;
}

}  // namespace hydro::io
