#include <algorithm>
#include <cmath>
#include <numbers>

#include "hydro/potential/formats/second_order.hpp"
#include "wamit.hpp"

namespace hydro::potential {
namespace {

/// How a file is laid out, by its name.
struct SecondOrderLayout {
  QuadraticTransfer::Kind kind;
  std::size_t periods;  ///< that each row begins with

  std::size_t heading() const { return periods; }
  std::size_t mode() const { return periods + 2; }
  std::size_t modulus() const { return periods + 3; }
  std::size_t columns() const { return periods + 7; }
  std::string names() const { return std::string(periods == 1 ? "PER" : "PER1 PER2") + " BETA1 BETA2 I Mod Pha Re Im"; }
};

SecondOrderLayout second_order_layout(const std::filesystem::path& path) {
  const std::string end = path.extension().string();
  for (const char* mean : {".7", ".8", ".9"})
    if (end == mean) return {QuadraticTransfer::Kind::mean_drift, 1};
  for (const char* full : {".10", ".11", ".12"}) {
    if (end == std::string(full) + "d") return {QuadraticTransfer::Kind::difference, 2};
    if (end == std::string(full) + "s") return {QuadraticTransfer::Kind::sum, 2};
  }
  throw InputError(fmt::format("\"{}\" is no file of second-order loads that is known", path.filename().string()),
                   {.file = path.string()},
                   "take WAMIT's .7, .8 or .9 (mean drift), .10d, .11d or .12d (difference), .10s, .11s or .12s (sum)");
}

/// Different numbers of a column; equal are those that print alike.
std::vector<double> printed_apart(std::vector<double> all) {
  std::sort(all.begin(), all.end());
  all.erase(
      std::unique(all.begin(), all.end(),
                  [](double a, double b) { return std::abs(b - a) <= per_tolerance * std::max(std::abs(a), 1.0); }),
      all.end());
  return all;
}
std::size_t index_in(const std::vector<double>& all, double one) {
  const auto at = std::min_element(all.begin(), all.end(),
                                   [&](double a, double b) { return std::abs(a - one) < std::abs(b - one); });
  return static_cast<std::size_t>(at - all.begin());
}

class SecondOrderReading {
 public:
  SecondOrderReading(const std::filesystem::path& path, const SecondOrderOptions& options)
      : layout_(second_order_layout(path)),
        options_(options),
        table_(WamitTable::read(path, {layout_.columns()}, layout_.names())) {
    std::vector<double> omega, heading;
    for (const auto& row : table_.rows()) {
      for (std::size_t p = 0; p < layout_.periods; ++p) omega.push_back(omega_of(row, p));
      for (std::size_t h = 0; h < 2; ++h) heading.push_back(row.value[layout_.heading() + h]);
    }
    omega_ = printed_apart(omega), degrees_ = printed_apart(heading);
    given_.assign(degrees_.size() * degrees_.size(), {});
    for (const auto& row : table_.rows()) take(row);
  }

  QuadraticTransfer made() {
    require_equal_halves();
    complete_halves();
    QuadraticTransfer out{.kind = layout_.kind, .omega = omega_, .heading = {}, .of_headings = {}, .notes = {}};
    for (const double degrees : degrees_) out.heading.push_back(Angle::from_degrees(degrees).radians());
    for (std::size_t pair = 0; pair < given_.size(); ++pair) out.of_headings.push_back(values_of(pair));
    if (!taken_)
      throw InputError(fmt::format("there is no row for any mode of body {}", options_.body),
                       {.file = table_.path().string()}, "check which body the file is of");
    std::string none;
    for (int mode = 0; mode < 6; ++mode)
      if (!used_[static_cast<std::size_t>(mode)]) none += fmt::format("{}{}", none.empty() ? "" : ", ", mode + 1);
    if (!none.empty())
      out.notes.push_back(fmt::format("{} has no second-order load of mode {}, which is taken as zero",
                                      table_.path().filename().string(), none));
    if (auto note = note_on_phases(table_, layout_.modulus())) out.notes.push_back(*note);
    return out;
  }

 private:
  /// A matrix, and the line of each of its numbers; 0: there is none.
  struct Given {
    Eigen::MatrixXcd value;
    Eigen::MatrixXi line;
  };

  double omega_of(const WamitTable::Row& row, std::size_t column) const {
    const double per = row.value[column];
    if (!(per > 0))
      throw InputError(fmt::format("PER = {} is no wave", per), table_.place(row, column),
                       "leave the limits of zero and infinite frequency out");
    return options_.iperout == 1 ? 2 * std::numbers::pi / per : per;
  }
  std::size_t pair(std::size_t h1, std::size_t h2) const { return h1 * degrees_.size() + h2; }

  void take(const WamitTable::Row& row) {
    const int mode = table_.mode(row, layout_.mode()) - 6 * (options_.body - 1) - 1;
    if (mode < 0 || mode > 5) return;
    taken_ = used_[static_cast<std::size_t>(mode)] = true;
    const auto k = static_cast<Eigen::Index>(index_in(omega_, omega_of(row, 0)));
    const auto l = layout_.periods == 1 ? 0 : static_cast<Eigen::Index>(index_in(omega_, omega_of(row, 1)));
    Given& given = given_[pair(index_in(degrees_, row.value[layout_.heading()]),
                               index_in(degrees_, row.value[layout_.heading() + 1]))][static_cast<std::size_t>(mode)];
    if (given.line.size() == 0) {
      const auto rows = static_cast<Eigen::Index>(omega_.size()), columns = layout_.periods == 1 ? 1 : rows;
      given = {Eigen::MatrixXcd::Zero(rows, columns), Eigen::MatrixXi::Zero(rows, columns)};
    }
    if (given.line(k, l) != 0)
      throw InputError(fmt::format("the same waves and mode are in line {} already", given.line(k, l)),
                       table_.place(row), "keep one of the two rows");
    given.line(k, l) = row.line;
    // T = ρ g T̄ L of forces, L² of moments
    given.value(k, l) = options_.density * options_.gravity * std::pow(options_.ulen, mode < 3 ? 1 : 2) *
                        std::complex<double>(row.value[layout_.modulus() + 2], row.value[layout_.modulus() + 3]);
  }

  std::complex<double> mirrored(std::complex<double> T) const {
    return layout_.kind == QuadraticTransfer::Kind::sum ? T : std::conj(T);
  }

  /// Where T(1; 2) and T(2; 1) are both given they say the same, or the load would not be one of two waves.
  void require_equal_halves() const {
    constexpr double apart = 0.05;  // of the largest of the mode: programs print halves that differ by their own error
    const bool full = layout_.periods == 2;
    for (std::size_t h1 = 0; h1 < degrees_.size(); ++h1)
      for (std::size_t h2 = 0; h2 < degrees_.size(); ++h2)
        for (std::size_t mode = 0; mode < 6; ++mode) {
          const Given &one = given_[pair(h1, h2)][mode], &other = given_[pair(h2, h1)][mode];
          if (one.line.size() == 0 || other.line.size() == 0) continue;
          const double largest = std::max(one.value.cwiseAbs().maxCoeff(), other.value.cwiseAbs().maxCoeff());
          for (Eigen::Index k = 0; k < one.line.rows(); ++k)
            for (Eigen::Index l = 0; l < one.line.cols(); ++l) {
              const Eigen::Index row = full ? l : k, column = full ? k : l;
              if (one.line(k, l) == 0 || other.line(row, column) == 0) continue;
              if (std::abs(one.value(k, l) - mirrored(other.value(row, column))) <= apart * largest) continue;
              throw InputError(
                  one.line(k, l) == other.line(row, column)
                      ? fmt::format("the load of a wave with itself has an imaginary part, in line {}", one.line(k, l))
                      : fmt::format("lines {} and {} are of the same two waves and do not agree: T(2; 1) is {}T(1; 2)",
                                    one.line(k, l), other.line(row, column),
                                    layout_.kind == QuadraticTransfer::Kind::sum ? "" : "the conjugate of "),
                  {.file = table_.path().string(), .line = one.line(k, l)},
                  "look at the signs of the imaginary parts, or leave one half out");
            }
        }
  }

  /// T(2; 1) from T(1; 2) where one of them is given.
  void complete_halves() {
    const bool full = layout_.periods == 2;
    for (std::size_t h1 = 0; h1 < degrees_.size(); ++h1)
      for (std::size_t h2 = 0; h2 < degrees_.size(); ++h2)
        for (std::size_t mode = 0; mode < 6; ++mode) {
          const Given from = given_[pair(h1, h2)][mode];
          Given& to = given_[pair(h2, h1)][mode];
          if (from.line.size() == 0) continue;
          if (to.line.size() == 0)
            to = {Eigen::MatrixXcd::Zero(from.value.rows(), from.value.cols()),
                  Eigen::MatrixXi::Zero(from.line.rows(), from.line.cols())};
          for (Eigen::Index k = 0; k < from.line.rows(); ++k)
            for (Eigen::Index l = 0; l < from.line.cols(); ++l) {
              int& line = full ? to.line(l, k) : to.line(k, l);
              if (from.line(k, l) == 0 || line != 0) continue;
              line = from.line(k, l);
              (full ? to.value(l, k) : to.value(k, l)) = mirrored(from.value(k, l));
            }
        }
  }

  std::array<Eigen::MatrixXcd, 6> values_of(std::size_t pair) {
    std::array<Eigen::MatrixXcd, 6> out;
    const auto& given = given_[pair];
    if (std::all_of(given.begin(), given.end(), [](const Given& g) { return g.line.size() == 0; })) return out;
    const auto rows = static_cast<Eigen::Index>(omega_.size()), columns = layout_.periods == 1 ? 1 : rows;
    for (std::size_t mode = 0; mode < 6; ++mode) {
      out[mode] = Eigen::MatrixXcd::Zero(rows, columns);
      if (!used_[mode]) continue;
      require_whole(given[mode], pair, mode);
      out[mode] = given[mode].value;
    }
    return out;
  }
  void require_whole(const Given& given, std::size_t pair, std::size_t mode) const {
    const auto refuse = [&](const std::string& waves) {
      throw InputError(
          fmt::format("there is no row for {} from {} and {} deg, mode {}", waves, degrees_[pair / degrees_.size()],
                      degrees_[pair % degrees_.size()], 6 * static_cast<std::size_t>(options_.body - 1) + mode + 1),
          {.file = table_.path().string()},
          "every pair of the file's frequencies is needed for each pair of headings that it has");
    };
    if (given.line.size() == 0) refuse("waves");
    for (Eigen::Index k = 0; k < given.line.rows(); ++k)
      for (Eigen::Index l = 0; l < given.line.cols(); ++l)
        if (given.line(k, l) == 0)
          refuse(fmt::format("waves of {:.6g} and {:.6g} rad/s", omega_[static_cast<std::size_t>(k)],
                             omega_[static_cast<std::size_t>(layout_.periods == 1 ? k : l)]));
  }

  SecondOrderLayout layout_;
  SecondOrderOptions options_;
  WamitTable table_;
  std::vector<double> omega_, degrees_;
  std::vector<std::array<Given, 6>> given_;
  std::array<bool, 6> used_{};
  bool taken_ = false;
};

}  // namespace

QuadraticTransfer read_second_order(const std::filesystem::path& path, const SecondOrderOptions& options) {
  require(options.iperout == 1 || options.iperout == 2, "IPEROUT of second-order loads is 1 (s) or 2 (rad/s), got {}",
          options.iperout);
  return SecondOrderReading(path, options).made();
}

}  // namespace hydro::potential
