#pragma once
/// \file  Private to apps: numbers, texts and matrices as bytes, to be kept from one start of the program to the next.
///
/// A type is passed by one function for both ways, which names all of its members by a structured binding: what is
/// added to it does not compile until it is passed too.
#include <Eigen/Core>

#include <complex>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace froude::compile {

template <class Scalar>
using DynamicMatrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

/// Puts values into bytes, as this machine has them.
class ArchiveWriter {
 public:
  template <class T>
  void operator()(const T& value) requires std::is_arithmetic_v<T> {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void operator()(const std::string& text) {
    (*this)(text.size());
    bytes += text;
  }
  template <class Scalar>
  void operator()(const DynamicMatrix<Scalar>& m) {
    (*this)(m.rows());
    (*this)(m.cols());
    bytes.append(reinterpret_cast<const char*>(m.data()), sizeof(Scalar) * static_cast<std::size_t>(m.size()));
  }
  void operator()(const Eigen::Vector3d& v) {
    for (const double x : v) (*this)(x);
  }
  template <class T>
  void operator()(const std::optional<T>& one) {
    (*this)(one.has_value());
    if (one) (*this)(*one);
  }
  template <class T>
  void operator()(const std::vector<T>& all) {
    list(all, [](ArchiveWriter& to, const T& one) { to(one); });
  }
  /// Each by `pass`, which takes the archive and one of them.
  template <class T, class Pass>
  void list(const std::vector<T>& all, const Pass& pass) {
    (*this)(all.size());
    for (const T& one : all) pass(*this, one);
  }
  std::string bytes;
};

/// Takes them out again. \throws std::length_error where they end before
class ArchiveReader {
 public:
  explicit ArchiveReader(std::string_view bytes) : bytes_(bytes) {}
  template <class T>
  void operator()(T& value) requires std::is_arithmetic_v<T> {
    std::memcpy(&value, take(1, sizeof value), sizeof value);
  }
  void operator()(std::string& text) {
    const auto size = number<std::size_t>();
    text.assign(take(size, 1), size);
  }
  template <class Scalar>
  void operator()(DynamicMatrix<Scalar>& m) {
    const auto rows = number<Eigen::Index>(), cols = number<Eigen::Index>();
    constexpr Eigen::Index largest = 1 << 20;
    if (rows < 0 || cols < 0 || rows > largest || cols > largest) throw std::length_error("no matrix is so large");
    const char* from = take(static_cast<std::size_t>(rows * cols), sizeof(Scalar));
    m.resize(rows, cols);
    if (m.size() > 0) std::memcpy(m.data(), from, sizeof(Scalar) * static_cast<std::size_t>(m.size()));
  }
  void operator()(Eigen::Vector3d& v) {
    for (double& x : v) (*this)(x);
  }
  template <class T>
  void operator()(std::optional<T>& one) {
    if (!number<bool>()) return one.reset();
    (*this)(one.emplace());
  }
  template <class T>
  void operator()(std::vector<T>& all) {
    list(all, [](ArchiveReader& from, T& one) { from(one); });
  }
  template <class T, class Pass>
  void list(std::vector<T>& all, const Pass& pass) {
    const auto size = number<std::size_t>();
    if (size > bytes_.size()) throw std::length_error("a list is longer than its file");
    all.resize(size);
    for (T& one : all) pass(*this, one);
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

}  // namespace froude::compile
