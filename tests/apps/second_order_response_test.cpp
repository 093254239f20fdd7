// What second-order loads add to responses in seas: closed forms, plain sums over pairs of waves, loads of runs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <fstream>
#include <numbers>
#include <sstream>

#include "answers/response_check.hpp"
#include "answers/response_spectra.hpp"
#include "answers/sea_directions.hpp"
#include "answers/second_order_loads.hpp"
#include "answers/second_order_spectra.hpp"
#include "compile/compile.hpp"
#include "compile/members.hpp"
#include "froude/commands.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/atomic_file.hpp"
#include "hydro/waves/dispersion.hpp"
#include "hydro/waves/spectra/spectrum.hpp"
#include "support/scratch.hpp"

namespace second_order_response_test {
namespace {

using namespace froude;
using Pairs = SecondOrderLoads::Pairs;
using Complex = std::complex<double>;
using testing::HasSubstr, testing::ThrowsMessage;

constexpr double pi = std::numbers::pi, rho_g = 1000 * 9.81;

/// T/(ρg) of surge; Hermitian as differences are, symmetric as sums are. Straight in each frequency, so that a file has
/// it exactly.
Complex constant(double, double) { return 3; }
Complex difference(double w1, double w2) { return {1 + 0.5 * (w1 + w2), 2 * (w1 - w2)}; }
Complex mean_of_two(double w1, double w2) { return 1 + 0.5 * (w1 + w2); }
Complex sum(double w1, double w2) { return {0.3 * (w1 + w2), 0.5 * w1 * w2}; }
using Transfer = Complex (*)(double, double);

constexpr double low = 0.4, high = 4;  // rad/s, of files: all but 1e-3 of the sea
std::string file_of(Transfer T, const char* name, const std::vector<double>& headings_deg = {0}) {
  const auto path = support::scratch_folder() / name;
  std::ofstream out(path);
  constexpr int n = 13;
  for (const double b1 : headings_deg)
    for (const double b2 : headings_deg)
      for (int k = 0; k < n; ++k)
        for (int l = 0; l < n; ++l)
          for (int mode = 1; mode <= 6; ++mode) {
            const double w1 = low + (high - low) * k / (n - 1), w2 = low + (high - low) * l / (n - 1);
            const Complex v = mode == 1 ? T(w1, w2) : 0;
            out << fmt::format("{:.15g} {:.15g} {} {} {} {:.15g} {:.15g} {:.15g} {:.15g}\n", 2 * pi / w1, 2 * pi / w2,
                               b1, b2, mode, std::abs(v), std::arg(v) * 180 / pi, v.real(), v.imag());
          }
  return path.string();
}

/// A body that springs alone hold: surge answers as 1/(k − mω² + icω).
constexpr double m = 9000, k = 3000, c = 900;
std::string body_text(const std::string& name, const std::string& place, const std::string& loads,
                      const std::string& surge = "surge = \"3 kN/m\", ") {
  return "[[body]]\nname = \"" + name + "\"\nposition = \"" + place +
         "\"\nmass = \"9 t\"\ncentre_of_gravity = \"(0, 0, 0) m\"\nradii_of_gyration = \"(4, 4, 5) m\"\n"
         "[body.second_order]\n" +
         loads + "[[mooring]]\non = \"" + name + "\"\nkind = \"linear\"\nstiffness = { " + surge +
         "sway = \"3 kN/m\", heave = \"900 kN/m\", roll = \"9 MN m/rad\", pitch = \"9 MN m/rad\", yaw = \"9 MN m/rad\" "
         "}\ndamping = { surge = \"900 N s/m\", sway = \"900 N s/m\", heave = \"9 kN s/m\", roll = \"90 kN m s/rad\", "
         "pitch = \"90 kN m s/rad\", yaw = \"90 kN m s/rad\" }\n";
}

scene::Scene scene_of(const std::string& bodies, const std::string& sea = "", int seed = 1) {
  auto out = scene::parse(
      "schema = 1\n[water]\ndensity = \"1000 kg/m^3\"\ngravity = \"9.81 m/s^2\"\ndepth = \"50 m\"\n"
      "[waves]\nkind = \"jonswap\"\nhs = \"1 m\"\ntp = \"6 s\"\nheading = \"0 deg\"\nseed = " +
          std::to_string(seed) + "\n" + sea + bodies +
          "[ask]\nrun = { duration = \"20 s\", every = \"0.1 s\" }\naccuracy = 5e-3\n[solve]\nstep "
          "= \"0.1 s\"\n",
      "scene.toml");
  out.rao.emplace();  // which a reader allows only where first-order waves act
  out.rao->of = {"*.surge", "*.pitch"};
  return out;
}

double density(const scene::Scene& scene, double omega) {
  return random_sea(scene).systems.front().spectrum->density(omega);
}
double variance(const hydro::signal::SpectrumPerHz& s) { return hydro::signal::moments(s, hydro::signal::whole(s)).m0; }

SecondOrderLoads loads_of(const scene::Scene& scene) {
  std::vector<std::string> notes;
  return {scene, compile::prepare(scene).bodies, rays_of(random_sea(scene), 1), notes};
}
Eigen::VectorXd diagonal(const Eigen::MatrixXcd& S) { return S.diagonal().real(); }

double load_variance(const SecondOrderLoads& loads, Pairs pairs) {
  constexpr int n = 400;
  const double from = loads.lowest(pairs), h = (loads.highest(pairs) - from) / n;
  double out = 0;
  for (int i = 0; i < n; ++i) out += h * loads.spectrum(pairs, from + (i + 0.5) * h, 1e-4, diagonal)(0, 0).real();
  return out;
}

// T constant: F = T|A|² of the sea's complex amplitude A, so F is exponentially distributed with deviation = mean =
// 2 T m₀, and Re(T A²) has the same deviation.
TEST(SecondOrderLoads, OfAConstantTransferFunctionHaveTheDeviationOfTheSquareOfAnAmplitude) {
  const auto scene = scene_of(body_text("m", "(0, 0, 0) m",
                                        "method = \"full\"\nfile = \"" + file_of(constant, "c.12d") + "\"\nsum = \"" +
                                            file_of(constant, "c.12s") + "\"\n"));
  const double T = 3 * rho_g, m0 = random_sea(scene).systems.front().spectrum->energy(low, high);
  const SecondOrderLoads loads = loads_of(scene);
  EXPECT_NEAR(loads.mean(1e-4)[0], 2 * T * m0, 1e-4 * 2 * T * m0);  // the tolerance asked
  for (const Pairs pairs : {Pairs::differences, Pairs::sums})
    EXPECT_NEAR(std::sqrt(load_variance(loads, pairs)), 2 * T * m0, 1e-3 * 2 * T * m0);  // 400 midpoints
}

// 8 ∫ S(ω + μ) S(ω) |T|² dω, between two bodies with the phases of the ways to each.
TEST(SecondOrderLoads, BetweenTwoBodiesAreAPlainSum) {
  const std::string file = "method = \"full\"\nfile = \"" + file_of(difference, "two.12d") + "\"\n";
  const auto scene = scene_of(body_text("a", "(0, 0, 0) m", file) + body_text("b", "(15, 4, 0) m", file));
  const SecondOrderLoads loads = loads_of(scene);
  const double mu = 0.37;
  constexpr int n = 20000;
  const double h = (high - mu - low) / n;
  Complex cross = 0;
  for (int i = 0; i < n; ++i) {
    const double w = low + (i + 0.5) * h;
    const double way = 15 * (hydro::waves::wavenumber(w + mu, scene.water) - hydro::waves::wavenumber(w, scene.water));
    // Of the load on a with that on b, conjugated: b's phase −way counts as +way.
    cross += h * 8 * density(scene, w + mu) * density(scene, w) * std::norm(rho_g * difference(w + mu, w)) *
             std::polar(1.0, way);
  }
  const auto both = [](const Eigen::MatrixXcd& S) {
    return Eigen::VectorXd(Eigen::Vector2d(S(0, 6).real(), S(0, 6).imag()));
  };
  EXPECT_LT(std::abs(loads.spectrum(Pairs::differences, mu, 1e-5, both)(0, 6) - cross), 1e-5 * std::abs(cross));
}

// A realisation's own loads, whose sum over pairs a test of runs has to 1e-9: over a repetition of sixty seas.
TEST(SecondOrderLoads, HaveTheMeanAndVarianceOfTheLoadsOfRuns) {
  const std::string loads = "method = \"full\"\nfile = \"" + file_of(difference, "run.12d") + "\"\n";
  const auto scene = [&](int seed) {
    return scene_of(body_text("m", "(0, 0, 0) m", loads),
                    "components = { repetition = \"300 s\", lowest = \"0.064 Hz\", highest = \"0.63 Hz\" }\n", seed);
  };
  constexpr int seeds = 60, samples = 1000;
  std::vector<double> variances;
  double mean = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    const auto one = scene(seed);
    const compile::TimeModel model = compile::time_model(one, compile::prepare(one));
    double sum = 0, squares = 0;
    for (int i = 0; i < samples; ++i) {
      dynamics::State state = model.start;
      state.time = 300.0 * i / samples;
      Eigen::VectorXd F = Eigen::VectorXd::Zero(6);
      dynamics::LoadSink sink(F);
      for (const auto& kind : model.model.forces())
        if (kind->effect() == "second_order") kind->add_load({state, nullptr}, sink);
      sum += F[0] / samples;
      squares += F[0] * F[0] / samples;
    }
    mean += sum / seeds;
    variances.push_back(squares - sum * sum);
  }
  double average = 0, scatter = 0;
  for (const double v : variances) average += v / seeds;
  for (const double v : variances) scatter += (v - average) * (v - average) / (seeds - 1);
  const double error = std::sqrt(scatter / seeds);
  ASSERT_LT(error, 0.05 * average);
  const auto first = scene(1);
  const SecondOrderLoads found = loads_of(first);
  // Each sea has the same energy, and so the same mean, to that of its bins of 1/300 Hz.
  EXPECT_NEAR(found.mean(1e-4)[0], mean, 2e-3 * mean);
  EXPECT_NEAR(load_variance(found, Pairs::differences), average, 4 * error);  // one in 16 000 by chance
}

// The mean over the spring, and through 1/(k − mμ² + icμ) the plain sum over all pairs of 600 waves.
TEST(SecondOrderResponses, AreAPlainSumOverPairsThroughASpring) {
  const auto scene = scene_of(body_text(
      "m", "(20, 7, 0) m",
      "method = \"full\"\nfile = \"" + file_of(difference, "r.12d") + "\"\nsum = \"" + file_of(sum, "r.12s") + "\"\n"));
  const auto found = second_order_responses(scene)->signals.front();
  constexpr int n = 600;
  const double h = (high - low) / n;
  const auto answer = [](double w) { return std::norm(1.0 / Complex(k - m * w * w, c * w)); };
  double offset = 0, slow = 0, fast = 0;
  for (int i = 0; i < n; ++i) {
    const double w1 = low + (i + 0.5) * h, a1 = 2 * h * density(scene, w1);  // amplitude squared
    offset += a1 * rho_g * difference(w1, w1).real() / k;
    for (int j = 0; j <= i; ++j) {  // a wave with itself: half of the square that the bins span
      const double w2 = low + (j + 0.5) * h, a2 = (i == j ? 0.5 : 1) * 2 * h * density(scene, w2);
      slow += 2 * a1 * a2 * std::norm(rho_g * difference(w1, w2)) * answer(w1 - w2);
      fast += 2 * a1 * a2 * std::norm(rho_g * sum(w1, w2)) * answer(w1 + w2);
    }
  }
  ASSERT_EQ(found.name, "m.surge");
  EXPECT_NEAR(found.offset, offset, 5e-3 * offset);      // the accuracy asked
  EXPECT_NEAR(variance(found.slow), slow, 5e-3 * slow);  // likewise
  EXPECT_NEAR(variance(found.sum), fast, 5e-3 * fast);
  EXPECT_GT(variance(found.slow), 100 * variance(found.sum));  // the spring resonates at 0.58 rad/s
}

TEST(SecondOrderResponses, OfNewmansApproximationAreThoseOfPairsThatAreMeans) {
  const std::string file = "file = \"" + file_of(mean_of_two, "n.12d") + "\"\n";
  const auto by = [&](const std::string& method) {
    return second_order_responses(scene_of(body_text("m", "(20, 7, 0) m", "method = \"" + method + "\"\n" + file)))
        ->signals.front();
  };
  const auto full = by("full"), newman = by("newman"), mean = by("mean");
  EXPECT_DOUBLE_EQ(newman.offset, full.offset);
  EXPECT_NEAR(variance(newman.slow), variance(full.slow), 1e-9 * variance(full.slow));  // rounding
  EXPECT_DOUBLE_EQ(mean.offset, full.offset);
  EXPECT_TRUE(mean.slow.density.empty());
  EXPECT_TRUE(full.sum.density.empty());
}

// A transfer function that does not know headings has the same answer in a spread sea.
TEST(SecondOrderResponses, OfASpreadSeaSumOverBothHeadings) {
  const auto with = [&](const std::string& sea) {
    const std::string file = file_of(difference, "s.12d", {-180, 0, 180});
    auto scene = scene_of(body_text("m", "(20, 7, 0) m", "method = \"full\"\nfile = \"" + file + "\"\n"), sea);
    // The same frequencies for both, and few: shares of sectors add up to one however many there are.
    scene.accuracy.value = 0.3;
    return second_order_responses(scene)->signals.front();
  };
  const auto plane = with(""), spread = with("spreading = { kind = \"cos2s\", s = 4 }\n");
  EXPECT_NEAR(spread.offset, plane.offset, 1e-6 * plane.offset);  // shares of sectors add up to one
  EXPECT_NEAR(variance(spread.slow), variance(plane.slow), 1e-6 * variance(plane.slow));
}

/// A leg through the surface whose drag limits the surge, and frequencies at which its own waves are resolved.
std::string with_leg(const std::string& loads) {
  return body_text("m", "(20, 7, 0) m", loads) +
         "[[member]]\nname = \"leg\"\non = \"m\"\nfrom = \"(0, 0, -5) m\"\nto = \"(0, 0, 0) m\"\n"
         "diameter = \"1.5 m\"\ndrag = { cd = 1.2 }\n";
}
std::vector<double> resolved() {
  std::vector<double> out;
  for (int i = 0; i <= 400; ++i) out.push_back(low + (high - low) * i / 400);
  return out;
}

/// Σ cβ of the pieces of a leg that surges with a body, and the variance of its slow surge, m²: all by sums over waves.
struct LegInSea {
  double drag, slow;
};
LegInSea leg_in_sea(const scene::Scene& scene, bool with_slow) {
  const auto pieces = compile::drag_of_responses(scene, compile::prepare(scene).bodies).pieces;
  constexpr int n = 600;
  const double h = (high - low) / n, deep = scene.water.depth.metres();
  const auto omega = [&](int i) { return low + (i + 0.5) * h; };
  std::vector<double> variance;  // of the elevation of each wave
  for (int i = 0; i < n; ++i) variance.push_back(h * density(scene, omega(i)));
  std::vector<double> drag(pieces.size(), 500.0);
  LegInSea out{};
  for (int turn = 0; turn < 60; ++turn) {
    out.drag = 0;
    for (const double d : drag) out.drag += d;
    const auto answer = [&](double w) { return 1.0 / Complex(k - m * w * w, (c + out.drag) * w); };
    std::vector<double> squares(pieces.size(), 0.0);  // of relative velocities
    for (int i = 0; i < n; ++i) {
      const double w = omega(i), wavenumber = hydro::waves::wavenumber(w, scene.water);
      std::vector<double> u;
      Complex load = 0;
      for (std::size_t p = 0; p < pieces.size(); ++p) {
        u.push_back(w * std::cosh(wavenumber * (pieces[p].arm.z() + deep)) / std::sinh(wavenumber * deep));
        load += drag[p] * u[p];
      }
      for (std::size_t p = 0; p < pieces.size(); ++p)
        squares[p] += variance[static_cast<std::size_t>(i)] * std::norm(u[p] - Complex(0, w) * answer(w) * load);
    }
    double speed = 0;
    out.slow = 0;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < i; ++j) {
        const double mu = omega(i) - omega(j);
        const double of_pair = 8 * variance[static_cast<std::size_t>(i)] * variance[static_cast<std::size_t>(j)] *
                               std::norm(rho_g * difference(omega(i), omega(j)) * answer(mu));
        out.slow += of_pair, speed += mu * mu * of_pair;
      }
    for (std::size_t p = 0; p < pieces.size(); ++p)
      drag[p] = pieces[p].factor * std::sqrt(8 / pi) * std::sqrt(squares[p] + (with_slow ? speed : 0));
  }
  return out;
}

// (D151): the leg's own fixed point in one degree of freedom, every sum over all waves or pairs of them.
TEST(SecondOrderResponses, OfALegAreDampedByItsDragInWavesAndSlowDriftTogether) {
  const auto scene = scene_of(with_leg("method = \"full\"\nfile = \"" + file_of(difference, "leg.12d") + "\"\n"));
  const auto found = second_order_responses(scene, std::make_shared<compile::Kept>(), resolved());
  const LegInSea leg = leg_in_sea(scene, true);
  ASSERT_EQ(found->signals.front().name, "m.surge");
  // The accuracy asked, 5e-3, and as much for the bins of the plain sum and the pitch of 9 MN m/rad that it has not.
  EXPECT_NEAR(variance(found->signals.front().slow), leg.slow, 1e-2 * leg.slow);
  EXPECT_GT(leg_in_sea(scene, false).slow, 1.2 * leg.slow);  // by the velocities of waves alone
  const std::string told = "drag on members damps slow drift: ";
  ASSERT_THAT(found->notes.front(), HasSubstr(told));
  EXPECT_NEAR(std::stod(found->notes.front().substr(told.size())), leg.drag, 1e-2 * leg.drag);
}

// Quadratic drag and all: runs of the same sea in other seeds.
TEST(SecondOrderResponses, OfALegHaveTheDeviationOfRuns) {
  auto scene = scene_of(with_leg("method = \"newman\"\nfile = \"" + file_of(mean_of_two, "legs.12d") + "\"\n"),
                        "components = { repetition = \"1500 s\" }\n");
  scene.rao->of = {"m.surge"};
  scene.rao->omega = resolved();
  scene.solve.step.reset();
  const auto kept = std::make_shared<compile::Kept>();
  const ResponseSpectra first = response_spectra({&scene}, kept).front();
  const auto slow = second_order_responses(scene, kept, resolved())->signals.front();
  constexpr int runs = 24;
  const CheckedStatistics of_runs = check_by_runs(scene, first, 900, runs, 2, kept, {}).front();
  const double deviation = std::sqrt(variance(first.signals.front().spectrum) + variance(slow.slow));
  // Three standard errors, one in 300 by chance; 2 % for drag that is linear, as (D143) is from runs without slow
  // drift.
  EXPECT_NEAR(deviation, of_runs.deviation.mean, 3 * of_runs.deviation.error + 0.02 * deviation);
  EXPECT_NEAR(slow.offset, of_runs.mean.mean, 3 * of_runs.mean.error + 0.02 * slow.offset);
  EXPECT_LT(of_runs.deviation.error, 0.03 * deviation);
}

TEST(SecondOrderResponses, RefuseByName) {
  const std::string file = "file = \"" + file_of(difference, "e.12d") + "\"\n";
  const auto refused = [](const scene::Scene& scene) { return [=] { second_order_responses(scene); }; };
  EXPECT_THAT(refused(scene_of(body_text("m", "(0, 0, 0) m", "method = \"full\"\n" + file, ""))),
              ThrowsMessage<hydro::NumericsError>(testing::AllOf(HasSubstr("constant load"), HasSubstr("m.surge"))));
  EXPECT_THAT(refused(scene_of(body_text("m", "(0, 0, 0) m", "method = \"newman\"\n" + file),
                               "spreading = { kind = \"cos2s\", s = 4 }\n")),
              ThrowsMessage<hydro::InputError>(HasSubstr("one heading")));
  EXPECT_THAT(refused(scene_of(body_text("m", "(0, 0, 0) m", "method = \"full\"\n" + file),
                               "spreading = { kind = \"cos2s\", s = 4 }\n")),
              ThrowsMessage<hydro::InputError>(HasSubstr("the second-order loads are for 0 to 0 deg")));
  const std::string floating = "sum = \"" + file_of(sum, "e.12s") + R"("
[body.hydrodynamics]
radiation = {}
[body.hydrodynamics.cylinders]
at = "(0, 0, 0) m"
diameter = "2 m"
draught = "2.9 m"
frequencies = "0.2 rad/s .. 3 rad/s, 29 values"
)";
  EXPECT_THAT(refused(scene_of(body_text("m", "(0, 0, 0) m", "method = \"full\"\n" + file + floating))),
              ThrowsMessage<hydro::InputError>(HasSubstr("have a sum of frequencies above the 3 rad/s")));
}

TEST(SecondOrderResponses, AreInThePictureAndLeftOutOfALifetime) {
  const auto folder = support::scratch_folder();
  const std::string loads =
      "method = \"full\"\nfile = \"" + file_of(difference, "p.12d") + "\"\nsum = \"" + file_of(sum, "p.12s") + "\"\n";
  const std::string excited = R"([body.hydrodynamics]
excitation = true
[body.hydrodynamics.cylinders]
at = "(0, 0, 0) m"
diameter = "2 m"
draught = "2.9 m"
frequencies = "0.4 rad/s .. 4 rad/s, 20 values"
)";
  hydro::io::write_atomically(
      folder / "second.toml",
      "schema = 1\n[water]\ndensity = \"1000 kg/m^3\"\ndepth = \"50 m\"\n[waves]\nkind = \"jonswap\"\nhs = \"1 m\"\n"
      "tp = \"6 s\"\nheading = \"0 deg\"\n" +
          body_text("m", "(0, 0, 0) m", loads + excited) +
          "[ask]\naccuracy = 5e-2\nrao = { periods = \"1.7 s .. 15 s, 20 values\", of = [\"m.surge\"] }\n");
  hydro::io::write_atomically(folder / "seas.csv", "hs [m], tp [s], share\n1, 6, 1\n");
  std::ostringstream out, err;
  const Console console{out, err, true};
  response({.scene = folder / "second.toml", .picture = folder / "second.svg"}, console);
  std::stringstream picture;
  picture << std::ifstream(folder / "second.svg").rdbuf();
  EXPECT_THAT(picture.str(), testing::AllOf(HasSubstr("m.surge slow"), HasSubstr("m.surge sums")));
  out.str("");
  response({.scene = folder / "second.toml", .duration = "1000 h", .scatter = folder / "seas.csv"}, console);
  EXPECT_THAT(out.str(), HasSubstr("wave loads of second order are left out of a lifetime"));
}

}  // namespace
}  // namespace second_order_response_test
