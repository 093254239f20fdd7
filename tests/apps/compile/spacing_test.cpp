// What the spacing of the coefficients' frequencies does to responses is told, with a warning where it is too much.
#include "answers/spacing.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "answers/linear_response.hpp"
#include "apps/compile/scenes.hpp"
#include "hydro/potential/formats/writers.hpp"
#include "support/scratch.hpp"
#include "support/two_pole_body.hpp"

namespace spacing_test {
namespace {

using namespace froude;
using testing::AllOf;
using testing::HasSubstr;

/// A float that heaves, in water whose added mass and damping are known at any frequency (R9), written at frequencies
/// `spacing` apart.
std::filesystem::path write(double spacing) {
  constexpr double strength = 4e3, added = 1e3, stiffness = 20e3;
  const support::TwoPoleBody water{.decay = 0.5, .frequency = 2.5};
  hydro::potential::Coefficients c;
  c.water = {.density = 1000, .gravity = 9.80665, .depth = hydro::WaterDepth::from_metres(10)};
  c.body.push_back({.name = "float",
                    .reference_point = Eigen::Vector3d(0, 0, 0),
                    .centre_of_gravity = {},
                    .centre_of_buoyancy = {},
                    .displaced_volume = {}});
  const auto heave = [](double value) {
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(6, 6);
    out(2, 2) = value;
    return out;
  };
  for (double omega = 0.4; omega < 6.01; omega += spacing) {
    c.omega.push_back(omega);
    c.A.push_back(heave(added + strength * water.A_minus_A_inf(omega)));
    c.B.push_back(heave(strength * water.B(omega)));
  }
  c.heading = {0};
  c.X = {Eigen::MatrixXcd::Zero(6, std::ssize(c.omega))};
  for (std::size_t k = 0; k < c.omega.size(); ++k)
    c.X[0](2, static_cast<Eigen::Index>(k)) = stiffness * std::exp(-c.omega[k] / 2);
  c.A_inf = heave(added);
  c.C = heave(stiffness);
  c.source = "a float made for a test";
  const auto path = support::scratch_folder() / ("spacing_" + std::to_string(spacing) + ".h5");
  hydro::potential::write_froude(c, path);
  return path;
}

Responses responses(double spacing, const std::string& more) {
  const auto file = write(spacing);
  return respond(scene::parse(
      "schema = 1\n[water]\ndensity = \"1000 kg/m^3\"\ndepth = \"10 m\"\n"
      "[[body]]\nname = \"float\"\nmass = \"4000 kg\"\ncentre_of_gravity = \"(0, 0, 0) m\"\nfree = [\"heave\"]\n"
      "[body.hydrodynamics]\nfile = \"" +
          file.string() +
          "\"\naccept = [\"restoring matrix\", \"Haskind relation\"]\nhydrostatics = true\nexcitation = "
          "true\nradiation = {}\n[ask]\n"
          "rao = { periods = \"1.5 s .. 8 s, 41 values\", heading = \"0 deg\" , of = [\"float.heave\"] }\n" +
          more,
      file));
}

TEST(Spacing, TellsTheErrorOfResponses) {
  const std::string take = "accuracy = 1e-6\n[solve]\naccept_error = true\n";
  const Responses exact = responses(0.01, take);
  double peak = 0;
  for (const auto& v : exact.signals[0].values) peak = std::max(peak, std::abs(v));
  for (const double spacing : {0.4, 0.2, 0.1}) {
    const Responses r = responses(spacing, take);
    double off = 0;
    for (std::size_t i = 0; i < r.signals[0].values.size(); ++i)
      off = std::max(off, std::abs(r.signals[0].values[i] - exact.signals[0].values[i]) / peak);
    // It may not promise too much: a third, since largest errors of two spacings lie at different frequencies. Where
    // every fourth frequency misses the hump of B, errors seem to fall more slowly than they do: ten times.
    EXPECT_LT(r.error.total(0), 10 * off) << spacing;
    EXPECT_GT(r.error.total(0), off / 3) << spacing;
  }
}

TEST(Spacing, IsWarnedOfWhereItMissesTheAccuracyAsked) {
  EXPECT_THAT(responses(0.4, "accuracy = 1e-3\n").warnings(),
              testing::ElementsAre(AllOf(HasSubstr("float.heave is off by an estimated"), HasSubstr("of its peak"),
                                         HasSubstr("from the coefficients that the scene gives"))));
  const Responses fine = responses(0.05, "accuracy = 1e-2\n");
  EXPECT_THAT(fine.warnings(), testing::IsEmpty());
  EXPECT_THAT(fine.accuracy(), HasSubstr("by the coefficients"));
}

TEST(Spacing, SaysWhereThereAreTooFewFrequencies) {
  EXPECT_THAT(responses(1, "").accuracy(), HasSubstr("not estimated: "));
}

}  // namespace
}  // namespace spacing_test
