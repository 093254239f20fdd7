#include "interchange/csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <numbers>

#include "hydro/base/error.hpp"
#include "hydro/base/types.hpp"
#include "hydro/base/units.hpp"
#include "hydro/io/csv.hpp"

namespace froude::interchange {
namespace {

/// A column before it is spread over the rows of the table.
struct Column {
  std::string name, unit;
  std::vector<std::string> along;
  std::vector<double> values;  ///< in SI
};

/// A table takes SI, and SI of a hertz is 2π rad/s: what it divides out again is put in here.
std::vector<double> in_si(std::vector<double> values, const std::string& unit) {
  const double factor = unit.empty() ? 1 : hydro::parse_unit(unit).factor;
  if (factor != 1)
    for (double& v : values) v *= factor;
  return values;
}

template <class Of>
std::vector<double> each(const std::vector<std::complex<double>>& values, Of of) {
  std::vector<double> out;
  out.reserve(values.size());
  for (const auto& v : values) out.push_back(of(v));
  return out;
}

void add_complex(const Array& a, std::vector<Column>& out) {
  using Complex = std::complex<double>;
  const bool is_response = std::find(a.along.begin(), a.along.end(), "omega") != a.along.end();
  const auto add = [&](const char* part, const std::string& unit, auto of) {
    out.push_back({a.name + part, unit, a.along, in_si(each(a.amplitudes, of), is_response ? "" : a.unit)});
  };
  if (is_response) {
    add(" amplitude", a.unit, [](const Complex& z) { return std::abs(z); });
    add(" phase", "deg", [](const Complex& z) { return std::arg(z); });
  } else {
    add(" real", a.unit, [](const Complex& z) { return z.real(); });
    add(" imaginary", a.unit, [](const Complex& z) { return z.imag(); });
  }
}

/// The array at one text of an axis of texts.
Array at_text(const Array& a, std::size_t axis, std::size_t which, const std::string& text) {
  Array out{.name = a.name + ' ' + text,
            .unit = a.unit,
            .meaning = a.meaning,
            .along = a.along,
            .shape = a.shape,
            .values = {},
            .amplitudes = {},
            .texts = {}};
  std::size_t after = 1;
  for (std::size_t i = axis + 1; i < a.shape.size(); ++i) after *= a.shape[i];
  const auto pick = [&](const auto& from, auto& to) {
    for (std::size_t i = 0; i < from.size(); ++i)
      if (i / after % a.shape[axis] == which) to.push_back(from[i]);
  };
  pick(a.values, out.values), pick(a.amplitudes, out.amplitudes);
  out.along.erase(out.along.begin() + static_cast<std::ptrdiff_t>(axis));
  out.shape.erase(out.shape.begin() + static_cast<std::ptrdiff_t>(axis));
  return out;
}

class Table {
 public:
  explicit Table(const Content& content) : content_(content) {
    for (const Array& a : content.arrays)
      if (const auto axes = number_axes(a); axes.size() > axes_.size()) axes_ = axes;
    if (axes_.empty()) throw hydro::InputError("the result has no array along an axis, so there is no table of it");
    for (const std::string& axis : axes_) rows_ *= content.array(axis).values.size();
  }

  std::vector<std::string> write(const std::filesystem::path& path) {
    std::vector<std::string> left_out;
    for (const std::string& axis : axes_) add_axis(content_.array(axis));
    for (const Array& a : content_.arrays) {
      if (a.is_axis()) continue;
      if (a.along.empty() && !a.values.empty())
        comments_.push_back(told(a));
      else if (!a.texts.empty() || !fits(a))
        left_out.push_back(a.name);
      else
        add(a);
    }
    std::deque<std::vector<double>> spread;
    std::vector<hydro::io::CsvColumn> out;
    for (const Column& c : columns_) {
      spread.push_back(over_rows(c));
      out.push_back({c.name, c.unit, &spread.back()});
    }
    hydro::io::write_csv(path, out, comments_);
    return left_out;
  }

 private:
  bool is_of_texts(const std::string& axis) const { return !content_.array(axis).texts.empty(); }
  std::vector<std::string> number_axes(const Array& a) const {
    if (a.name.find('/') != std::string::npos) return {};  // of a group
    std::vector<std::string> out;
    for (const std::string& axis : a.along)
      if (!is_of_texts(axis)) out.push_back(axis);
    return out;
  }
  bool fits(const Array& a) const {
    const auto axes = number_axes(a);
    return !axes.empty() && std::all_of(axes.begin(), axes.end(), [&](const std::string& axis) {
      return std::find(axes_.begin(), axes_.end(), axis) != axes_.end();
    });
  }
  /// One number, an angle in degrees as in columns.
  static std::string told(const Array& a) {
    const bool is_angle = a.unit == "rad";
    const double value = is_angle ? hydro::Angle::from_radians(a.values.front()).degrees() : a.values.front();
    return fmt::format("{} = {:.6g}{}{}", a.name, value, a.unit.empty() ? "" : " ", is_angle ? "deg" : a.unit);
  }
  void add_axis(const Array& axis) {
    const bool is_angle = axis.unit == "rad";
    columns_.push_back({axis.name, is_angle ? "deg" : axis.unit, {axis.name}, in_si(axis.values, axis.unit)});
    if (axis.name != "omega" || content_.kind != "froude rao") return;
    std::vector<double> period;
    for (const double omega : axis.values) period.push_back(2 * std::numbers::pi / omega);
    columns_.push_back({"period", "s", {axis.name}, period});
    comments_.emplace_back(
        "amplitudes over that of the wave, in the unit of each column; phase leads the wave at the origin, Re(X exp(+i "
        "omega t))");
  }
  void add(const Array& a) {
    for (std::size_t i = 0; i < a.along.size(); ++i)
      if (is_of_texts(a.along[i])) {
        const auto& texts = content_.array(a.along[i]).texts;
        for (std::size_t k = 0; k < texts.size(); ++k) add(at_text(a, i, k, texts[k]));
        return;
      }
    if (!a.amplitudes.empty())
      add_complex(a, columns_);
    else
      columns_.push_back({a.name, a.unit, a.along, in_si(a.values, a.unit)});
  }
  /// Repeated along the axes that it does not have.
  std::vector<double> over_rows(const Column& c) const {
    std::vector<std::size_t> stride(axes_.size(), 0), size;
    for (const std::string& axis : axes_) size.push_back(content_.array(axis).values.size());
    std::size_t step = 1;
    for (std::size_t i = c.along.size(); i-- > 0;) {
      const auto at = static_cast<std::size_t>(std::find(axes_.begin(), axes_.end(), c.along[i]) - axes_.begin());
      stride[at] = step, step *= size[at];
    }
    std::vector<double> out(rows_);
    for (std::size_t row = 0; row < rows_; ++row) {
      std::size_t rest = row, at = 0;
      for (std::size_t i = axes_.size(); i-- > 0; rest /= size[i]) at += rest % size[i] * stride[i];
      out[row] = c.values[at];
    }
    return out;
  }

  const Content& content_;
  std::vector<std::string> axes_;
  std::size_t rows_ = 1;
  std::vector<Column> columns_;
  std::vector<std::string> comments_;
};

}  // namespace

std::vector<std::string> write_csv(const std::filesystem::path& path, const Content& content) {
  return Table(content).write(path);
}

}  // namespace froude::interchange
