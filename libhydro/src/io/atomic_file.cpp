#include "hydro/io/atomic_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
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

fs::path temporary_name(const fs::path& path) { return path.string() + fmt::format(".{}.froude.tmp", ::getpid()); }

/// An open file that is closed and removed unless it was renamed into place.
class TemporaryFile {
 public:
  explicit TemporaryFile(const fs::path& target) : target_(target), name_(temporary_name(target)) {
    if (fs::is_directory(target_)) refuse(target_, "write", EISDIR);
    file_ = ::open(name_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
    if (file_ < 0) refuse(target_, "write", errno);
  }
  ~TemporaryFile() {
    if (file_ >= 0) ::close(file_);
    if (!kept_) ::unlink(name_.c_str());
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  void write(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
      const ssize_t n = ::write(file_, bytes.data(), bytes.size());
      if (n < 0 && errno == EINTR) continue;
      if (n < 0) refuse(target_, "write", errno);
      bytes = bytes.subspan(static_cast<std::size_t>(n));
    }
  }
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
  TemporaryFile file(path);
  file.write(bytes);
  file.keep();
}

void write_atomically(const fs::path& path, std::string_view text) {
  write_atomically(path, std::as_bytes(std::span(text.data(), text.size())));
}

void require_writable(const fs::path& path) { TemporaryFile probe(path); }

std::string read_text(const fs::path& path) {
  if (fs::is_directory(path)) refuse(path, "read", EISDIR);
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  if (!in)
    throw InputError(fmt::format("cannot read \"{}\": {}", path.string(), reason(errno ? errno : EIO)), {},
                     "check the path; paths in a scene are relative to the scene file");
  std::ostringstream out;
  out << in.rdbuf();
  return std::move(out).str();
}

}  // namespace hydro::io
