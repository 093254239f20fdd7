#include "sweep/child.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <malloc.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <system_error>

namespace froude::sweep {
namespace {

[[noreturn]] void fail(const char* what) { throw std::system_error(errno, std::generic_category(), what); }

/// False at the end of the other side.
bool write_all(int to, const void* from, std::size_t size) {
  for (const char* at = static_cast<const char*>(from); size > 0;) {
    const ssize_t sent = ::send(to, at, size, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) return false;
    at += sent;
    size -= static_cast<std::size_t>(sent);
  }
  return true;
}

/// Writable memory of this process that is its own, heaps and all.
double data_bytes() {
  std::array<double, 6> pages{};
  std::ifstream in("/proc/self/statm");
  for (double& p : pages) in >> p;
  return pages[5] * static_cast<double>(::sysconf(_SC_PAGESIZE));
}

/// In the process: nothing of its parent is left open but the socket, by which it ends when the parent has gone.
int settle(int socket, pid_t parent, std::optional<double> memory_bytes) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(0);
  // Whoever interrupts the sweep interrupts all of its processes at once; the parent ends this one.
  for (const int number : {SIGINT, SIGTERM}) std::signal(number, SIG_IGN);
  constexpr int kept = 3;
  ::dup2(socket, kept);
  ::close_range(kept + 1, ~0U, 0);
  const rlimit none{0, 0};
  ::setrlimit(RLIMIT_CORE, &none);
  if (memory_bytes) {
    ::malloc_trim(0);  // room that the heap has beforehand is no memory of a case
    const auto most = static_cast<rlim_t>(data_bytes() + *memory_bytes);
    const rlimit data{most, most};
    ::setrlimit(RLIMIT_DATA, &data);
  }
  return kept;
}

[[noreturn]] void serve(int socket, const std::function<std::string(std::size_t)>& answer) {
  std::uint64_t number = 0;
  while (::recv(socket, &number, sizeof number, MSG_WAITALL) == sizeof number) {
    const std::string text = answer(number);
    const std::uint64_t size = text.size();
    if (!write_all(socket, &size, sizeof size) || !write_all(socket, text.data(), text.size())) break;
  }
  ::_exit(0);
}

}  // namespace

Child::Child(const std::function<std::string(std::size_t)>& answer, std::optional<double> memory_bytes) {
  std::array<int, 2> sockets{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, sockets.data()) != 0)
    fail("no socket to a process of cases");
  const pid_t parent = ::getpid();
  process_ = ::fork();
  if (process_ == 0) serve(settle(sockets[1], parent, memory_bytes), answer);
  ::close(sockets[1]);
  socket_ = sockets[0];
  if (process_ < 0) {
    ::close(socket_);
    fail("no process to answer cases in");
  }
}

Child::~Child() {
  ::close(socket_);
  if (process_ < 0) return;
  ::kill(process_, SIGKILL);
  while (::waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

void Child::give(std::size_t number) {
  const std::uint64_t sent = number;
  number_ = number;
  given_ = Clock::now();
  ++cases_;
  write_all(socket_, &sent, sizeof sent);  // one that has ended is found to have by answered()
}

std::optional<std::string> Child::answered() {
  std::array<char, 65536> buffer;
  const ssize_t got = ::recv(socket_, buffer.data(), buffer.size(), MSG_DONTWAIT);
  if (got < 0 && (errno == EAGAIN || errno == EINTR)) return std::nullopt;
  if (got <= 0) ended();
  received_.append(buffer.data(), static_cast<std::size_t>(got));
  std::uint64_t size = 0;
  if (received_.size() < sizeof size) return std::nullopt;
  std::memcpy(&size, received_.data(), sizeof size);
  if (received_.size() < sizeof size + size) return std::nullopt;
  std::string out = received_.substr(sizeof size);
  received_.clear();
  number_.reset();
  return out;
}

void Child::ended() {
  int status = 0;
  while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
  if (!WIFSIGNALED(status))
    throw Ended(fmt::format("the process that answered it ended with status {}", WEXITSTATUS(status)));
  const int number = WTERMSIG(status);
  throw Ended(fmt::format("the process that answered it was ended by signal {} ({}{})", number, ::strsignal(number),
                          number == SIGKILL ? ", as systems do that run out of memory" : ""));
}

}  // namespace froude::sweep
