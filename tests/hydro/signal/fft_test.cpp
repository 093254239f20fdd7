#include "hydro/signal/fft.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <thread>

#include "hydro/base/error.hpp"
#include "hydro/base/random.hpp"

namespace fft_test {
namespace {

using hydro::signal::inverse_real_fft;
using hydro::signal::real_fft;
using Complex = std::complex<double>;

std::vector<double> noise(std::size_t n, std::uint64_t stream = 1) {
  const hydro::RandomStream random(11, stream);
  std::vector<double> x(n);
  for (std::size_t j = 0; j < n; ++j) x[j] = random.normal(j);
  return x;
}

// (S1) term by term.
std::vector<Complex> slow_transform(const std::vector<double>& x) {
  std::vector<Complex> out(x.size() / 2 + 1);
  for (std::size_t k = 0; k < out.size(); ++k)
    for (std::size_t j = 0; j < x.size(); ++j)
      out[k] += x[j] * std::polar(1.0, -2 * std::numbers::pi * static_cast<double>(j * k % x.size()) /
                                           static_cast<double>(x.size()));
  return out;
}

TEST(Fft, AgreesWithTheSumThatDefinesItForEvenOddAndPrimeLengths) {
  for (const std::size_t n : {1u, 2u, 3u, 8u, 15u, 31u, 96u}) {
    const auto x = noise(n);
    const auto fast = real_fft(x);
    const auto slow = slow_transform(x);
    ASSERT_EQ(fast.size(), slow.size());
    // n terms of order one, each rounded once.
    for (std::size_t k = 0; k < fast.size(); ++k)
      EXPECT_LT(std::abs(fast[k] - slow[k]), 4e-16 * static_cast<double>(n * n + 4));
  }
}

TEST(Fft, KeepsThePhaseOfReAExpIOmegaT) {
  const Complex a = std::polar(1.5, 0.7);
  std::vector<double> x(64);
  for (std::size_t j = 0; j < x.size(); ++j)
    x[j] = (a * std::polar(1.0, 2 * std::numbers::pi * 5 * static_cast<double>(j) / 64)).real();
  EXPECT_LT(std::abs(real_fft(x)[5] - 32.0 * a), 1e-13);  // 64 terms, rounding only
}

TEST(Fft, ComesBackTimesTheLength) {
  for (const std::size_t n : {1u, 2u, 7u, 64u, 1000u}) {
    const auto x = noise(n);
    const auto back = inverse_real_fft(real_fft(x), n);
    for (std::size_t j = 0; j < n; ++j) EXPECT_NEAR(back[j] / static_cast<double>(n), x[j], 1e-14);
  }
}

TEST(Fft, ObeysParseval) {
  const auto x = noise(1000);
  const auto half = real_fft(x);
  double in = 0, out = std::norm(half.front()) + std::norm(half.back());
  for (const double v : x) in += v * v;
  for (std::size_t k = 1; k + 1 < half.size(); ++k) out += 2 * std::norm(half[k]);
  EXPECT_NEAR(out / 1000, in, 1e-12 * in);  // rounding of a thousand squares
}

TEST(Fft, GivesTheSameBitsFromManyThreads) {
  const auto x = noise(4096);
  const auto reference = real_fft(x);
  std::vector<std::vector<Complex>> results(4);
  std::vector<std::thread> threads;
  for (auto& result : results)
    threads.emplace_back([&] {
      for (int i = 0; i < 20; ++i) result = real_fft(x);
    });
  for (auto& thread : threads) thread.join();
  for (const auto& result : results) EXPECT_EQ(result, reference);
}

TEST(Fft, RefusesNothingAndHalvesOfAnotherLength) {
  EXPECT_THROW(real_fft({}), hydro::InputError);
  const std::vector<Complex> half(5);
  EXPECT_THROW(inverse_real_fft(half, 0), hydro::InputError);
  EXPECT_THROW(inverse_real_fft(half, 10), hydro::InputError);
  EXPECT_EQ(inverse_real_fft(half, 9).size(), 9u);
  EXPECT_EQ(inverse_real_fft(half, 8).size(), 8u);
}

}  // namespace
}  // namespace fft_test
