// Hulls whose meshes a scene names: put in place, solved, kept, refused.
#include "compile/hulls.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <fstream>
#include <numbers>

#include "compile/compile.hpp"
#include "compile/cylinders.hpp"
#include "hydro/base/error.hpp"
#include "hydro/waves/dispersion.hpp"
#include "scenes.hpp"
#include "support/kept_folder.hpp"
#include "support/scratch.hpp"

namespace hulls_test {
namespace {

namespace fs = std::filesystem;
using namespace froude;
using hydro::potential::Coefficients;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// Rings of corners from the bottom's middle out and up, as quadrilaterals; the deck is one face.
std::string cylinder_obj(double draught, double freeboard, int columns) {
  std::vector<Eigen::Vector2d> rings{
      {0.45, -draught}, {0.8, -draught}, {0.95, -draught}, {1, -draught}};  // radius 1 m, z
  for (const double part : {0.1, 0.4, 0.8, 1.0}) rings.emplace_back(1, -draught * (1 - part));
  rings.emplace_back(1, freeboard);
  std::string out = fmt::format("v 0 0 {}\n", -draught), faces;
  // The polygon has the area of the circle.
  const double step = 2 * std::numbers::pi / columns, wider = std::sqrt(step / std::sin(step));
  for (const auto& ring : rings)
    for (int j = 0; j < columns; ++j)
      out += fmt::format("v {:.12g} {:.12g} {:.12g}\n", wider * ring.x() * std::cos(j * step),
                         wider * ring.x() * std::sin(j * step), ring.y());
  const auto corner = [&](std::size_t ring, int j) { return 2 + static_cast<int>(ring) * columns + j % columns; };
  std::string deck = "f";
  for (int j = 0; j < columns; ++j) {
    faces += fmt::format("f 1 {} {}\n", corner(0, j + 1), corner(0, j));
    for (std::size_t i = 1; i < rings.size(); ++i)
      faces += fmt::format("f {} {} {} {}\n", corner(i - 1, j), corner(i - 1, j + 1), corner(i, j + 1), corner(i, j));
    deck += fmt::format(" {}", corner(rings.size() - 1, j));
  }
  return out + faces + deck + "\n";
}

fs::path folder() {
  const fs::path out = support::scratch_folder() / testing::UnitTest::GetInstance()->current_test_info()->name();
  fs::create_directories(out);
  return out;
}

void write(const fs::path& file, const std::string& text) { std::ofstream(file) << text; }

const std::string mesh = R"(mesh = "hull.obj"
frequencies = "1 rad/s .. 2 rad/s, 3 values"
mesh_tolerance = 0.3
)";

/// Cylinders of 1 m radius and 1.2 m draught, 6 m apart, the origins of the bodies half a metre above still water.
std::string scene_text(const std::string& keys, const std::string& tables = {}, int count = 1) {
  return fmt::format(R"(schema = 1
[water]
density = "1000 kg/m^3"
depth = "5 m"
[[body]]
name = "c"
copies = {{ count = {}, step = "(6, 0, 0) m" }}
position = "(1, 2, 0.5) m"
mass = "3769.9 kg"
centre_of_gravity = "(0, 0, -1) m"
radii_of_gyration = "(1, 1, 1) m"
[body.hydrodynamics]
excitation = true
radiation = {{}}
hydrostatics = true
{}{}
[ask]
rao = {{ periods = "4 s .. 5 s, 3 values", heading = "30 deg" }}
)",
                     count, keys, tables);
}

/// The mesh is drawn about the origin of the body, half a metre above the water.
scene::Scene read(const std::string& text, int columns = 16) {
  std::string obj = cylinder_obj(1.2, 0.4, columns), lowered;
  std::istringstream lines(obj);
  for (std::string line; std::getline(lines, line);) {
    double x = 0, y = 0, z = 0;
    if (std::sscanf(line.c_str(), "v %lf %lf %lf", &x, &y, &z) == 3)
      line = fmt::format("v {:.12g} {:.12g} {:.12g}", x, y, z - 0.5);
    lowered += line + "\n";
  }
  write(folder() / "hull.obj", lowered);
  return scene::parse(text, folder() / "test.toml");
}

double farthest(const Eigen::MatrixXcd& a, const Eigen::MatrixXcd& b) {
  return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}
void expect_near(const Coefficients& a, const Coefficients& b, double relative) {
  ASSERT_EQ(a.omega, b.omega);
  ASSERT_EQ(a.X.size(), b.X.size());
  for (std::size_t w = 0; w < a.omega.size(); ++w) {
    EXPECT_LT(farthest(a.A[w], b.A[w]), relative) << a.omega[w];
    EXPECT_LT(farthest(a.B[w], b.B[w]), relative) << a.omega[w];
  }
  for (std::size_t h = 0; h < a.X.size(); ++h) EXPECT_LT(farthest(a.X[h], b.X[h]), relative);
  EXPECT_LT(farthest(*a.C, *b.C), relative);
  EXPECT_LT(farthest(*a.A_inf, *b.A_inf), relative);
}

/// Counts what is solved while it lives, and may end it.
struct Watched {
  explicit Watched(int last = 1000) {
    compile::watch_hulls([this, last](int, int) {
      if (++solved >= last) throw std::runtime_error("enough");
    });
  }
  ~Watched() { compile::watch_hulls({}); }
  Watched(const Watched&) = delete;
  Watched& operator=(const Watched&) = delete;
  int solved = 0;
};

// Where the two stand is not where they are solved, about the origin, so that a plane of symmetry is found. A and B do
// not know where that is; X is that about the origin with the phase of the way to there, e^(−i k·d).
TEST(HullsInAScene, AreSolvedTogetherWhereTheyStand) {
  const scene::Scene scene = read(scene_text(mesh, "", 2), 8);
  const auto prepared = compile::prepare(scene);
  ASSERT_EQ(prepared.groups.size(), 1u);
  EXPECT_EQ(prepared.sharing_waves, (std::vector<std::vector<int>>{{0, 1}}));
  const auto ours = compile::solve_hulls(scene, {0, 1});
  EXPECT_EQ(ours.check.planes_of_symmetry, 2);
  const auto plain = hydro::hydrostatics::read_mesh(folder() / "hull.obj");
  std::vector<hydro::panels::HullBody> bodies;
  for (const double x : {-3.0, 3.0}) {
    auto moved = plain;
    for (auto& v : moved.vertices) v += Eigen::Vector3d(x, 0, 0.5);
    bodies.push_back({x < 0 ? "c1" : "c2", {x, 0, 0.5}, Eigen::Vector3d(x, 0, -0.5), hydro::hydrostatics::Hull(moved)});
  }
  auto expected =
      hydro::panels::solve(bodies, scene.water, ours.coefficients.omega, {std::numbers::pi / 6}, {.tolerance = 0.3})
          .coefficients;
  for (std::size_t w = 0; w < expected.omega.size(); ++w) {
    const double k = hydro::waves::wavenumber(expected.omega[w], scene.water);
    expected.X[0].col(static_cast<Eigen::Index>(w)) *=
        std::polar(1.0, -k * (4 * std::cos(std::numbers::pi / 6) + 2 * std::sin(std::numbers::pi / 6)));
  }
  expect_near(ours.coefficients, expected, 1e-9);  // rounding
  EXPECT_LT((*ours.coefficients.body[1].reference_point - Eigen::Vector3d(7, 2, 0.5)).norm(), 1e-12);
  // About the centres of gravity, and with the weights that the scene gives: that of the water displaced.
  const auto& placed = prepared.groups[0].table.coefficients();
  EXPECT_NEAR(placed.A[0](8, 8) / expected.A[0](8, 8), 1, 1e-9);
  EXPECT_NEAR((*placed.C)(2, 2) / (scene.water.density * scene.water.gravity * std::numbers::pi), 1, 1e-9);
}

TEST(HullsInAScene, OfAVerticalCylinderHaveTheCoefficientsThatAreKnownExactly) {
  const scene::Scene by_panels = read(scene_text(mesh), 24);
  const std::string cylinders =
      "[body.hydrodynamics.cylinders]\nat = \"(0, 0, -0.5) m\"\ndiameter = \"2 m\"\ndraught = \"1.2 m\"\n"
      "frequencies = \"1 rad/s .. 2 rad/s, 3 values\"\n";
  const scene::Scene exactly = read(scene_text("", cylinders));
  const auto solved = compile::solve_hulls(by_panels, {0});
  const auto& ours = solved.coefficients;
  const auto exact = compile::solve_cylinders(exactly, {0}).coefficients;
  EXPECT_LT(solved.check.estimate, 0.3);
  // Of its own mode, an entry is off by no more than panels cut in four tell.
  for (std::size_t w = 0; w < ours.omega.size(); ++w)
    for (const Eigen::Index mode : {0, 2, 4}) {
      EXPECT_NEAR(ours.A[w](mode, mode) / exact.A[w](mode, mode), 1, solved.check.estimate) << mode;
      EXPECT_LT(
          std::abs(ours.X[0](mode, static_cast<Eigen::Index>(w)) - exact.X[0](mode, static_cast<Eigen::Index>(w))),
          solved.check.estimate * exact.X[0].row(mode).cwiseAbs().maxCoeff())
          << mode;
    }
  EXPECT_NEAR((*ours.C)(2, 2) / (*exact.C)(2, 2), 1, 1e-9) << "the polygon has the circle's area";
}

void expect_same_bits(const Coefficients& a, const Coefficients& b) {
  EXPECT_EQ(a.omega, b.omega);
  EXPECT_EQ(a.heading, b.heading);
  EXPECT_EQ(a.A, b.A);
  EXPECT_EQ(a.B, b.B);
  EXPECT_EQ(a.X, b.X);
  EXPECT_EQ(a.C, b.C);
  EXPECT_EQ(a.A_inf, b.A_inf);
  EXPECT_EQ(a.A_zero, b.A_zero);
  EXPECT_EQ(a.water.depth.metres(), b.water.depth.metres());
  EXPECT_EQ(a.source, b.source);
  ASSERT_EQ(a.body.size(), b.body.size());
  EXPECT_EQ(a.body[0].name, b.body[0].name);
  EXPECT_EQ(a.body[0].centre_of_buoyancy, b.body[0].centre_of_buoyancy);
  EXPECT_EQ(a.body[0].displaced_volume, b.body[0].displaced_volume);
}

TEST(HullsInAScene, AreSolvedOnceForAllLaterStartsOfTheProgram) {
  const scene::Scene scene = read(scene_text(mesh), 8);
  const support::KeptFolder kept(folder() / "kept");
  Watched watched;
  const Coefficients first = compile::coefficients_of_hulls(scene, {0});
  const int once = watched.solved;
  EXPECT_GT(once, 3) << "three frequencies, a limit and what is refined";
  EXPECT_FALSE(compile::plan_hulls(scene, {0}).size().empty());
  const Coefficients again = compile::coefficients_of_hulls(scene, {0});
  EXPECT_EQ(watched.solved, once);
  expect_same_bits(again, first);
  EXPECT_THAT(again.notes.back(), AllOf(HasSubstr("solved before"), HasSubstr("FROUDE_CACHE=off")));
  EXPECT_EQ(again.notes.size(), first.notes.size() + 1);
  const auto plan = compile::plan_hulls(scene, {0});
  EXPECT_EQ(plan.seconds(), 0);
  EXPECT_THAT(plan.method(), HasSubstr("solved before and kept in"));
  // Another mesh under the same name is another body.
  write(folder() / "hull.obj", cylinder_obj(1.3, 0.4, 8));
  compile::coefficients_of_hulls(scene, {0});
  EXPECT_EQ(watched.solved, 2 * once);
  // What is kept and spoilt is as good as nothing.
  for (const auto& entry : fs::directory_iterator(folder() / "kept")) {
    EXPECT_EQ(entry.path().extension(), ".coefficients");
    std::fstream file(entry.path(), std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(-20, std::ios::end);
    file.put('x');
  }
  compile::coefficients_of_hulls(scene, {0});
  EXPECT_EQ(watched.solved, 3 * once);
}

TEST(HullsInAScene, AreNotSolvedToTheEndWhereTheWatcherEndsIt) {
  const scene::Scene scene = read(scene_text(mesh), 8);
  Watched watched(1);
  EXPECT_THAT([&] { compile::prepare(scene); }, ThrowsMessage<std::runtime_error>("enough"));
  EXPECT_LE(watched.solved, hydro::all_processors()) << "those that were begun, one on each processor";
}

TEST(HullsInAScene, HaveTheirCostToldBeforeTheyAreSolved) {
  const scene::Scene scene = read(scene_text(mesh));
  const auto plan = compile::plan_hulls(scene, {0});
  EXPECT_EQ(plan.frequencies, 3u);
  EXPECT_EQ(plan.headings, 1u);
  EXPECT_EQ(plan.cost.systems, 4);
  EXPECT_GT(plan.cost.refined_unknowns, plan.cost.unknowns) << "the error is estimated";
  EXPECT_THAT(plan.size(), AllOf(HasSubstr("panels, 3 frequencies, 1 headings; 4 x"), HasSubstr("MB, about")));
}

struct Wrong {
  std::string keys, tables;
  std::vector<std::string> parts;
};

TEST(HullsInAScene, AreRefusedWithPlaceAndRemedyWhereSomethingIsWrong) {
  write(folder() / "open.obj",
        "v -1 -1 -2\nv 1 -1 -2\nv 1 1 -2\nv -1 1 -2\nv 0 0 -3\nf 1 5 2\nf 2 5 3\nf 3 5 4\nf 4 5 1\n");
  write(folder() / "high.obj", cylinder_obj(-0.1, 0.6, 8));
  const auto with = [](const std::string& file, const std::string& further = {}) {
    return "mesh = \"" + file + "\"\nfrequencies = \"1 rad/s .. 2 rad/s, 3 values\"\nmesh_tolerance = 0.3\n" + further;
  };
  const std::string cylinder =
      "[body.hydrodynamics.cylinders]\nat = \"(0, 0, -0.5) m\"\ndiameter = \"2 m\"\n"
      "draught = \"1 m\"\nfrequencies = \"1 rad/s .. 2 rad/s, 3 values\"\n";
  const std::vector<Wrong> all{
      {with("nowhere.stl"), "", {"test.toml:16:8", "nowhere.stl"}},
      {with("hull.step"), "", {"test.toml:16:8", "hull.step"}},
      {with("open.obj"), "", {"test.toml:16:8", "opening", "close the mesh"}},
      {with("high.obj"), "", {"test.toml:16:8", "nothing of \"c1\" is under water"}},
      {with("hull.obj", "unit = \"10 m\"\n"), "", {"test.toml:16:8", "below the water"}},
      {with("hull.obj", "reverse = true\n"), "", {"test.toml:16:8", "inside out"}},
      {"mesh = \"hull.obj\"\n", "", {"test.toml:16:8", "needs the frequencies", "rad/s"}},
      {"file = \"a.nc\"\n" + with("hull.obj"), "", {"file", "mesh"}},
      {with("hull.obj"), cylinder, {"cylinders", "mesh"}},
      {"file = \"a.nc\"\nmesh_tolerance = 0.1\n", "", {"mesh_tolerance", "mesh"}},
      {with("hull.obj", "lid = \"no\"\n"), "", {"lid", "none"}},
      {with("hull.obj", "frequency_tolerance = 0.01\n"), "", {"test.toml:16:8", "5 at least", "got 3"}},
      {"file = \"a.nc\"\nfrequency_tolerance = 0.1\n", "", {"frequency_tolerance", "mesh"}},
  };
  for (const Wrong& wrong : all) {
    SCOPED_TRACE(wrong.keys);
    std::string told = "nothing was refused";
    try {
      const scene::Scene scene = read(scene_text(wrong.keys, wrong.tables), 8);
      compile::prepare(scene);
    } catch (const hydro::InputError& e) {
      told = e.what();
    }
    for (const std::string& part : wrong.parts) EXPECT_THAT(told, HasSubstr(part));
  }
}

TEST(HullsInAScene, AreRefusedWhereTheyOverlap) {
  std::string text = scene_text(mesh, "", 2);
  text.replace(text.find("(6, 0, 0)"), 9, "(1, 0, 0)");
  EXPECT_THAT([&] { compile::prepare(read(text, 8)); },
              ThrowsMessage<hydro::InputError>(AllOf(HasSubstr("test.toml:16:8"), HasSubstr("is inside"))));
}

TEST(HullsInAScene, StateOneTableWhereSeveralAreSolved) {
  const std::string first = scene_text(mesh);
  const auto begin = first.find("[[body]]"), end = first.find("[ask]");
  const auto two = [&](const std::string& was, const std::string& is) {
    std::string second = first.substr(begin, end - begin), text = first;
    second.replace(second.find("\"c\""), 3, "\"d\"");
    second.replace(second.find("(1, 2, 0.5)"), 11, "(1, 20, 0.5)");
    second.replace(second.find(was), was.size(), is);
    text.insert(end, second);
    return read(text, 8);
  };
  const auto refused = [](const scene::Scene& scene) {
    return [&] { compile::plan_hulls(scene, compile::bodies_of_meshes(scene)); };
  };
  const scene::Scene frequencies = two("3 values", "5 values"), tolerance = two("0.3\n", "0.1\n");
  EXPECT_THAT(refused(frequencies),
              ThrowsMessage<hydro::InputError>(AllOf(HasSubstr("test.toml:31:8"), HasSubstr("different frequencies"))));
  EXPECT_THAT(refused(tolerance),
              ThrowsMessage<hydro::InputError>(HasSubstr("different mesh_tolerance, lid or mesh_interaction")));
  // One by panels and one exactly: no waves pass between them, which the scene must say.
  const scene::Scene mixed =
      two(mesh,
          "[body.hydrodynamics.cylinders]\nat = \"(0, 0, -0.5) m\"\ndiameter = \"2 m\"\ndraught = \"1 m\"\n"
          "frequencies = \"1 rad/s .. 2 rad/s, 3 values\"\n");
  EXPECT_THAT([&] { compile::prepare(mixed); },
              ThrowsMessage<hydro::InputError>(AllOf(HasSubstr("no waves pass between c1 and d1"),
                                                     HasSubstr("\"hull.obj\""), HasSubstr("its cylinders"))));
}

}  // namespace
}  // namespace hulls_test
