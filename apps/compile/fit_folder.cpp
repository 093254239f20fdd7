#include "compile/fit_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <mutex>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <utility>
#include <vector>

#include "fit_sources.hpp"
#include "hydro/base/digest.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/atomic_file.hpp"

namespace froude::compile {
namespace {

namespace fs = std::filesystem;
using hydro::digest;
using hydro::radiation::FitReport;
using hydro::radiation::Pole;
using hydro::radiation::RationalFit;

constexpr const char* extension = ".fit";

/// Puts values into bytes, as this machine has them.
class Writer {
 public:
  template <class T>
  void operator()(const T& value) requires std::is_arithmetic_v<T> {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void operator()(const std::string& text) {
    (*this)(text.size());
    bytes += text;
  }
  void operator()(const Eigen::MatrixXd& m) {
    (*this)(m.rows());
    (*this)(m.cols());
    bytes.append(reinterpret_cast<const char*>(m.data()), sizeof(double) * static_cast<std::size_t>(m.size()));
  }
  template <class T>
  void operator()(const std::vector<T>& all) {
    (*this)(all.size());
    for (const T& one : all) (*this)(one);
  }
  void operator()(const Pole& pole) {
    (*this)(pole.decay);
    (*this)(pole.omega);
  }
  std::string bytes;
};

/// Takes them out again. \throws std::length_error where they end before
class Reader {
 public:
  explicit Reader(std::string_view bytes) : bytes_(bytes) {}
  template <class T>
  void operator()(T& value) requires std::is_arithmetic_v<T> {
    std::memcpy(&value, take(1, sizeof value), sizeof value);
  }
  void operator()(std::string& text) {
    const auto size = number<std::size_t>();
    text.assign(take(size, 1), size);
  }
  void operator()(Eigen::MatrixXd& m) {
    const auto rows = number<Eigen::Index>(), cols = number<Eigen::Index>();
    constexpr Eigen::Index largest = 1 << 20;
    if (rows < 0 || cols < 0 || rows > largest || cols > largest) throw std::length_error("no matrix is so large");
    const char* from = take(static_cast<std::size_t>(rows * cols), sizeof(double));
    m.resize(rows, cols);
    if (m.size() > 0) std::memcpy(m.data(), from, sizeof(double) * static_cast<std::size_t>(m.size()));
  }
  template <class T>
  void operator()(std::vector<T>& all) {
    const auto size = number<std::size_t>();
    if (size > bytes_.size()) throw std::length_error("a list is longer than its file");
    all.resize(size);
    for (T& one : all) (*this)(one);
  }
  void operator()(Pole& pole) {
    (*this)(pole.decay);
    (*this)(pole.omega);
  }
  bool at_end() const { return bytes_.empty(); }

 private:
  template <class T>
  T number() {
    T out{};
    (*this)(out);
    return out;
  }
  const char* take(std::size_t count, std::size_t size) {
    if (count > bytes_.size() / size) throw std::length_error("a file ends before its numbers");
    const char* out = bytes_.data();
    bytes_.remove_prefix(count * size);
    return out;
  }
  std::string_view bytes_;
};

/// All of a fit, for a Writer or a Reader. What is added to a fit belongs here, too.
template <class Archive, class Fit>
void pass(Archive& archive, Fit& fit) {
  auto& [model, A_inf, report] = fit;
  auto& [poles, C, S] = model;
  archive(poles);
  archive(C);
  archive(S);
  archive(A_inf);
  auto& [order, error, error_per_pair, error_before, passive, margin, most_negative, lift, shift, negative_share, why] =
      report;
  archive(order);
  archive(error);
  archive(error_per_pair);
  archive(error_before);
  archive(passive);
  archive(margin);
  archive(most_negative);
  archive(lift);
  archive(shift);
  archive(negative_share);
  archive(why);
}

/// What decides on every bit of a fit: sources, compiler, the instructions that kernels choose from, and the data.
std::string key_of(const SymmetricData& data, double tolerance) {
  Writer out;
  out(std::string("froude radiation fit of " FROUDE_FIT_SOURCES ", " __VERSION__));
#if defined(__x86_64__)
  out(__builtin_cpu_supports("avx2") != 0);
  out(__builtin_cpu_supports("fma") != 0);
  out(__builtin_cpu_supports("avx512f") != 0);
#endif
  out(tolerance);
  out(data.damping.omega);
  out(data.damping.B);
  out(data.A);
  out(data.A_inf.has_value());
  if (data.A_inf) out(*data.A_inf);
  return std::move(out.bytes);
}

std::optional<RationalFit> fit_in(std::string_view bytes, const std::string& key) {
  std::uint64_t sum = 0;
  if (bytes.size() < sizeof sum) return std::nullopt;
  const std::string_view content = bytes.substr(0, bytes.size() - sizeof sum);
  std::memcpy(&sum, bytes.data() + content.size(), sizeof sum);
  if (sum != digest(content) || !content.starts_with(key)) return std::nullopt;
  Reader reader(content.substr(key.size()));
  RationalFit out;
  pass(reader, out);
  if (!reader.at_end()) return std::nullopt;
  return out;
}

}  // namespace

fs::path FitFolder::file_of(const std::string& key) const {
  return folder_ / fmt::format("{:016x}{}", digest(key), extension);
}

std::optional<RationalFit> FitFolder::find(const SymmetricData& data, double tolerance) const {
  const std::string key = key_of(data, tolerance);
  const fs::path file = file_of(key);
  std::error_code none;
  if (!fs::is_regular_file(file, none)) return std::nullopt;
  try {
    auto out = fit_in(hydro::io::read_text(file), key);
    if (out) fs::last_write_time(file, fs::file_time_type::clock::now(), none);  // as if it were new
    return out;
  } catch (const hydro::InputError&) {  // another process may just have removed it
  } catch (const std::length_error&) {
  }
  return std::nullopt;
}

void FitFolder::keep(const SymmetricData& data, double tolerance, const RationalFit& fit) const {
  Writer out{key_of(data, tolerance)};
  const fs::path file = file_of(out.bytes);
  pass(out, fit);
  out(digest(out.bytes));
  constexpr std::uintmax_t share = 4;  // one entry shall not drive out all others
  if (out.bytes.size() > most_bytes_ / share) return;
  std::error_code failed;
  fs::create_directories(folder_, failed);
  if (failed) return;
  try {
    hydro::io::write_atomically(file, out.bytes);
  } catch (const hydro::InputError&) {
    return;
  }
  make_room();
}

void FitFolder::make_room() const {
  struct Entry {
    fs::file_time_type used;
    std::uintmax_t bytes;
    fs::path file;
  };
  std::vector<Entry> all;
  std::uintmax_t bytes = 0;
  std::error_code failed;  // of each call by itself: another process may remove files meanwhile
  for (fs::directory_iterator at(folder_, failed), end; !failed && at != end; at.increment(failed)) {
    if (at->path().extension() != extension) continue;
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

namespace {
std::mutex folder_lock;
std::optional<FitFolder> folder_of_process;
}  // namespace

std::optional<FitFolder> fit_folder() {
  const std::scoped_lock one_at_a_time(folder_lock);
  return folder_of_process;
}

void set_fit_folder(std::optional<FitFolder> folder) {
  const std::scoped_lock one_at_a_time(folder_lock);
  folder_of_process = std::move(folder);
}

}  // namespace froude::compile
