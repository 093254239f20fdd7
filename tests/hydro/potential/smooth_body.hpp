#pragma once
/// \file  Coefficients in closed form, for files written by tests: no two entries alike, nothing symmetric, so that a
/// transpose, a swapped column or a wrong power shows.
#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "hydro/base/random.hpp"
#include "hydro/potential/coefficients.hpp"

namespace froude_test {

/// A(ω) falls from 2 S_ij to S_ij, heave excitation from C33 to nothing, as those of a floating body do.
struct SmoothBody {
  int bodies = 1;
  double scale(int i, int j) const { return 1000.0 * (i + 1) + 10.0 * (j + 1); }
  double A_inf(int i, int j) const { return scale(i, j); }
  double A_zero(int i, int j) const { return 2 * scale(i, j); }
  double A(int i, int j, double omega) const { return scale(i, j) * (1 + 1 / (1 + omega * omega)); }
  double B(int i, int j, double omega) const { return 0.1 * scale(i, j) * omega * omega / (1 + std::pow(omega, 4)); }
  std::complex<double> X(int i, double omega, double heading) const {
    return std::polar(1000.0 * (i + 1) * std::exp(-omega * omega), (0.3 * i + 0.7 * heading) * omega);
  }
  double C(int i, int j) const {
    const bool acts = i / 6 == j / 6 && i % 6 >= 2 && i % 6 <= 4 && j % 6 >= 2 && j % 6 <= 5;
    return acts ? 1000.0 * (i + 1) + (i == j ? 0 : j + 1) : 0;
  }

  /// The whole of it, as a reader should give it back.
  hydro::potential::Coefficients coefficients(const hydro::Water& water, const std::vector<double>& omega,
                                              const std::vector<double>& heading) const {
    hydro::potential::Coefficients c;
    const int n = 6 * bodies;
    const auto matrix = [&](auto entry) { return Eigen::MatrixXd(Eigen::MatrixXd::NullaryExpr(n, n, entry)); };
    using I = Eigen::Index;
    c.water = water;
    c.omega = omega;
    c.heading = heading;
    c.source = "a formula";
    c.body.resize(static_cast<std::size_t>(bodies));
    for (const double w : omega) {
      c.A.push_back(matrix([&](I i, I j) { return A(int(i), int(j), w); }));
      c.B.push_back(matrix([&](I i, I j) { return B(int(i), int(j), w); }));
    }
    c.A_zero = matrix([&](I i, I j) { return A_zero(int(i), int(j)); });
    c.A_inf = matrix([&](I i, I j) { return A_inf(int(i), int(j)); });
    c.C = matrix([&](I i, I j) { return C(int(i), int(j)); });
    for (const double beta : heading)
      c.X.push_back(Eigen::MatrixXcd::NullaryExpr(
          n, I(omega.size()), [&](I i, I k) { return X(int(i), omega[static_cast<std::size_t>(k)], beta); }));
    return c;
  }
};

/// A folder of one test, gone afterwards.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "froude-test-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = name;
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

/// Largest |a − b| over the largest |b|, over all matrices; huge if the shapes differ.
template <class Matrices>
double relative_difference(const Matrices& a, const Matrices& b) {
  double difference = 0, size = 0;
  if (a.size() != b.size()) return 1e300;
  for (std::size_t k = 0; k < a.size(); ++k) {
    if (a[k].rows() != b[k].rows() || a[k].cols() != b[k].cols()) return 1e300;
    difference = std::max(difference, (a[k] - b[k]).cwiseAbs().maxCoeff());
    size = std::max(size, b[k].cwiseAbs().maxCoeff());
  }
  return size > 0 ? difference / size : difference;
}

/// As relative_difference, but entry by entry, so that small entries count as much as large ones.
template <class Matrices>
double largest_relative_error(const Matrices& a, const Matrices& b) {
  double worst = 0;
  if (a.size() != b.size()) return 1e300;
  for (std::size_t k = 0; k < a.size(); ++k) {
    if (a[k].rows() != b[k].rows() || a[k].cols() != b[k].cols()) return 1e300;
    for (Eigen::Index i = 0; i < b[k].rows(); ++i)
      for (Eigen::Index j = 0; j < b[k].cols(); ++j) {
        const double error = std::abs(a[k](i, j) - b[k](i, j)), size = std::abs(b[k](i, j));
        worst = std::max(worst, size > 0 ? error / size : (error > 0 ? 1e300 : 0));
      }
  }
  return worst;
}

/// An optional matrix as a list, so that the two functions above take it.
inline std::vector<Eigen::MatrixXd> listed(const std::optional<Eigen::MatrixXd>& m) {
  return m ? std::vector<Eigen::MatrixXd>{*m} : std::vector<Eigen::MatrixXd>{};
}

/// Valid coefficients with numbers of every size and sign; what is optional is there or not by chance.
inline hydro::potential::Coefficients random_coefficients(std::uint64_t seed) {
  const hydro::RandomStream stream(seed, 7);
  std::uint64_t next = 0;
  const auto uniform = [&] { return stream.uniform(next++); };
  const auto number = [&] { return stream.normal(next++) * std::pow(10.0, 20 * uniform() - 10); };
  const auto chance = [&] { return uniform() < 0.5; };
  const auto count = [&](int most) { return 1 + static_cast<int>(most * uniform()); };

  hydro::potential::Coefficients c;
  c.source = "random " + std::to_string(seed);
  c.water.density = 900 + 200 * uniform();
  c.water.gravity = 9 + uniform();
  if (chance()) c.water.depth = hydro::WaterDepth::from_metres(1 + 100 * uniform());
  c.body.resize(static_cast<std::size_t>(count(3)));
  const auto point = [&] { return Eigen::Vector3d(number(), number(), number()); };
  for (std::size_t b = 0; b < c.body.size(); ++b) {
    c.body[b].name = "body" + std::to_string(b + 1);
    if (chance()) c.body[b].centre_of_gravity = point();
    if (chance()) c.body[b].centre_of_buoyancy = point();
    if (chance()) c.body[b].reference_point = point();
    if (chance()) c.body[b].displaced_volume = std::abs(number());
  }
  const int n = c.modes();
  const auto matrix = [&] { return Eigen::MatrixXd(Eigen::MatrixXd::NullaryExpr(n, n, [&] { return number(); })); };
  double omega = 0;
  for (int k = count(5); k > 0; --k) c.omega.push_back(omega += 0.01 + uniform());
  for (std::size_t k = 0; k < c.omega.size(); ++k) {
    c.A.push_back(matrix());
    c.B.push_back(matrix());
  }
  if (chance()) c.A_zero = matrix();
  if (chance()) c.A_inf = matrix();
  if (chance()) {
    c.C = Eigen::MatrixXd::Zero(n, n);  // the water restores each rigid body by itself
    const Eigen::MatrixXd all = matrix();
    for (int b = 0; b < n; b += 6) {
      c.C->block<6, 6>(b, b) = all.block<6, 6>(b, b);
      c.C->diagonal().segment<2>(b).setZero();  // and holds none in surge and sway
    }
  }
  double beta = -4;
  for (int h = chance() ? count(4) : 0; h > 0; --h) c.heading.push_back(beta += 0.01 + uniform());
  for (std::size_t h = 0; h < c.heading.size(); ++h)
    c.X.push_back(Eigen::MatrixXcd::NullaryExpr(n, static_cast<Eigen::Index>(c.omega.size()),
                                                [&] { return std::complex<double>(number(), number()); }));
  if (chance()) c.notes = {"first note, with ω and \"quotes\"", "second"};
  return c;
}

}  // namespace froude_test
