#include "hydro/io/atomic_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstring>
#include <fstream>
#include <mutex>
#include <optional>
#include <set>
#include <system_error>
#include <utility>

#include "hydro/base/error.hpp"

namespace hydro::io {
namespace {

namespace fs = std::filesystem;

std::string reason(int error) { return std::generic_category().message(error); }

[[noreturn]] void refuse(const fs::path& path, const std::string& doing, int error) {
  const std::string remedy = error == ENOENT   ? "create the folder first"
                             : error == EACCES ? "choose a folder that you may write to"
                             : error == ENOSPC || error == EFBIG || error == EDQUOT
                                 ? "free some space or write elsewhere; nothing was left behind"
                                 : "check the path";
  throw InputError(fmt::format("cannot {} \"{}\": {}", doing, path.string(), reason(error)), {}, remedy);
}

/// What names of temporary files end in: machine and process tell whether anybody still writes one.
std::string machine_mark() {
  std::array<char, 65> name{};  // Linux has 64 characters at most
  if (::gethostname(name.data(), name.size() - 1) != 0) return ".unknown.";
  return fmt::format(".{}.", name.data());
}
constexpr std::string_view temporary_ending = ".froude.tmp";
fs::path temporary_name(const fs::path& path) {
  return path.string() + fmt::format("{}{}{}", machine_mark(), ::getpid(), temporary_ending);
}

/// The process of this machine that made a temporary file of this name; 0: none did.
pid_t maker_of(std::string_view name) {
  if (!name.ends_with(temporary_ending)) return 0;
  name.remove_suffix(temporary_ending.size());
  const std::string mark = machine_mark();
  const std::size_t at = name.rfind(mark);
  if (at == std::string_view::npos) return 0;
  name.remove_prefix(at + mark.size());
  pid_t maker = 0;
  const auto [end, code] = std::from_chars(name.data(), name.data() + name.size(), maker);
  return code == std::errc{} && end == name.data() + name.size() && maker > 0 ? maker : 0;
}

/// Removes what processes left in a folder that were killed while they wrote: once a folder and process, since folders
/// may hold a million results. Files that another machine writes there, or a process that lives, are left alone.
void sweep_once(const fs::path& folder) {
  static std::mutex only_one;
  static std::set<fs::path> swept;
  const std::scoped_lock lock(only_one);
  if (!swept.insert(folder).second) return;
  std::error_code failed;
  for (fs::directory_iterator at(folder, failed), end; !failed && at != end; at.increment(failed)) {
    const std::string name = at->path().filename().string();
    const pid_t maker = maker_of(name);
    if (maker != 0 && ::kill(maker, 0) != 0 && errno == ESRCH) ::unlink(at->path().c_str());
  }
}

/// Where the bytes for a path go.
struct Target {
  fs::path path;           ///< a link is followed: it stays, and the file that it points to is replaced
  bool is_stream = false;  ///< a device, a FIFO or an open file: written into, since it cannot be replaced
  int descriptor = -1;     ///< of the open file, if it is one of ours: /dev/stdout, /proc/self/fd/3
};

/// The number N of "/proc/…/fd/N". A file opened by this name would be written from its start, over what stands there.
std::optional<int> descriptor_of(const fs::path& path) {
  std::error_code unknown;
  if (fs::canonical(path.parent_path(), unknown) != fs::canonical("/proc/self/fd", unknown) || unknown)
    return std::nullopt;
  const std::string name = path.filename().string();
  int number = 0;
  const auto [end, code] = std::from_chars(name.data(), name.data() + name.size(), number);
  if (code != std::errc{} || end != name.data() + name.size()) return std::nullopt;
  return number;
}

Target target_of(const fs::path& path) {
  std::error_code unknown;
  if (fs::is_directory(path, unknown)) refuse(path, "write", EISDIR);
  fs::path at = path;
  constexpr int most_links = 40;  // as the kernel follows
  for (int links = 0; links <= most_links; ++links) {
    if (const auto number = descriptor_of(at)) return {path, true, *number};
    if (!fs::is_symlink(at, unknown)) return {at, fs::exists(at, unknown) && !fs::is_regular_file(at, unknown)};
    at = at.parent_path() / fs::read_symlink(at);
  }
  refuse(path, "write", ELOOP);
}

void write_all(int file, const fs::path& named, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(file, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) refuse(named, "write", errno);
    bytes = bytes.subspan(static_cast<std::size_t>(n));
  }
}

void write_stream(const Target& target, std::span<const std::byte> bytes) {
  const int file = target.descriptor >= 0 ? ::fcntl(target.descriptor, F_DUPFD_CLOEXEC, 0)
                                          : ::open(target.path.c_str(), O_WRONLY | O_CLOEXEC);
  if (file < 0) refuse(target.path, "write", errno);
  try {
    write_all(file, target.path, bytes);
  } catch (...) {
    ::close(file);
    throw;
  }
  if (::close(file) != 0) refuse(target.path, "write", errno);
}

/// An open file that is closed and removed unless it was renamed into place.
class TemporaryFile {
 public:
  explicit TemporaryFile(const fs::path& target) : target_(target), name_(temporary_name(target)) {
    sweep_once(fs::absolute(target).parent_path());
    file_ = ::open(name_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
    if (file_ < 0) refuse(target_, "write", errno);
  }
  ~TemporaryFile() {
    if (file_ >= 0) ::close(file_);
    if (!kept_) ::unlink(name_.c_str());
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  void write(std::span<const std::byte> bytes) { write_all(file_, target_, bytes); }
  void keep() {
    if (::fsync(file_) != 0) refuse(target_, "write", errno);
    if (::close(std::exchange(file_, -1)) != 0) refuse(target_, "write", errno);
    if (::rename(name_.c_str(), target_.c_str()) != 0) refuse(target_, "write", errno);
    kept_ = true;
  }

 private:
  fs::path target_, name_;
  int file_ = -1;
  bool kept_ = false;
};

}  // namespace

void write_atomically(const fs::path& path, std::span<const std::byte> bytes) {
  const Target target = target_of(path);
  if (target.is_stream) return write_stream(target, bytes);
  TemporaryFile file(target.path);
  file.write(bytes);
  file.keep();
}

void write_atomically(const fs::path& path, std::string_view text) {
  write_atomically(path, std::as_bytes(std::span(text.data(), text.size())));
}

void require_writable(const fs::path& path) {
  const Target target = target_of(path);
  if (!target.is_stream) {
    TemporaryFile probe(target.path);
    return;
  }
  // A FIFO must not be opened before there is something to write: that waits for its reader.
  if (target.descriptor < 0 && ::access(target.path.c_str(), W_OK) != 0) refuse(path, "write", errno);
}

bool same_file(const fs::path& a, const fs::path& b) {
  std::error_code unknown;
  const auto file_of = [](const fs::path& path) -> std::optional<fs::path> {
    const Target target = target_of(path);
    return target.is_stream ? std::nullopt : std::optional(target.path);
  };
  if (fs::is_directory(a, unknown) || fs::is_directory(b, unknown)) return false;
  const auto first = file_of(a), second = file_of(b);
  if (!first || !second) return false;
  if (fs::exists(*first, unknown) && fs::exists(*second, unknown)) return fs::equivalent(*first, *second, unknown);
  // A name that does not exist yet stays relative in weakly_canonical(), where its folder is not named.
  return fs::weakly_canonical(fs::absolute(*first), unknown) == fs::weakly_canonical(fs::absolute(*second), unknown);
}

std::string read_text(const fs::path& path) {
  if (fs::is_directory(path)) refuse(path, "read", EISDIR);
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  if (!in)
    throw InputError(fmt::format("cannot read \"{}\": {}", path.string(), reason(errno ? errno : EIO)), {},
                     "check the path; paths in a scene are relative to the scene file");
  // Of a file at once, with no room that grows beside it; what has no size, such as a FIFO, grows as it comes.
  std::string out;
  std::error_code none;
  if (fs::is_regular_file(path, none)) out.reserve(fs::file_size(path, none) + 1);
  constexpr std::size_t part = std::size_t{1} << 16U;
  std::size_t size = 0;
  do {
    out.resize(out.capacity() > size ? out.capacity() : size + part);
    in.read(out.data() + size, static_cast<std::streamsize>(out.size() - size));
    size += static_cast<std::size_t>(in.gcount());
  } while (in);
  out.resize(size);
  return out;
}

}  // namespace hydro::io
