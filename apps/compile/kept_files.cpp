#include "compile/kept_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <system_error>
#include <vector>

#include "compile/archive.hpp"
#include "hydro/base/digest.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/atomic_file.hpp"

namespace froude::compile {
namespace {

namespace fs = std::filesystem;
using hydro::digest;

constexpr std::array<const char*, 2> kept_extensions{".fit", ".coefficients"};

/// What stands after the key and before the sum of all.
std::optional<std::string> answer_in(std::string_view bytes, const std::string& key) {
  std::uint64_t sum = 0;
  if (bytes.size() < sizeof sum) return std::nullopt;
  const std::string_view content = bytes.substr(0, bytes.size() - sizeof sum);
  std::memcpy(&sum, bytes.data() + content.size(), sizeof sum);
  if (sum != digest(content) || !content.starts_with(key)) return std::nullopt;
  return std::string(content.substr(key.size()));
}

}  // namespace

fs::path KeptFiles::file_of(const std::string& key, const char* extension) const {
  return folder_ / fmt::format("{:016x}{}", digest(key), extension);
}

std::optional<std::string> KeptFiles::find(const std::string& key, const char* extension) const {
  const fs::path file = file_of(key, extension);
  std::error_code none;
  if (!fs::is_regular_file(file, none)) return std::nullopt;
  try {
    auto out = answer_in(hydro::io::read_text(file), key);
    if (out) fs::last_write_time(file, fs::file_time_type::clock::now(), none);  // as if it were new
    return out;
  } catch (const hydro::InputError&) {  // another process may just have removed it
    return std::nullopt;
  }
}

void KeptFiles::keep(const std::string& key, const std::string& answer, const char* extension) const {
  ArchiveWriter out{key + answer};
  out(digest(out.bytes));
  constexpr std::uintmax_t share = 4;  // one entry shall not drive out all others
  if (out.bytes.size() > most_bytes_ / share) return;
  std::error_code failed;
  fs::create_directories(folder_, failed);
  if (failed) return;
  try {
    hydro::io::write_atomically(file_of(key, extension), out.bytes);
  } catch (const hydro::InputError&) {
    return;
  }
  make_room();
}

void KeptFiles::make_room() const {
  struct Entry {
    fs::file_time_type used;
    std::uintmax_t bytes;
    fs::path file;
  };
  std::vector<Entry> all;
  std::uintmax_t bytes = 0;
  std::error_code failed;  // of each call by itself: another process may remove files meanwhile
  for (fs::directory_iterator at(folder_, failed), end; !failed && at != end; at.increment(failed)) {
    if (std::ranges::find(kept_extensions, at->path().extension()) == kept_extensions.end()) continue;
    std::error_code gone;
    const auto used = fs::last_write_time(at->path(), gone);
    const auto size = gone ? 0 : fs::file_size(at->path(), gone);
    if (gone) continue;
    all.push_back({used, size, at->path()});
    bytes += size;
  }
  std::sort(all.begin(), all.end(), [](const Entry& a, const Entry& b) { return a.used < b.used; });
  for (auto oldest = all.begin(); oldest != all.end() && bytes > most_bytes_; ++oldest) {
    fs::remove(oldest->file, failed);
    bytes -= oldest->bytes;
  }
}

std::string maker(const char* answer, const char* sources) {
  ArchiveWriter out;
  out(fmt::format("froude {} of {}, " __VERSION__, answer, sources));
#if defined(__x86_64__)
  out(__builtin_cpu_supports("avx2") != 0);
  out(__builtin_cpu_supports("fma") != 0);
  out(__builtin_cpu_supports("avx512f") != 0);
#endif
  return std::move(out.bytes);
}

}  // namespace froude::compile
