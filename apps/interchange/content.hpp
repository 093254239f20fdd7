#pragma once
/// \file  A result of any kind as arrays with names, units and axes: what other programs take.
#include <complex>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "froude/result.hpp"

namespace froude::interchange {

/// Numbers, complex numbers or texts; the other two are empty.
struct Array {
  std::string name;                ///< "m1.heave"; within a group "branch1/height"
  std::string unit;                ///< in which the values are; "" for numbers
  std::string meaning;             ///< for people
  std::vector<std::string> along;  ///< names of axes, slowest first, which are arrays too; none: one value
  std::vector<std::size_t> shape;  ///< one number an axis
  std::vector<double> values;
  std::vector<std::complex<double>> amplitudes;  ///< phase as (P1) and (P2)
  std::vector<std::string> texts;

  bool is_axis() const { return along.size() == 1 && along.front() == name; }
};

struct Content {
  std::string kind;                                        ///< "froude run"; "" of a table
  std::vector<std::pair<std::string, std::string>> facts;  ///< version, conventions, the text of the scene
  std::vector<Array> arrays;                               ///< in the order of the file
  /// \throws std::out_of_range if there is none
  const Array& array(const std::string& name) const;
};

/// A result (.h5, .nc) of any command, or a table (.csv), whose values are then in SI.
/// \throws hydro::InputError if the file is none of ours, or an array has no axes
Content read_content(const std::filesystem::path& path);

/// What write_rao() would keep of them.
Content content_of(const Responses& responses);

/// Leaves the samples of all arrays along `axis` that are listed, by rising number.
void keep(Content& content, const std::string& axis, const std::vector<std::size_t>& samples);

/// Leaves arrays whose name passes, and the axes along which they stand.
void keep_named(Content& content, const std::function<bool(const std::string&)>& passes);

}  // namespace froude::interchange
