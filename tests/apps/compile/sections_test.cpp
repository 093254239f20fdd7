// Sectional loads of floating hulls in waves: a barge whose mass is spread as a box of its length, breadth and depth.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <filesystem>
#include <fstream>

#include "answers/linear_response.hpp"
#include "answers/simulate.hpp"
#include "hydro/base/error.hpp"
#include "hydro/hydrostatics/shape_meshes.hpp"
#include "scene/scene.hpp"
#include "support/scratch.hpp"

namespace sections_test {
namespace {

namespace fs = std::filesystem;
using namespace froude;
using Complex = std::complex<double>;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double L = 40, B = 2, T = 1, rho = 1000, g = 9.81, mass = rho * L * B * T;

using Pieces = std::array<int, 3>;

/// A folder with the mesh of the barge, from 1 m under to 0.5 m above water.
fs::path folder(const Pieces& pieces = {10, 2, 3}) {
  const fs::path out = support::scratch_folder() / testing::UnitTest::GetInstance()->current_test_info()->name();
  fs::create_directories(out);
  const auto mesh = hydro::hydrostatics::box_mesh({-L / 2, -B / 2, -T}, {L / 2, B / 2, T / 2}, pieces,
                                                  hydro::hydrostatics::Spacing::equal);
  std::ofstream file(out / "barge.obj");
  for (const Eigen::Vector3d& v : mesh.vertices) file << fmt::format("v {} {} {}\n", v.x(), v.y(), v.z());
  for (const auto& t : mesh.triangles) file << fmt::format("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
  return out;
}

/// Mass, centre of gravity and inertia of the barge from x = `from` to x = `to`: a box of this height, or a rod if it
/// is zero, at z = `z`.
struct Lengthwise {
  double height = 1.2, z = -0.4;
  std::string keys(double from, double to) const {
    const double l = to - from, b = height > 0 ? B : 0, h = height, thin = 1e-6;
    return fmt::format(
        "mass = \"{:.17g} kg\"\ncentre_of_gravity = \"({:.17g}, 0, {}) m\"\nradii_of_gyration = \"({:.17g}, {:.17g}, "
        "{:.17g}) m\"\n",
        mass * l / L, (from + to) / 2, z, std::sqrt((b * b + h * h) / 12 + thin), std::sqrt((l * l + h * h) / 12),
        std::sqrt((l * l + b * b) / 12));
  }
};

std::string section(const std::string& name, double x, const Lengthwise& spread, bool ahead = true,
                    const std::string& z = "0") {
  return fmt::format("[[body.section]]\nname = \"{}\"\nat = \"({:.17g}, 0, {}) m\"\n", name, x, z) +
         (ahead ? spread.keys(x, L / 2) : "normal = \"(-1, 0, 0)\"\n" + spread.keys(-L / 2, x));
}

struct Asked {
  std::string waves;  ///< of [ask.rao]: frequencies and headings
  Lengthwise mass = {};
  std::string free = {};  ///< a line of the body
  std::string more = {};  ///< tables after the body's
};

std::string text(const std::string& sections, const Asked& asked) {
  return R"(schema = 1
[water]
density = "1000 kg/m^3"
gravity = "9.81 m/s^2"
depth = "infinite"
[[body]]
name = "barge"
)" + asked.mass.keys(-L / 2, L / 2) +
         asked.free + R"([body.hydrodynamics]
mesh = "barge.obj"
frequencies = "0.3 rad/s .. 1.5 rad/s, 5 values"
mesh_tolerance = 0.9
excitation = true
radiation = { accept_error = 0.9 }
hydrostatics = true
)" + sections +
         asked.more + "[ask]\naccuracy = 0.5\nrao = { " + asked.waves + " }\n";
}

const std::string accepting = "[solve]\naccept_error = true\n";

Responses responses(const std::string& scene, const Pieces& pieces = {10, 2, 3}) {
  return respond(scene::parse(scene, folder(pieces) / "scene.toml"));
}

std::string with(std::string all, const std::string& from, const std::string& to) {
  const auto place = all.find(from);
  EXPECT_NE(place, std::string::npos) << from;
  return all.replace(place, from.size(), to);
}

/// Six loads where the barge is still.
const std::array<double, 6>& at_rest(const Responses& all, const std::string& section) {
  for (const SectionAtRest& s : all.sections)
    if (s.name == "barge." + section) return s.load;
  throw std::out_of_range(section);
}

Complex at(const Responses& all, const std::string& name, std::size_t cell = 0) {
  for (const ComplexSignal& s : all.signals)
    if (s.name == "barge." + name) return s.values[cell];
  throw std::out_of_range(name);
}

constexpr std::array<const char*, 6> components{"force_x", "force_y", "force_z", "moment_x", "moment_y", "moment_z"};
constexpr double force = rho * g * B * L / 2, moment = force * L / 4;  // what a wave of a metre lifts of one half
// Motions solve equations of a condition of some thousands (lengths of 1 m and 40 m), from sums of panels in another
// order.
constexpr double rounding = 1e-9;

// Between two parts whose masses are the body's, what one exerts on the other is what it suffers.
TEST(Sections, LoadsFromEitherSideAreEqualAndOpposite) {
  const Lengthwise box;
  const Responses r = responses(text(section("ahead", 3.3, box) + section("behind", 3.3, box, false),
                                     {"omega = \"0.6 rad/s .. 1.2 rad/s, 3 values\", headings = [\"30 deg\"]"}));
  for (std::size_t w = 0; w < 3; ++w)
    for (const std::string component : components) {
      const Complex ahead = at(r, "ahead." + component, w), behind = at(r, "behind." + component, w);
      EXPECT_LT(std::abs(ahead + behind), rounding * moment) << component;
      EXPECT_GT(std::abs(ahead), 1e3 * rounding * moment) << component;  // all act in oblique waves
    }
}

// At the stern the part is the whole body, with its end wall: nothing is left to hold it. The curves close.
TEST(Sections, LoadsVanishAtTheEnds) {
  const Responses r = responses(text(section("stern", -L / 2, {}) + section("bow", L / 2 - 1e-3, {}),
                                     {"omega = \"0.6 rad/s .. 1.2 rad/s, 3 values\", headings = [\"30 deg\"]"}) +
                                accepting);
  for (std::size_t w = 0; w < 3; ++w)
    for (const std::string component : components) {
      EXPECT_LT(std::abs(at(r, "stern." + component, w)), rounding * moment) << component;
      // A millimetre of hull, and the wall, which holds itself but for its pressure: ρ g B T along x, T/2 deep.
      if (component == "force_x" || component == "moment_y" || component == "moment_z") continue;
      EXPECT_LT(std::abs(at(r, "bow." + component, w)), 1e-3 * force) << component;
    }
}

// Long waves from ahead, quasi-static: per length ρ g B e^(−kT) (cos kx − s), whose heave s = sin(kL/2)/(kL/2) leaves
// no force in all; the pressure in the wave falls by e^(−kT), and so does what lifts the body's mass. Left out are
// added mass, about kB = 8 % of it, and walls of the ends, 16 (T/L)² = 1 %; panels leave about as much.
TEST(Sections, LongWavesBendABargeAsFroudeAndKrylovHaveIt) {
  const double omega = 0.63, k = omega * omega / g, s = std::sin(k * L / 2) / (k * L / 2), a = L / 2;
  const Responses r = responses(text(section("mid", 0, {}, true, "-0.5"),
                                     {"omega = \"0.63 rad/s .. 0.64 rad/s, 2 values\", headings = [\"180 deg\"]"}));
  const double arm = (std::cos(k * a) + k * a * std::sin(k * a) - 1) / (k * k) - s * a * a / 2;
  const double expected = rho * g * B * std::exp(-k * T) * arm;  // a crest amidships hogs: < 0
  const Complex told = at(r, "mid.moment_y");
  EXPECT_LT(expected, 0);
  EXPECT_NEAR(told.real(), expected, 0.1 * std::abs(expected));
  EXPECT_LT(std::abs(told.imag()), 0.3 * std::abs(expected));  // of slopes, which differ by less: (kL)³
}

// Mirrored in its middle a barge in beam seas is the same, so that loads which change their sign there are none.
TEST(Sections, BeamSeasNeitherShearNorTwistASymmetricBargeAmidships) {
  const Responses r =
      responses(text(section("mid", 0, {}), {"omega = \"0.6 rad/s .. 1.2 rad/s, 3 values\", headings = [\"90 deg\"]"}) +
                accepting);
  for (std::size_t w = 0; w < 3; ++w) {
    for (const char* none : {"mid.force_y", "mid.force_z", "mid.moment_x"})
      EXPECT_LT(std::abs(at(r, none, w)), rounding * moment) << none;
    EXPECT_GT(std::abs(at(r, "mid.moment_z", w)), 1e3 * rounding * moment);  // the ends are not the middle
  }
}

// The bending moment is the integral of the shear force, dM_y/dx = F_z: a rod at the waterline has no other couples
// between the walls of its ends. The trapezium's error is that of what bends in between, told by second differences.
TEST(Sections, TheMomentIsTheIntegralOfTheShear) {
  constexpr double h = 2;
  const Lengthwise rod{.height = 0, .z = 0};
  std::string sections;
  for (int i = 0; i < 20; ++i) sections += section(fmt::format("s{}", i), -L / 2 + h * i, rod);
  const Responses r =
      responses(text(sections, {"omega = \"0.9 rad/s .. 1.2 rad/s, 2 values\", headings = [\"180 deg\"]", rod,
                                "free = [\"surge\", \"heave\", \"pitch\"]\n"}));
  const auto shear = [&](int i) { return at(r, fmt::format("s{}.force_z", i)); };
  const auto bending = [&](int i) { return at(r, fmt::format("s{}.moment_y", i)); };
  double largest = 0;
  for (int i = 0; i < 20; ++i) largest = std::max(largest, std::abs(bending(i)));
  EXPECT_GT(largest, 0.01 * moment);
  for (int i = 2; i + 2 < 20; ++i) {
    const double bend = std::max(std::abs(shear(i - 1) - 2.0 * shear(i) + shear(i + 1)),
                                 std::abs(shear(i) - 2.0 * shear(i + 1) + shear(i + 2)));
    EXPECT_LT(std::abs(bending(i + 1) - bending(i) - h / 2 * (shear(i) + shear(i + 1))), h / 6 * bend) << i;
    EXPECT_LT(h / 6 * bend, 0.02 * largest) << i;  // which tells something
  }
}

constexpr double stiffness = 200e3;

/// To the ground far above.
std::string rope(int x) {
  return fmt::format(
      "[[connector]]\nname = \"rope\"\nbetween = [\"barge\", \"ground\"]\nends = [\"({0}, 0, 0) m\", \"({0}, 0, 20) "
      "m\"]\nkind = \"axial\"\nstiffness = \"{1} N/m\"\nrest_length = \"as placed\"\n",
      x, stiffness);
}

// A rope at the stern pulls up there, on the other part: all the rest hangs on it. The wall at the stern, on that part
// too, has no vertical load.
TEST(Sections, BearWhatActsOnTheOtherPart) {
  Asked asked{"omega = \"0.6 rad/s .. 1.2 rad/s, 2 values\", headings = [\"180 deg\"]"};
  asked.more = rope(-20);
  const Responses r = responses(text(section("all", -L / 2 + 1e-6, {}), asked));
  const Complex pull = -stiffness * (at(r, "heave") + L / 2 * at(r, "pitch"));
  EXPECT_GT(std::abs(pull), 0.01 * force);
  EXPECT_LT(std::abs(at(r, "all.force_z") - pull), 1e-6 * force);  // a micrometre of the barge's 40 m
}

/// To the ground along x, off the middle, with tension where the barge is still.
std::string line(const std::string& name, int at, int anchor, double rest_length) {
  return fmt::format(
      "[[connector]]\nname = \"{}\"\nbetween = [\"barge\", \"ground\"]\nends = [\"({}, 0.5, 0.25) m\", \"({}, 0.5, "
      "0.25) "
      "m\"]\nkind = \"axial\"\nstiffness = \"80 kN/m\"\ndamping = \"20 kN s/m\"\nrest_length = \"{} m\"\n",
      name, at, anchor, rest_length);
}

std::string load(int x, double force_z) {
  return fmt::format("[[load]]\non = \"barge\"\nat = \"({}, 0, 0) m\"\nforce = \"(0, 0, {}) N\"\n", x, force_z);
}

void expect_opposite(const Responses& r, std::size_t frequencies) {
  for (std::size_t i = 0; i < components.size(); ++i) {
    const std::string component = components[i];
    for (std::size_t w = 0; w < frequencies; ++w)
      EXPECT_LT(std::abs(at(r, "ahead." + component, w) + at(r, "behind." + component, w)), rounding * moment)
          << component;
    EXPECT_LT(std::abs(at_rest(r, "ahead")[i] + at_rest(r, "behind")[i]), rounding * moment) << component;
  }
}

// Whatever is fastened on either side, what one part exerts on the other is what it suffers. Lines at bow and stern
// pull with tension, a mooring restores at the origin, loads hold each other; without one of them on its side
// the parts would miss each other by the thousands of newtons that these have.
TEST(Sections, LoadsFromEitherSideAreEqualAndOppositeWithWhatIsFastened) {
  const Lengthwise box;
  Asked asked{"omega = \"0.6 rad/s .. 1.2 rad/s, 2 values\", headings = [\"30 deg\"]"};
  asked.more = line("bow", 19, 39, 19.5) + line("stern", -19, -39, 19.5) + load(-10, -5e3) + load(0, 10e3) +
               load(10, -5e3) + "[[mooring]]\non = \"barge\"\nkind = \"linear\"\nstiffness = { sway = \"50 kN/m\" }\n";
  expect_opposite(responses(text(section("ahead", 3.3, box) + section("behind", 3.3, box, false), asked)), 2);
}

TEST(Sections, LoadsFromEitherSideAreEqualAndOppositeWithAJoint) {
  const Lengthwise box;
  Asked asked{"omega = \"0.6 rad/s .. 1.2 rad/s, 2 values\", headings = [\"30 deg\"]"};
  asked.more =
      "[[joint]]\nname = \"pile\"\nkind = \"hinge\"\nbetween = [\"barge\", \"ground\"]\nat = \"(18, 0, 0.4) "
      "m\"\naxis = \"(0, 1, 0)\"\npto = { stiffness = \"900 kN m/rad\", damping = \"90 kN m s/rad\" }\n";
  const Responses r = responses(text(section("ahead", 3.3, box) + section("behind", 3.3, box, false), asked));
  expect_opposite(r, 2);
  EXPECT_GT(std::abs(at(r, "ahead.force_x")), 0.01 * force);  // which the pile holds, and no other
}

// Of what is in the plane of a section, names no point or lies on its members no share is known.
TEST(Sections, NameWhatActsWhereNoShareIsKnown) {
  Asked asked{"omega = \"0.6 rad/s .. 1.2 rad/s, 2 values\", headings = [\"180 deg\"]"};
  const auto refused = [&](const std::string& more, const std::string& why) {
    asked.more = more;
    EXPECT_THAT([&] { responses(text(section("mid", 5, {}), asked)); },
                ThrowsMessage<hydro::InputError>(testing::AllOf(HasSubstr(why), HasSubstr("scene.toml:"))))
        << why;
  };
  refused(rope(5), "rope acts at (5, 0, 0) m, in the plane of section \"mid\"");
  refused("[[damping]]\non = \"barge\"\nlinear = { heave = \"1 kN s/m\" }\n", "names no point where it acts");
  refused(
      "[[member]]\nname = \"keel\"\non = \"barge\"\nfrom = \"(6, 0, -2) m\"\nto = \"(9, 0, -2) m\"\ndiameter = \"0.2 "
      "m\"\nmorison = { cd = 1.0, ca = 1.0 }\n",
      "keel");
}

/// Half of the mass in the middle third of the length, the rest in the others, z at the waterline: from x to the bow,
/// with the centre of what is ahead off the middle plane.
std::string uneven(const std::string& name, double x, double y = 0) {
  const double a = L / 6, e = L / 2, mid = 1.5 * mass / L, out = 0.75 * mass / L;
  const double inner = std::max(0.0, a - x), from = std::max(a, x), m = mid * inner + out * (e - from),
               first = mid * inner * (a + x) / 2 + out * (e - from) * (e + from) / 2;
  return fmt::format(
      "[[body.section]]\nname = \"{}\"\nat = \"({:.17g}, 0, 0) m\"\nmass = \"{:.17g} kg\"\ncentre_of_gravity = "
      "\"({:.17g}, {}, 0) m\"\nradii_of_gyration = \"(1, 5, 5) m\"\n",
      name, x, m, first / m, y);
}

// By hand: V = g ∫ (w − b) dx ahead of x, M = g ∫ (ξ − x)(b − w) dξ less what water on the wall at the bow does about
// z = 0; the weight of the middle makes it sag. A plane midway carries m g L/48, one at a third −m g/12. Numbers are
// sums of the mesh's doubles.
TEST(Sections, CarryWeightAndBuoyancyInStillWater) {
  constexpr double weight = mass * g, wall = rho * g * B * T * T / 2, arm = 2 * T / 3, off = 0.1,
                   small = 1e-10 * weight * L;
  Asked asked{"omega = \"0.6 rad/s .. 1.2 rad/s, 2 values\", headings = [\"180 deg\"]"};
  const Responses r =
      responses(text(uneven("mid", 0, off) + uneven("third", L / 6) + uneven("s1", 9) + uneven("s2", 12.5), asked));
  const auto &mid = at_rest(r, "mid"), &third = at_rest(r, "third"), &s1 = at_rest(r, "s1"), &s2 = at_rest(r, "s2");
  EXPECT_NEAR(mid[0], wall, small);
  EXPECT_NEAR(mid[2], 0, small);
  EXPECT_NEAR(mid[3], weight / 2 * off, small);
  EXPECT_NEAR(mid[4], weight * L / 48 - wall * arm, small);
  EXPECT_NEAR(third[2], -weight / 12, small);
  EXPECT_NEAR(third[4], weight * L / 72 - wall * arm, small);
  EXPECT_NEAR(s2[4] - s1[4], 3.5 / 2 * (s1[2] + s2[2]), small);  // dM/dx = V, which is straight there
  for (const std::size_t none : {1, 5}) EXPECT_NEAR(mid[none], 0, small);
}

// In waves of seven and a half lengths what bends the barge is a small part of what lifts it. Planes go along edges of
// panels and through them; errors against a mesh of twice as many panels along and across are below those told of both.
TEST(Sections, TellAnErrorOfPanelsThatIsAboveTheTrueOne) {
  const std::string waves = "omega = \"0.45 rad/s .. 0.46 rad/s, 2 values\", headings = [\"180 deg\"]";  // kL = 0.83
  std::string scene = text(section("mid", 0, {}) + section("six", 6, {}) + section("fore", 11, {}), {waves});
  scene += accepting;
  const Responses coarse = responses(scene),
                  fine = responses(with(scene, "mesh_tolerance = 0.9", "mesh_tolerance = 0.05"), {20, 4, 6});
  double largest = 0;
  for (std::size_t i = 0; i < coarse.signals.size(); ++i) {
    const ComplexSignal& s = coarse.signals[i];
    if (!s.name.ends_with("moment_y") && !s.name.ends_with("force_z")) continue;
    double peak = 0, off = 0;
    for (std::size_t w = 0; w < s.values.size(); ++w) {
      peak = std::max(peak, std::abs(s.values[w]));
      off = std::max(off, std::abs(s.values[w] - fine.signal(s.name).values[w]));
    }
    const double told = coarse.error.total(i), told_of_fine = fine.error.total(i);
    EXPECT_LT(off / peak, told + told_of_fine) << s.name;
    EXPECT_GT(told, 0) << s.name;
    largest = std::max(largest, off / peak);
  }
  EXPECT_GT(largest, 0.02);  // which tells something
}

TEST(Sections, AreRefusedWherePanelsAreTooCoarseForThemUnlessThatIsAccepted) {
  const std::string waves = "omega = \"0.45 rad/s .. 0.46 rad/s, 2 values\", headings = [\"180 deg\"]";
  const std::string scene = with(text(section("mid", 0, {}), {waves}), "accuracy = 0.5", "accuracy = 1e-3");
  EXPECT_THAT([&] { responses(scene); },
              ThrowsMessage<hydro::InputError>(testing::AllOf(HasSubstr("by the size of panels"),
                                                              HasSubstr("accept_error"), HasSubstr("scene.toml:"))));
  const Responses r = responses(with(scene, "name = \"mid\"", "name = \"mid\"\naccept_error = 9"));
  EXPECT_FALSE(r.warnings().empty());
}

TEST(Sections, AreRefusedAtTheirPlaceWhereTheyCannotBeTold) {
  const Asked asked{"omega = \"0.6 rad/s .. 1.2 rad/s, 2 values\", headings = [\"180 deg\"]"};
  const std::string mid = section("mid", 0, {});
  const auto refused = [](const std::string& scene, const std::string& why) {
    EXPECT_THAT([&] { responses(scene); }, ThrowsMessage<hydro::InputError>(HasSubstr(why))) << why;
  };
  refused(with(text(mid, asked), "at = \"(0, 0, 0) m\"", "at = \"(25, 0, 0) m\""), "does not cut \"barge\"");
  refused(with(text(mid, asked), "at = \"(0, 0, 0) m\"", "at = \"(0, 0, 0) m\"\nnormal = \"(0, 0, 0)\""),
          "has no length");
  refused(text(mid + mid, asked), "earlier section");
  refused(with(text(mid, asked), "mass = \"40000 kg\"", "mass = \"81000 kg\""), "more than that of the body");
  refused(with(text(mid, asked), "mesh_tolerance = 0.9", "mesh_tolerance = 0.9\nfrequency_tolerance = 0.05"),
          "frequency_tolerance");
}

TEST(Sections, AreRefusedInRunsThatAreStepped) {
  Asked asked{"omega = \"0.6 rad/s .. 1 rad/s, 2 values\", headings = [\"180 deg\"]"};
  asked.more = "[waves]\nkind = \"regular\"\nheight = \"1 m\"\nperiod = \"8 s\"\nheading = \"180 deg\"\n";
  const std::string scene = text(section("mid", 0, {}), asked) + "run = { duration = \"10 s\", every = \"0.1 s\" }\n";
  const fs::path here = folder();
  fs::remove(here / "barge.obj");  // before anything is computed, so that nothing misses it
  EXPECT_THAT([&] { simulate(scene::parse(scene, here / "scene.toml")); },
              ThrowsMessage<hydro::InputError>(
                  testing::AllOf(HasSubstr("`froude rao` and `froude response`"), HasSubstr("scene.toml:"))));
}

}  // namespace
}  // namespace sections_test
