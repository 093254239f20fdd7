#include "hydro/waves/spectra/spectrum_tabulated.hpp"

#include <gmock/gmock.h>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numbers>

#include "hydro/waves/spectra/spectra.hpp"
#include "support/reference_data.hpp"
#include "support/scratch.hpp"

namespace hydro::waves::spectrum_tabulated_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// In a folder of its own process: tests run beside each other.
class File {
 public:
  explicit File(const std::string& text) : path_(support::scratch_folder() / "of_a_spectrum" / "spectrum.csv") {
    std::filesystem::create_directories(path_.parent_path());
    std::ofstream(path_) << text;
  }
  ~File() { std::filesystem::remove_all(path_.parent_path()); }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

TEST(TabulatedSpectrum, HasTheMomentsOfItsLines) {
  // A triangle 0 → 3 → 0 over 1 … 3 rad/s, with its top at 2.
  const TabulatedSpectrum triangle({1, 2, 3}, {0, 3, 0});
  EXPECT_DOUBLE_EQ(triangle.moment(0), 3);
  EXPECT_NEAR(triangle.moment(1), 6, 1e-14);
  EXPECT_NEAR(triangle.moment(2), 3 * (4 + 1.0 / 6), 1e-13);                  // variance of a triangle: 1/6
  EXPECT_NEAR(triangle.moment(4), 3 * (16 + 6 * 4 / 6.0 + 1 / 15.0), 1e-12);  // fourth moment about 2: 1/15
  EXPECT_NEAR(triangle.moment(-1), 3 * (3 * std::log(3.0) - 4 * std::log(2.0)), 1e-14);
  EXPECT_EQ(triangle.peak_omega(), 2);
  EXPECT_EQ(triangle.density(0.5), 0);
  EXPECT_EQ(triangle.density(3.5), 0);
  EXPECT_NEAR(triangle.density(1.25), 0.75, 1e-15);
  EXPECT_TRUE(std::isinf(triangle.tail_power()));
  EXPECT_NEAR(triangle.energy(1.4, 1.6), 3 * 0.5 * 0.2, 1e-15);
}

TEST(TabulatedSpectrum, MayBeginAtZeroFrequency) {
  const TabulatedSpectrum ramp({0, 1000}, {0, 1000});
  EXPECT_NEAR(ramp.moment(-1), 1000, 1e-10);
  EXPECT_THAT(
      [] {
        TabulatedSpectrum({0, 1}, {1, 1}).moment(-1);
      },
      ThrowsMessage<InputError>(HasSubstr("down to zero frequency")));
  // A point far apart from the next: ∫ (a + bω)/ω from 1e-3 to 10.
  EXPECT_NEAR(TabulatedSpectrum({1e-3, 10}, {1, 1}).moment(-1), std::log(1e4), 1e-13);
}

TEST(TabulatedSpectrum, MayHaveATail) {
  const TabulatedSpectrum spectrum({1, 2}, {0, 4}, 5);
  EXPECT_DOUBLE_EQ(spectrum.density(4), 4.0 / 32);
  EXPECT_NEAR(spectrum.energy(2, infinity), 4 * 2 / 4.0, 1e-14);
  EXPECT_NEAR(spectrum.moment(2), 4 * (15.0 / 4 - 7.0 / 3) + 128.0 / 8, 1e-13);  // ∫ 4(ω³ − ω²) and ∫ 4·32 ω^−3
  EXPECT_EQ(spectrum.tail_power(), 5);
  EXPECT_THROW(spectrum.moment(4), InputError);
}

TEST(TabulatedSpectrum, ApproachesTheSpectrumThatItWasTakenFrom) {
  const Jonswap exact(3, 9, 3.3);
  const double slope = (exact.density(0.6001) - exact.density(0.5999)) / 0.0002;
  for (const int points : {500, 1000, 2000}) {
    std::vector<double> omega, density;
    for (int i = 0; i <= points; ++i) {
      omega.push_back(3.0 * i / points);
      density.push_back(exact.density(omega.back()));
    }
    // The trapezium rule is off by h²/12 [S′], here between 0 and a node on the steep flank; h² S‴/S′ ~ 1 % of that.
    const double error = TabulatedSpectrum(omega, density).energy(0, 0.6) - exact.energy(0, 0.6);
    EXPECT_NEAR(error / (std::pow(3.0 / points, 2) / 12 * slope), 1, 0.02) << points;
  }
}

TEST(TabulatedSpectrum, ReadsHertzAndRadiansPerSecondAlike) {
  const double pi = std::numbers::pi;
  const File hertz("frequency [Hz], density [m^2/Hz]\n0.1, 0\n0.2, 5\n0.4, 0\n");
  const auto a = TabulatedSpectrum::read(hertz.path());
  EXPECT_NEAR(a.moment(0), 0.75, 1e-14);
  EXPECT_NEAR(a.peak_omega(), 0.4 * pi, 1e-14);
  EXPECT_NEAR(a.density(0.4 * pi), 5 / (2 * pi), 1e-14);
  const File radians("omega [rad/s], density [m^2 s/rad]\n1, 0\n2, 3\n3, 0\n");
  EXPECT_NEAR(TabulatedSpectrum::read(radians.path()).moment(0), 3, 1e-14);
}

TEST(TabulatedSpectrum, SaysWhereAFileIsWrong) {
  const File unsorted("frequency [Hz], density [m^2/Hz]\n0.1, 0\n0.3, 5\n0.2, 0\n");
  EXPECT_THAT([&] { TabulatedSpectrum::read(unsorted.path()); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("spectrum.csv:4"), HasSubstr("must increase"))));
  const File negative("frequency [Hz], density [m^2/Hz]\n0.1, 0\n0.3, -5\n0.4, 0\n");
  EXPECT_THAT([&] { TabulatedSpectrum::read(negative.path()); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("spectrum.csv:3"), HasSubstr("density 2"))));
  const File unit("frequency [Hz], density [m]\n0.1, 0\n0.3, 5\n");
  EXPECT_THROW(TabulatedSpectrum::read(unit.path()), InputError);
  const File empty("frequency [Hz], density [m^2/Hz]\n");
  EXPECT_THROW(TabulatedSpectrum::read(empty.path()), InputError);
}

TEST(TabulatedSpectrum, RefusesTablesThatAreNone) {
  EXPECT_THROW(TabulatedSpectrum({}, {}), InputError);
  EXPECT_THROW(TabulatedSpectrum({1}, {1}), InputError);
  EXPECT_THROW(TabulatedSpectrum({1, 2}, {1}), InputError);
  EXPECT_THROW(TabulatedSpectrum({1, 1}, {1, 1}), InputError);
  EXPECT_THROW(TabulatedSpectrum({-1, 1}, {1, 1}), InputError);
  EXPECT_THROW(TabulatedSpectrum({1, 2}, {1, std::nan("")}), InputError);
  EXPECT_THROW(TabulatedSpectrum({1, std::nan("")}, {1, 1}), InputError);
  EXPECT_THAT([] { TabulatedSpectrum({1, 2}, {0, 0}); }, ThrowsMessage<InputError>(HasSubstr("above zero")));
  EXPECT_THROW(TabulatedSpectrum({1, 2}, {1, 1}, 1.0), InputError);
}

TEST(TabulatedSpectrum, OfARecordKeepsItsVarianceInTheBand) {
  // Sines on the grid of the segments, away from its ends: all their variance is in the band, but for a Hann window's
  // reach.
  const double step = 0.5;
  const std::size_t segment = 400;
  std::vector<double> record;
  const double pi = std::numbers::pi;
  for (int i = 0; i < 4000; ++i)
    record.push_back(0.8 * std::sin(2 * pi * 0.1 * i * step) + 0.3 * std::cos(2 * pi * 0.235 * i * step));
  const auto spectrum =
      TabulatedSpectrum::of_record(record, step, {.segment = segment}, {.from_hz = 0.02, .to_hz = 0.5});
  EXPECT_NEAR(spectrum.moment(0), (0.64 + 0.09) / 2, 1e-12);
  EXPECT_NEAR(spectrum.peak_omega(), 2 * pi * 0.1, 1e-12);
  EXPECT_THROW(TabulatedSpectrum::of_record(record, step, {.segment = segment}, {.from_hz = 0.2, .to_hz = 0.1}),
               InputError);
  EXPECT_THROW(TabulatedSpectrum::of_record(record, step, {.segment = segment}, {.from_hz = 0.2001, .to_hz = 0.2002}),
               InputError);
}

TEST(TabulatedSpectrum, OfAMeasuredSeaHasTheHeightAndPeriodsThatScipyFinds) {
  FROUDE_REQUIRE_DATA(file, "waves_measured/wafo/sea.dat");
  std::ifstream in(file);
  std::vector<double> elevation;
  for (double t, z; in >> t >> z;) elevation.push_back(z);
  ASSERT_EQ(elevation.size(), 9524u);
  const auto spectrum = TabulatedSpectrum::of_record(elevation, 0.25, {.segment = 512}, {.from_hz = 0, .to_hz = 2});
  // scipy.signal.welch, Hann, 512 samples, half overlapping; its moments by the trapezium rule, ours of the lines:
  // h²/12 of the curvature of ω^n S, which the low frequencies make largest for Te.
  EXPECT_NEAR(spectrum.hs(), 1.9004, 1e-3);
  EXPECT_NEAR(spectrum.mean_period(), 4.880, 5e-3);
  EXPECT_NEAR(spectrum.tz(), 4.122, 5e-3);
  EXPECT_NEAR(spectrum.energy_period(), 6.321, 2e-2);
}

}  // namespace
}  // namespace hydro::waves::spectrum_tabulated_test
