#pragma once
/// \file  The state of something that runs as bytes, and back again to the bit.
#include <Eigen/Core>

#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace hydro {

/// Takes numbers up, or gives them back in the same order: one function of a class, `keep_state(StateBytes&)`, says
/// once what its state is and serves both ways. Numbers are as this machine has them. Sizes are kept with what they
/// are sizes of. \throws std::length_error where bytes that are given back end too soon
class StateBytes {
 public:
  StateBytes() = default;                                                                  ///< takes up
  explicit StateBytes(std::string bytes) : bytes_(std::move(bytes)), gives_back_(true) {}  ///< gives back

  bool gives_back() const { return gives_back_; }
  const std::string& bytes() const { return bytes_; }
  bool at_end() const { return at_ == bytes_.size(); }

  template <class... Each>
  void pass(Each&... each) {
    (pass_one(each), ...);
  }

 private:
  void pass_raw(void* data, std::size_t size) {
    if (!gives_back_) {
      bytes_.append(static_cast<const char*>(data), size);
      return;
    }
    if (bytes_.size() - at_ < size) throw std::length_error("the bytes of a state end too soon");
    bytes_.copy(static_cast<char*>(data), size, at_);
    at_ += size;
  }
  template <class T>
  void pass_one(T& number) requires(std::is_arithmetic_v<T> || std::is_enum_v<T>) {
    pass_raw(&number, sizeof number);
  }
  /// Of something of `each` bytes: what is given back cannot be more than there is.
  template <class Size>
  Size pass_size(Size size, std::size_t each) {
    pass_raw(&size, sizeof size);
    if (gives_back_ && (size < 0 || (each > 0 && static_cast<std::size_t>(size) > (bytes_.size() - at_) / each)))
      throw std::length_error("the bytes of a state end too soon");
    return size;
  }
  void pass_one(std::string& text) {
    text.resize(pass_size(text.size(), 1));
    pass_raw(text.data(), text.size());
  }
  template <class T>
  void pass_one(std::vector<T>& all) {
    all.resize(pass_size(all.size(), std::is_arithmetic_v<T> ? sizeof(T) : 1));
    if constexpr (std::is_arithmetic_v<T>)
      pass_raw(all.data(), sizeof(T) * all.size());
    else
      for (T& one : all) pass_one(one);
  }
  template <class T>
  void pass_one(std::optional<T>& one) {
    bool there = one.has_value();
    pass_raw(&there, sizeof there);
    if (!there) return one.reset();
    if (!one) one.emplace();
    pass_one(*one);
  }
  template <class Derived>
  void pass_one(Eigen::PlainObjectBase<Derived>& matrix) {
    const Eigen::Index rows = pass_size(matrix.rows(), 0), columns = pass_size(matrix.cols(), 0);
    const auto most = static_cast<Eigen::Index>((bytes_.size() - at_) / sizeof(typename Derived::Scalar));
    if (gives_back_ && rows > 0 && columns > most / rows) throw std::length_error("the bytes of a state end too soon");
    matrix.resize(rows, columns);
    pass_raw(matrix.data(), sizeof(typename Derived::Scalar) * static_cast<std::size_t>(matrix.size()));
  }
  template <class T>
  void pass_one(T& one) requires requires(StateBytes& b) {
    one.keep_state(b);
  }
  { one.keep_state(*this); }

  std::string bytes_;
  std::size_t at_ = 0;
  bool gives_back_ = false;
};

}  // namespace hydro
