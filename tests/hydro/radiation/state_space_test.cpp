#include "hydro/radiation/state_space.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <filesystem>
#include <sstream>

#include "hydro/base/error.hpp"
#include "hydro/io/atomic_file.hpp"
#include "hydro/io/hdf5.hpp"
#include "support/random_passive.hpp"
#include "support/scratch.hpp"

namespace state_space_test {
namespace {

using namespace hydro::radiation;

PoleModel model() {
  auto m = support::random_passive(4, 6, 2);
  m.poles.push_back({0.4, 0});
  m.C.push_back(1e4 * Eigen::MatrixXd::Identity(6, 6));
  m.S.push_back(Eigen::MatrixXd::Zero(6, 6));
  return m;
}

std::filesystem::path scratch(const char* name) { return support::scratch_folder() / name; }

TEST(StateSpace, HasTheTransformOfTheModel) {
  const auto m = model();
  const auto s = state_space(m);
  for (const double omega : {0.0, 0.7, 3.0}) {
    const Eigen::MatrixXcd sI = std::complex<double>(0, omega) * Eigen::MatrixXcd::Identity(s.A.rows(), s.A.rows());
    const Eigen::MatrixXcd K = s.C * (sI - s.A).partialPivLu().solve(s.B.cast<std::complex<double>>());
    EXPECT_LT((K - m.transform(omega)).norm(), 1e-10 * m.transform(1).norm()) << omega;
  }
}

TEST(StateSpace, IsWrittenForOpenFastAsTheLoadOnThePlatform) {
  const auto m = model();
  const auto file = scratch("froude_radiation.ss");
  write_openfast(m, "test", file);
  std::istringstream in(hydro::io::read_text(file));
  std::string title;
  std::getline(in, title);
  std::vector<double> numbers;
  for (double x = 0; in >> x;) numbers.push_back(x);
  const std::size_t n = 6, states = 30;  // five a mode
  ASSERT_EQ(numbers.size(), n + 1 + n + states * states + 2 * states * n);
  EXPECT_EQ(numbers[n], 30);
  for (std::size_t i = 0; i < n; ++i) EXPECT_EQ(numbers[n + 1 + i], 5);
  // C B is what a velocity does at once: −K(0), against the motion.
  Eigen::MatrixXd B(states, n), C(n, states);
  std::size_t at = 2 * n + 1 + states * states;
  for (std::size_t r = 0; r < states; ++r)
    for (std::size_t c = 0; c < n; ++c) B(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) = numbers[at++];
  for (std::size_t r = 0; r < n; ++r)
    for (std::size_t c = 0; c < states; ++c)
      C(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) = numbers[at++];
  EXPECT_LT((C * B + m.kernel(0)).norm(), 1e-12 * m.kernel(0).norm());
  std::filesystem::remove(file);
}

TEST(StateSpace, IsWrittenForBemioOverTheDensity) {
  const auto m = model();
  const auto file = scratch("froude_radiation_ss.h5");
  write_bemio_state_space(m, 1000, 0.5, 2, file);
  const hydro::io::Hdf5Reader in(file);
  const std::string group = "/body1/hydro_coeffs/radiation_damping/";
  EXPECT_EQ(in.numbers(group + "state_space/A/all").shape, (std::vector<std::size_t>{6, 6, 5, 5}));
  const auto C = in.numbers(group + "state_space/C/all"), B = in.numbers(group + "state_space/B/all");
  double at_once = 0;
  for (std::size_t k = 0; k < 5; ++k) at_once += C.values[(2 * 6 + 3) * 5 + k] * B.values[(2 * 6 + 3) * 5 + k];
  EXPECT_NEAR(at_once, m.kernel(0)(2, 3) / 1000, 1e-12 * m.kernel(0).norm());
  const auto K = in.numbers(group + "impulse_response_fun/K");
  EXPECT_EQ(K.shape, (std::vector<std::size_t>{6, 6, 5}));
  EXPECT_NEAR(K.values[(2 * 6 + 3) * 5 + 2], m.kernel(1)(2, 3) / 1000, 1e-12 * m.kernel(0).norm());
  std::filesystem::remove(file);
}

TEST(StateSpace, RefusesHalfABody) {
  EXPECT_THROW(write_openfast(support::random_passive(1, 4, 2), "test", scratch("none.ss")), hydro::InputError);
}

}  // namespace
}  // namespace state_space_test
