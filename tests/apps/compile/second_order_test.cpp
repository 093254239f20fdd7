// Wave loads of second order against plain sums over all pairs of waves.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <fstream>
#include <numbers>

#include "compile/compile.hpp"
#include "compile/waves.hpp"
#include "hydro/base/error.hpp"
#include "scenes.hpp"
#include "support/scratch.hpp"

namespace second_order_test {
namespace {

using namespace froude;
using dynamics::Vector6;
using hydro::InputError;
using hydro::waves::Component;
using testing::AllOf, testing::HasSubstr, testing::ThrowsMessage;
using Complex = std::complex<double>;

constexpr double pi = std::numbers::pi, degree = pi / 180, rho_g = 1000 * 9.81;
const std::vector<double> omega{0.6, 0.9, 1.1, 1.6, 3.0};

/// What the file says of two waves over ρg, forces and moments; Hermitian, as difference frequencies are.
Complex difference(int mode, double w1, double b1, double w2, double b2) {
  const double c = mode + 1;
  return {c * (1 + w1 * w2) + std::cos(b1 - b2) + b1 + b2, (w1 - w2) * (2 + c) + 0.3 * std::sin(b1 - b2)};
}
/// The same of sums, symmetric.
Complex sum(int mode, double w1, double b1, double w2, double b2) {
  return {0.1 * mode + w1 + w2 + b1 * b2, w1 * w2 - 0.2 * mode + b1 + b2};
}

using Transfer = Complex (*)(int, double, double, double, double);

/// Half of the matrix, as WAMIT writes it: PER1 at most PER2 of one heading, all pairs of two.
std::string file_of(Transfer T, const char* name, const std::vector<double>& headings_deg, int left_out = -1) {
  const auto path = support::scratch_folder() / name;
  std::ofstream out(path);
  out << " PER1 PER2 BETA1 BETA2 I MOD PHA RE IM\n";
  int row = 0;
  for (std::size_t b1 = 0; b1 < headings_deg.size(); ++b1)
    for (std::size_t b2 = b1; b2 < headings_deg.size(); ++b2)
      for (std::size_t k = 0; k < omega.size(); ++k)
        for (std::size_t l = b1 == b2 ? k : 0; l < omega.size(); ++l)
          for (int mode = 0; mode < 6; ++mode) {
            const Complex v = T(mode, omega[k], headings_deg[b1] * degree, omega[l], headings_deg[b2] * degree);
            if (row++ == left_out) continue;
            out << fmt::format("{:.16g} {:.16g} {} {} {} {:.16g} {:.16g} {:.16g} {:.16g}\n", 2 * pi / omega[k],
                               2 * pi / omega[l], headings_deg[b1], headings_deg[b2], mode + 1, std::abs(v),
                               std::arg(v) / degree, v.real(), v.imag());
          }
  return path.string();
}
std::string drift_file(const char* name) {
  const auto path = support::scratch_folder() / name;
  std::ofstream out(path);
  for (const double w : omega)
    for (int mode = 0; mode < 6; ++mode)
      out << fmt::format("{:.16g} 0 0 {} 1 0 {:.16g} 0\n", 2 * pi / w, mode + 1, difference(mode, w, 0, w, 0).real());
  return path.string();
}

const std::string sea =
    "kind = \"jonswap\"\nhs = \"0.5 m\"\ntp = \"5 s\"\nseed = 3\ncomponents = { repetition = \"150 s\" }\n";
const std::string regular = "kind = \"regular\"\nheight = \"0.8 m\"\nperiod = \"5 s\"\n";

scene::Scene scene_of(const std::string& waves, const std::string& heading, const std::string& loads) {
  return froude_test::parse(froude_test::water + "[waves]\n" + waves + "heading = \"" + heading + "\"\n" + R"([[body]]
name = "m"
position = "(20, 7, 0) m"
mass = "9088 kg"
centre_of_gravity = "(0.4, -0.2, 1.31) m"
radii_of_gyration = "(4.6, 4.6, 6.4) m"
[body.second_order]
)" + loads + R"([ask]
run = { duration = "20 s", every = "0.1 s" }
accuracy = 0.05
[solve]
step = "0.1 s"
)");
}

Vector6 load(const scene::Scene& scene, double t) {
  const compile::TimeModel model = compile::time_model(scene, compile::prepare(scene));
  dynamics::State state = model.start;
  state.time = t;
  Eigen::VectorXd out = Eigen::VectorXd::Zero(6);
  dynamics::LoadSink sink(out);
  for (const auto& kind : model.model.forces())
    if (kind->effect() == "second_order") kind->add_load({state, nullptr}, sink);
  return out;
}

/// T at any frequencies and headings, straight in each between those of the file: sixteen corners, one after another.
Complex between(Transfer T, const std::vector<double>& headings, int mode, const Component& a, const Component& b) {
  const auto weights = [](const std::vector<double>& x, double at) {
    std::vector<std::pair<double, double>> out;  // place and weight
    if (x.size() == 1) return std::vector{std::pair{x[0], 1.0}};
    std::size_t i = 0;
    while (i + 2 < x.size() && x[i + 1] <= at) ++i;
    const double u = (at - x[i]) / (x[i + 1] - x[i]);
    return std::vector{std::pair{x[i], 1 - u}, std::pair{x[i + 1], u}};
  };
  Complex out = 0;
  for (const auto& [w1, f1] : weights(omega, a.omega))
    for (const auto& [w2, f2] : weights(omega, b.omega))
      for (const auto& [b1, g1] : weights(headings, a.heading))
        for (const auto& [b2, g2] : weights(headings, b.heading)) out += f1 * f2 * g1 * g2 * T(mode, w1, b1, w2, b2);
  return out;
}

/// Every wave with every other, at the body's origin; moments then about the centre of gravity.
Vector6 plain(const scene::Scene& scene, const std::vector<double>& headings, double t, bool with_sums) {
  auto waves = compile::make_sea(scene).components();
  std::erase_if(waves, [](const Component& c) { return c.omega < omega.front() || c.omega > omega.back(); });
  const auto phase = [&](const Component& c) {
    return c.omega * t + c.phase - c.k * (20 * std::cos(c.heading) + 7 * std::sin(c.heading));
  };
  Vector6 F = Vector6::Zero();
  for (const Component& a : waves)
    for (const Component& b : waves)
      for (int mode = 0; mode < 6; ++mode) {
        const double amplitudes = a.amplitude * b.amplitude * rho_g;
        F[mode] +=
            amplitudes * (between(difference, headings, mode, a, b) * std::polar(1.0, phase(a) - phase(b))).real();
        if (with_sums)
          F[mode] += amplitudes * (between(sum, headings, mode, a, b) * std::polar(1.0, phase(a) + phase(b))).real();
      }
  const Eigen::Vector3d r(0.4, -0.2, 1.31);
  F.tail<3>() += F.head<3>().cross(r);
  return F;
}

/// Rounding of ten thousand pairs and of the sea's phases.
void expect_near(const Vector6& found, const Vector6& expected) {
  EXPECT_LT((found - expected).norm(), 1e-9 * expected.norm()) << found.transpose() << '\n' << expected.transpose();
}

TEST(SecondOrder, IsTheSumOverAllPairsOfWavesOfOneHeading) {
  const auto scene = scene_of(sea, "0 deg",
                              "method = \"full\"\nfile = \"" + file_of(difference, "a.12d", {0}) + "\"\nsum = \"" +
                                  file_of(sum, "a.12s", {0}) + "\"\n");
  ASSERT_GT(compile::make_sea(scene).components().size(), 30u);
  for (const double t : {0.0, 7.3, 12.34567}) expect_near(load(scene, t), plain(scene, {0}, t, true));
}

TEST(SecondOrder, IsTheSumOverAllPairsOfWavesOfASpreadSea) {
  const std::vector<double> degrees{-180, -30, 20, 180};
  const auto scene = scene_of(sea + "spreading = { kind = \"cos2s\", s = 4 }\n", "10 deg",
                              "method = \"full\"\nfile = \"" + file_of(difference, "s.12d", degrees) + "\"\n");
  std::vector<double> headings;
  for (const double d : degrees) headings.push_back(d * degree);
  const auto spread = compile::make_sea(scene);
  for (const Component& c : spread.components()) ASSERT_LE(std::abs(c.heading), 180 * degree);
  for (const double t : {0.0, 7.3, 12.34567}) expect_near(load(scene, t), plain(scene, headings, t, false));
}

// A² ρg T(ω; ω) and nothing else; between two frequencies of the file as its diagonal, or its pairs, are.
TEST(SecondOrder, OfOneWaveIsItsMeanDrift) {
  const double w = 2 * pi / 5;
  Vector6 expected;
  const double u = (w - 1.1) / 0.5;
  for (int mode = 0; mode < 6; ++mode)
    expected[mode] =
        0.16 * rho_g * ((1 - u) * difference(mode, 1.1, 0, 1.1, 0) + u * difference(mode, 1.6, 0, 1.6, 0)).real();
  expected.tail<3>() += expected.head<3>().cross(Eigen::Vector3d(0.4, -0.2, 1.31));
  for (const char* method : {"mean", "newman"})
    for (const std::string& file : {drift_file("m.8"), file_of(difference, "m.12d", {0})}) {
      const auto scene = scene_of(regular, "0 deg", fmt::format("method = \"{}\"\nfile = \"{}\"\n", method, file));
      for (const double t : {0.0, 3.21}) expect_near(load(scene, t), expected);
    }
}

// T(1; 2) = ½ (D(1) + D(2)) is what Newman's approximation supposes.
TEST(SecondOrder, NewmansApproximationIsExactWhereItsPairsAreMeans) {
  const Transfer means = [](int mode, double w1, double, double w2, double) -> Complex {
    return 0.5 * (difference(mode, w1, 0, w1, 0).real() + difference(mode, w2, 0, w2, 0).real());
  };
  const std::string file = file_of(means, "n.12d", {0});
  const auto full = scene_of(sea, "0 deg", "method = \"full\"\nfile = \"" + file + "\"\n"),
             newman = scene_of(sea, "0 deg", "method = \"newman\"\nfile = \"" + file + "\"\n");
  for (const double t : {0.0, 7.3, 12.34567}) expect_near(load(newman, t), load(full, t));
}

TEST(SecondOrder, MeanIsThatOverARepetitionOfTheSea) {
  const std::string file = file_of(difference, "r.12d", {0});
  const auto newman = scene_of(sea, "0 deg", "method = \"newman\"\nfile = \"" + file + "\"\n"),
             mean = scene_of(sea, "0 deg", "method = \"mean\"\nfile = \"" + file + "\"\n");
  const Vector6 constant = load(mean, 0);
  const compile::TimeModel model = compile::time_model(newman, compile::prepare(newman));
  Vector6 average = Vector6::Zero();
  constexpr int samples = 500;  // of 0.3 s: more than twice the highest difference
  for (int i = 0; i < samples; ++i) {
    dynamics::State state = model.start;
    state.time = 150.0 * i / samples;
    Eigen::VectorXd out = Eigen::VectorXd::Zero(6);
    dynamics::LoadSink sink(out);
    for (const auto& kind : model.model.forces())
      if (kind->effect() == "second_order") kind->add_load({state, nullptr}, sink);
    average += out / samples;
  }
  expect_near(average, constant);
}

TEST(SecondOrder, RefusesWhatItsFilesDoNotTell) {
  const auto refused = [](const std::string& waves, const std::string& heading, const std::string& loads) {
    return [=] { load(scene_of(waves, heading, loads), 0); };
  };
  const std::string file = "file = \"" + file_of(difference, "e.12d", {0}) + "\"\n", full = "method = \"full\"\n";
  using Error = hydro::InputError;
  EXPECT_THAT(refused(regular, "30 deg", full + file),
              ThrowsMessage<Error>(AllOf(HasSubstr("towards 30 deg"), HasSubstr("0 to 0 deg"))));
  EXPECT_THAT(refused("kind = \"regular\"\nheight = \"0.8 m\"\nperiod = \"12 s\"\n", "0 deg", full + file),
              ThrowsMessage<Error>(HasSubstr("outside the frequencies")));
  EXPECT_THAT(refused(sea + "spreading = { kind = \"cos2s\", s = 4 }\n", "0 deg", "method = \"newman\"\n" + file),
              ThrowsMessage<Error>(HasSubstr("one heading")));
  EXPECT_THAT(refused(regular, "0 deg", full + "file = \"" + drift_file("e.8") + "\"\n"),
              ThrowsMessage<Error>(HasSubstr("needs .10d")));
  EXPECT_THAT(refused(regular, "0 deg", full + "file = \"" + file_of(sum, "e.12s", {0}) + "\"\n"),
              ThrowsMessage<Error>(HasSubstr("as `sum`")));
  EXPECT_THAT(refused(regular, "0 deg", full + "file = \"" + file_of(difference, "hole.12d", {0}, 8) + "\"\n"),
              ThrowsMessage<Error>(AllOf(HasSubstr("no row"), HasSubstr("mode 3"))));
  EXPECT_THAT(refused(regular, "0 deg", full + "file = \"pontoon1.1\"\n"),
              ThrowsMessage<Error>(HasSubstr("no file of second-order loads")));
  EXPECT_THAT(refused(regular, "0 deg", full + file + "body = 2\n"), ThrowsMessage<Error>(HasSubstr("body 2")));
}

// Loads of both orders of two waves must be one real load.
TEST(SecondOrder, RefusesHalvesThatDoNotAgree) {
  const std::string path = file_of(difference, "halves.12d", {0});
  const auto add = [&](double sign) {
    const Complex v = difference(0, omega[0], 0, omega[1], 0);
    std::ofstream(path, std::ios::app) << fmt::format("{:.16g} {:.16g} 0 0 1 {:.16g} {:.16g} {:.16g} {:.16g}\n",
                                                      2 * pi / omega[1], 2 * pi / omega[0], std::abs(v),
                                                      sign * std::arg(v) / degree, v.real(), sign * v.imag());
  };
  const std::string loads = fmt::format("method = \"full\"\nfile = \"{}\"\n", path);
  add(-1);
  EXPECT_NO_THROW(load(scene_of(sea, "0 deg", loads), 3));
  file_of(difference, "halves.12d", {0});
  add(1);
  EXPECT_THAT([&] { load(scene_of(sea, "0 deg", loads), 3); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("same two waves"), HasSubstr("the conjugate of T(1; 2)"))));
}

// From 330 to 360 degrees the loads go on to those of 0.
TEST(SecondOrder, GoesRoundTheCircle) {
  const auto path = support::scratch_folder() / "round.9";
  std::ofstream out(path);
  for (const double w : omega)
    for (int heading = 0; heading < 360; heading += 30)
      for (int mode = 0; mode < 6; ++mode)
        out << fmt::format("{:.16g} {} {} {} 1 0 {:.16g} 0\n", 2 * pi / w, heading, heading, mode + 1,
                           (mode + 1) * (2 + std::cos(heading * degree)));
  out.close();
  const auto at = [&](const std::string& heading) {
    return load(scene_of(regular, heading, fmt::format("method = \"mean\"\nfile = \"{}\"\n", path.string())), 3);
  };
  const Vector6 between = at("345 deg"), expected = (at("330 deg") + at("0 deg")) / 2;
  EXPECT_LT((between - expected).norm(), 1e-9 * expected.norm());  // straight between the two
  EXPECT_LT((at("-15 deg") - between).norm(), 1e-9 * expected.norm());
}

TEST(SecondOrder, IsRefusedInACurrent) {
  scene::Scene scene = scene_of(regular, "0 deg", fmt::format("method = \"mean\"\nfile = \"{}\"\n", drift_file("c.9")));
  scene.current_place = scene.waves->place;
  EXPECT_THAT([&] { load(scene, 3); }, ThrowsMessage<InputError>(HasSubstr("those of still water")));
}

}  // namespace
}  // namespace second_order_test
