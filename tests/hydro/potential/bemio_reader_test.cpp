#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <limits>

#include "hydro/base/error.hpp"
#include "hydro/io/hdf5.hpp"
#include "smooth_body.hpp"

namespace bemio_reader_test {
namespace {

using froude_test::largest_relative_error;
using froude_test::listed;
using froude_test::SmoothBody;
using froude_test::TemporaryFolder;
using hydro::InputError;
using hydro::potential::read;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

/// The frequency at which a table holds NaN, 0 for none.
struct SpoiltAt {
  double A = 0, B = 0, X = 0;
};

/// How to write a BEMIO file.
struct BemioFile {
  SmoothBody body = {};
  hydro::Water water = {1000, 9.81, hydro::WaterDepth::infinite()};
  std::vector<double> omega = {0.4, 0.9, 1.5};
  std::vector<double> heading_deg = {-30, 0, 45};
  bool as_components = false;  ///< older files: one table (period, value) for each entry, and no `all`
  bool both = false;           ///< `all` and misleading components
  bool polar = false;          ///< modulus and phase only
  std::function<void(hydro::io::Hdf5Writer&)> add = [](auto&) {};
  double dof = 6, scaled = 0;
  SpoiltAt nan = {};

  void write(const std::filesystem::path& path) const {
    hydro::io::Hdf5Writer file;
    const std::string p = "/simulation_parameters/";
    const auto number = [&](const std::string& name, double v) { file.write(name, {&v, 1}, {1, 1}); };
    file.write_text("/bem_data/code", "WAMIT");
    number(p + "rho", water.density);
    number(p + "g", water.gravity);
    number(p + "scaled", scaled);
    file.write(p + "w", omega, {omega.size(), 1});
    file.write(p + "wave_dir", heading_deg, {heading_deg.size(), 1});
    if (water.depth.is_infinite()) {
      file.write_text(p + "water_depth", "infinite");
    } else {
      number(p + "water_depth", water.depth.metres());
    }
    for (int b = 0; b < body.bodies; ++b) write_body(file, b);
    add(file);
    file.save(path);
  }

 private:
  using Entry = std::function<double(int row, int column, double w)>;
  void table(hydro::io::Hdf5Writer& file, const std::string& all, const std::string& components, int columns,
             const Entry& entry) const {
    std::vector<double> values;
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < columns; ++j) {
        std::vector<double> pairs;
        for (const double w : omega) {
          values.push_back(entry(i, j, w));
          pairs.push_back(6.283185307 / w);
          pairs.push_back(both ? -1.0 : entry(i, j, w));
        }
        if (as_components || both)
          file.write(fmt::format("{}/{}_{}", components, i + 1, j + 1), pairs, {omega.size(), 2});
      }
    if (!as_components) file.write(all, values, {6, static_cast<std::size_t>(columns), omega.size()});
  }
  void write_body(hydro::io::Hdf5Writer& file, int b) const {
    const std::string root = fmt::format("/body{}/", b + 1), h = root + "hydro_coeffs/", e = h + "excitation";
    const int n = 6 * body.bodies, nh = int(heading_deg.size());
    const double rho = water.density, rho_g = rho * water.gravity;
    file.write_text(root + "properties/name", fmt::format("buoy{}", b + 1));
    file.write(root + "properties/cg", std::vector<double>{1.0 * b, 2, -3}, {3, 1});
    file.write(root + "properties/dof", {&dof, 1}, {1, 1});
    table(file, h + "added_mass/all", h + "added_mass/components", n, [&](int i, int j, double w) {
      return w == nan.A ? std::numeric_limits<double>::quiet_NaN() : body.A(6 * b + i, j, w) / rho;
    });
    table(file, h + "radiation_damping/all", h + "radiation_damping/components", n, [&](int i, int j, double w) {
      return w == nan.B ? std::numeric_limits<double>::quiet_NaN() : body.B(6 * b + i, j, w) / (rho * w);
    });
    const auto X = [&](int i, int j, double w) {
      return body.X(6 * b + i, w, hydro::Angle::from_degrees(heading_deg[static_cast<std::size_t>(j)]).radians()) /
             rho_g;
    };
    const auto excitation = [&](const std::string& name, auto of) {
      table(file, e + "/" + name, e + "/components/" + name, nh, [&](int i, int j, double w) {
        return w == nan.X ? std::numeric_limits<double>::quiet_NaN() : of(X(i, j, w));
      });
    };
    if (!polar) {
      excitation("re", [](auto z) { return z.real(); });
      excitation("im", [](auto z) { return z.imag(); });
    } else {
      excitation("mag", [](auto z) { return std::abs(z); });
      excitation("phase", [](auto z) { return std::arg(z); });
    }
    std::vector<double> A_inf, C;
    for (int i = 6 * b; i < 6 * b + 6; ++i) {
      for (int j = 0; j < n; ++j) A_inf.push_back(body.A_inf(i, j) / rho);
      for (int j = 6 * b; j < 6 * b + 6; ++j) C.push_back(body.C(i, j) / rho_g);
    }
    file.write(h + "added_mass/inf_freq", A_inf, {6, static_cast<std::size_t>(n)});
    file.write(h + "linear_restoring_stiffness", C, {6, 6});
  }

 public:
  hydro::potential::Coefficients expected() const {
    std::vector<double> beta;
    for (const double degrees : heading_deg) beta.push_back(hydro::Angle::from_degrees(degrees).radians());
    auto c = body.coefficients(water, omega, beta);
    c.A_zero.reset();
    return c;
  }
};

// Each number is divided and multiplied by ρ, ω, g in turn: a few roundings of 1.1e-16.
constexpr double roundings = 1e-15;

void expect_same_numbers(const hydro::potential::Coefficients& c, const hydro::potential::Coefficients& expected,
                         double of_X = roundings) {
  EXPECT_EQ(c.omega, expected.omega);
  EXPECT_EQ(c.heading, expected.heading);
  EXPECT_LT(largest_relative_error(c.A, expected.A), roundings);
  EXPECT_LT(largest_relative_error(c.B, expected.B), roundings);
  EXPECT_LT(largest_relative_error(c.X, expected.X), of_X);
  EXPECT_FALSE(c.A_zero.has_value());
  EXPECT_LT(largest_relative_error(listed(c.A_inf), listed(expected.A_inf)), roundings);
  EXPECT_LT(largest_relative_error(listed(c.C), listed(expected.C)), roundings);
}

TEST(BemioReader, UndoesTheNormalisationForSeveralBodies) {
  // (P10): A/ρ, B/(ρω), X/(ρg), C/(ρg); rows of one body over the columns of all
  TemporaryFolder folder;
  for (const int bodies : {1, 3}) {
    const BemioFile file{.body = {.bodies = bodies}};
    file.write(folder / "b.h5");
    const auto c = read(folder / "b.h5");
    expect_same_numbers(c, file.expected());
    ASSERT_EQ(c.bodies(), bodies);
    EXPECT_EQ(c.body[0].name, "buoy1");
    EXPECT_EQ(c.body.back().reference_point, Eigen::Vector3d(bodies - 1, 2, -3));
    EXPECT_THAT(c.notes, Contains(HasSubstr("centre of gravity")));
    EXPECT_TRUE(c.water.depth.is_infinite());
  }
}

TEST(BemioReader, TakesFilesThatHoldOnlyComponents) {
  TemporaryFolder folder;
  const BemioFile file{.body = {.bodies = 2}, .as_components = true};
  file.write(folder / "b.h5");
  expect_same_numbers(read(folder / "b.h5"), file.expected());
}

TEST(BemioReader, IgnoresComponentsBesideTheWhole) {
  TemporaryFolder folder;
  const BemioFile file{.both = true};
  file.write(folder / "b.h5");
  expect_same_numbers(read(folder / "b.h5"), file.expected());
}

TEST(BemioReader, TakesModulusAndPhase) {
  TemporaryFolder folder;
  BemioFile file{.polar = true};
  file.water.depth = hydro::WaterDepth::from_metres(40);
  file.write(folder / "b.h5");
  const auto c = read(folder / "b.h5");
  expect_same_numbers(c, file.expected(), 1e-14);  // phases up to π, rounded once
  EXPECT_EQ(c.water.depth.metres(), 40);
}

TEST(BemioReader, RefusesWhatItCannotMean) {
  TemporaryFolder folder;
  const auto refused = [&](BemioFile file, const char* rule) {
    file.write(folder / "b.h5");
    EXPECT_THAT([&] { read(folder / "b.h5"); }, ThrowsMessage<InputError>(HasSubstr(rule)));
  };
  refused({.dof = 8}, "body 1 has generalised modes");
  refused({.scaled = 1}, "not in BEMIO's normal form");
  refused({.omega = {0.4, 0.4}}, "0.4 rad/s is there twice");
  refused({.heading_deg = {10, 10}}, "heading 10 deg is there twice");
  refused({.add = [](auto& f) { f.write_scalar("/body3/properties/dof", 6); }}, "has 2 bodies, but the last is body3");
  refused({.add = [](auto& f) { f.write_scalar("/body2/properties/dof", 6); }}, "holds 108 numbers; (6, 12, 3)");
}

TEST(BemioReader, RefusesNanNamingItsPlace) {
  TemporaryFolder folder;
  const auto refused = [&](double SpoiltAt::*where, const char* rule) {
    BemioFile file;
    file.nan = SpoiltAt{};
    file.nan.*where = 0.9;
    file.write(folder / "b.h5");
    EXPECT_THAT([&] { read(folder / "b.h5"); }, ThrowsMessage<InputError>(HasSubstr(rule)));
  };
  refused(&SpoiltAt::A, "added mass (1, 1) of body 1 at w = 0.9 rad/s is nan");
  refused(&SpoiltAt::B, "radiation damping (1, 1) of body 1 at w = 0.9 rad/s is nan");
  refused(&SpoiltAt::X, "excitation 1 of body 1 at w = 0.9 rad/s is nan");
}

TEST(BemioReader, RefusesAFileThatIsCutShort) {
  TemporaryFolder folder;
  BemioFile{}.write(folder / "whole.h5");
  std::ifstream in(folder / "whole.h5", std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  for (const double part : {0.1, 0.5, 0.9, 0.999}) {
    const auto cut = folder.write("cut.h5", bytes.substr(0, static_cast<std::size_t>(part * double(bytes.size()))));
    EXPECT_THAT([&] { read(cut); }, ThrowsMessage<InputError>(HasSubstr("cut short"))) << part;
  }
}

TEST(BemioReader, RefusesAnHdf5FileOfAnotherKind) {
  TemporaryFolder folder;
  hydro::io::Hdf5Writer file;
  file.write_scalar("/temperature", 20);
  file.save(folder / "other.h5");
  EXPECT_THAT([&] { read(folder / "other.h5"); }, ThrowsMessage<InputError>(HasSubstr("none that holds coefficients")));
}

}  // namespace
}  // namespace bemio_reader_test
