#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <sstream>

#include "answers/simulate.hpp"
#include "harness/scenes.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/atomic_file.hpp"
#include "hydro/potential/formats/writers.hpp"
#include "hydro/radiation/choice.hpp"

namespace froude::validation::f3of {
namespace {

using hydro::potential::Coefficients;

constexpr double density = 1025, gravity = 9.81;
constexpr int flap1 = 0, base = 2, bodies = 3;  // in the order of the database
constexpr double mass[bodies] = {179250, 179250, 1089825};
const Eigen::Vector3d centre[bodies] = {{-12.5, 0, -5.5}, {12.5, 0, -5.5}, {0, 0, -9}};

/// Rows of numbers.
Eigen::MatrixXd table(const Folders& folders, const std::string& name) {
  std::istringstream in(hydro::io::read_text(folders.shared("f3of/wdn_hdb/" + name)));
  std::vector<std::vector<double>> rows;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::vector<double> row;
    for (double x = 0; words >> x;) row.push_back(x);
    if (!row.empty()) rows.push_back(std::move(row));
  }
  Eigen::MatrixXd out(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(rows.front().size()));
  for (std::size_t i = 0; i < rows.size(); ++i)
    out.row(static_cast<Eigen::Index>(i)) =
        Eigen::Map<const Eigen::RowVectorXd>(rows[i].data(), static_cast<Eigen::Index>(rows[i].size()));
  return out;
}

/// One matrix a line: "Ma" and "B" have a file for the six rows of each body.
std::vector<Eigen::MatrixXd> matrices(const Folders& folders, const std::string& stem) {
  std::vector<Eigen::MatrixXd> out;
  for (int b = 0; b < bodies; ++b) {
    const Eigen::MatrixXd rows = table(folders, stem + std::to_string(b + 1) + "ij.dat");
    // A(∞) stands on six lines, the others on one each.
    const bool one_matrix = rows.cols() == 6 * bodies;
    out.resize(one_matrix ? 1 : static_cast<std::size_t>(rows.rows()), Eigen::MatrixXd::Zero(6 * bodies, 6 * bodies));
    for (std::size_t n = 0; n < out.size(); ++n)
      for (int r = 0; r < 6; ++r)
        out[n].row(6 * b + r) = one_matrix
                                    ? Eigen::RowVectorXd(rows.row(r))
                                    : Eigen::RowVectorXd(rows.row(static_cast<Eigen::Index>(n)).segment(18 * r, 18));
  }
  return out;
}

/// The unit rigid motion of all bodies together in one mode, about the global origin.
Eigen::VectorXd together(int mode) {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(6 * bodies);
  for (int b = 0; b < bodies; ++b)
    out.segment<6>(6 * b) = hydro::potential::rigid_shift(centre[b]) * Eigen::Matrix<double, 6, 1>::Unit(mode);
  return out;
}

/// What the longest waves tell of a body (their length is 154 km): the water moves by ω² in surge, the pressure's
/// gradient pushes the displaced volume and what is added to it, and the surface rises by one.
struct LongWaves {
  double waterplane, volume, pitch_moment;  ///< m², m³, and ∫x² dA + V z_B about the centre of gravity, m⁴
};

LongWaves long_waves(const Folders& folders, const Eigen::MatrixXd& A, int body) {
  const double omega = 2 * std::numbers::pi / table(folders, "PeriodFe.dat")(0, 0), k = omega * omega / gravity;
  const Eigen::RowVectorXd modulus = table(folders, "FeMod.dat").row(0), phase = table(folders, "FePha.dat").row(0);
  const auto quadrature = [&](int mode) {
    const Eigen::Index i = 6 * body + mode;
    return -modulus[i] * std::sin(phase[i] * std::numbers::pi / 180) / k;
  };
  const Eigen::VectorXd surge = A * together(0);
  return {modulus[6 * body + 2] * std::cos(phase[6 * body + 2] * std::numbers::pi / 180),
          quadrature(0) - surge[6 * body], quadrature(4) - surge[6 * body + 4]};
}

/// The database in the units that Kramers and Kronig's relation tells: A/ρ, B/(ρω), X/(ρg).
Coefficients database(const Folders& folders) {
  const Eigen::MatrixXd period = table(folders, "PeriodB_Ma_Mainf.dat");
  const auto A = matrices(folders, "Ma"), B = matrices(folders, "B");
  Coefficients c;
  c.water = {.density = density, .gravity = gravity, .depth = hydro::WaterDepth::infinite()};
  c.source = "f3of/wdn_hdb";
  c.A_inf = density * matrices(folders, "Ma_inf").front();
  for (Eigen::Index i = 0; i < period.rows(); ++i) {
    if (!(period(i, 0) > 0)) continue;  // the two limits, which these files leave zero
    const double omega = 2 * std::numbers::pi / period(i, 0);
    c.omega.push_back(omega);
    c.A.push_back(density * A[static_cast<std::size_t>(i)]);
    c.B.push_back(density * omega * B[static_cast<std::size_t>(i)]);
  }
  c.C = Eigen::MatrixXd::Zero(6 * bodies, 6 * bodies);
  double balance = (mass[0] + mass[1] + mass[base]) / density;
  for (int b = flap1; b < bodies; ++b) {
    const LongWaves at = long_waves(folders, c.A.front() / density, b);
    // The whole floats; the base takes what the flaps leave, so that the error of three volumes does not lift it.
    const double volume = b == base ? balance : at.volume;
    balance -= volume;
    c.body.push_back({.name = b == base ? "base" : "flap" + std::to_string(b + 1),
                      .reference_point = centre[b],
                      .centre_of_gravity = centre[b],
                      .centre_of_buoyancy = {},
                      .displaced_volume = volume});
    (*c.C)(6 * b + 2, 6 * b + 2) = density * gravity * at.waterplane;
    (*c.C)(6 * b + 4, 6 * b + 4) = density * gravity * at.pitch_moment;
  }
  return c;
}

/// A(0) − A(∞) of a diagonal entry from its damping, 2/π ∫B/ω² dω, relative to what the added mass says.
double kramers_kronig(const Coefficients& c, int mode) {
  double integral = 0;
  for (std::size_t i = 1; i < c.omega.size(); ++i) {
    const auto f = [&](std::size_t j) { return c.B[j](mode, mode) / (c.omega[j] * c.omega[j]); };
    integral += (c.omega[i] - c.omega[i - 1]) * (f(i) + f(i - 1)) / 2;
  }
  return 2 / std::numbers::pi * integral / (c.A.front()(mode, mode) - (*c.A_inf)(mode, mode)) - 1;
}

struct Curve {
  std::vector<double> time, value;
};

/// Lines that are not two numbers are headings.
Curve read_curve(const std::filesystem::path& file) {
  std::istringstream in(hydro::io::read_text(file));
  Curve c;
  for (std::string line; std::getline(in, line);) {
    std::istringstream row(line);
    double t = 0, x = 0;
    if (!(row >> t >> x)) continue;
    c.time.push_back(t);
    c.value.push_back(x);
  }
  return c;
}

/// Twice the mean distance of the first four passes through zero after the first.
double period_of(const Curve& c) {
  std::vector<double> at;
  for (std::size_t i = 1; i < c.value.size() && at.size() < 4; ++i)
    if ((c.value[i - 1] > 0) != (c.value[i] > 0))
      at.push_back(c.time[i - 1] + (c.time[i] - c.time[i - 1]) * c.value[i - 1] / (c.value[i - 1] - c.value[i]));
  return 2 * (at.back() - at.front()) / static_cast<double>(at.size() - 1);
}

/// The height of the second peak over that of the first: what one period leaves.
double left_after_a_period(const Curve& c) {
  const double T = period_of(c);
  double best = 0;
  for (std::size_t i = 0; i < c.value.size(); ++i)
    if (std::abs(c.time[i] - T) < T / 4) best = std::max(best, c.value[i]);
  return best / c.value.front();
}

/// Returns what one period leaves.
double compare(const Folders& folders, const std::string& name, const std::string& file, const Curve& ours,
               Outcome& out, plot::Panel& panel) {
  double shortest = 1e9, longest = 0, least = 1e9, most = 0;
  for (const std::string code : {"INW", "PDS", "WDN", "WSM"}) {
    const Curve theirs = read_curve(folders.shared("f3of/reference/" + code + "_F3OF_" + file));
    const double T = period_of(theirs), left = left_after_a_period(theirs);
    shortest = std::min(shortest, T), longest = std::max(longest, T);
    least = std::min(least, left), most = std::max(most, left);
    panel.series.push_back({.name = code, .x = theirs.time, .y = theirs.value, .dashed = true});
  }
  panel.series.push_back({.name = "Froude", .x = ours.time, .y = ours.value});
  const double T = period_of(ours), left = left_after_a_period(ours);
  // 0 at the lower end of the spread of the four codes, 1 at the upper.
  out.numbers.push_back({name + ", period", T, "s"});
  out.numbers.push_back({name + ", period in the spread of four codes", (T - shortest) / (longest - shortest), ""});
  out.numbers.push_back({name + ", left after one period", left, ""});
  out.numbers.push_back(
      {name + ", left after one period, in the spread of four codes", (left - least) / (most - least), ""});
  return left;
}

constexpr int planar[] = {0, 2, 4, 6, 8, 10, 12, 14, 16};  // surge, heave and pitch of three bodies

/// Largest damping, kg/s, by which the memory of poles may be off in surge of all bodies together: its own error is
/// relative to √(max B_ii max B_jj) of every pair.
double damping_interpolation_error(const Coefficients& c) {
  hydro::radiation::DampingTable damping{c.omega, {}};
  std::vector<Eigen::MatrixXd> A;
  const std::vector<int> modes(std::begin(planar), std::end(planar));
  const auto symmetric = [&](const Eigen::MatrixXd& m) {
    return Eigen::MatrixXd((m(modes, modes) + m(modes, modes).transpose()) / 2);
  };
  for (const auto& B : c.B) damping.B.push_back(symmetric(B));
  for (const auto& m : c.A) A.push_back(symmetric(m));
  const auto chosen = hydro::radiation::choose(damping, A, symmetric(*c.A_inf),
                                               {.step = 0.1, .length = {}, .method = hydro::radiation::Method::poles});
  double roots = 0;
  for (const int mode : {0, 6, 12}) {
    double largest = 0;
    for (const auto& B : c.B) largest = std::max(largest, B(mode, mode));
    roots += std::sqrt(largest);
  }
  return chosen.alternatives.front().error * roots * roots;
}

/// Damping, kg/s, that takes the amplitude of surge from one share to the other in a period: B = 2 M ln(ratio)/T.
double damping_between(const Coefficients& c, double more, double less, double period) {
  const double moving = mass[0] + mass[1] + mass[base] + together(0).dot(c.A.front() * together(0));
  return 2 * moving * std::log(more / less) / period;
}

/// A file that goes when the case has been run.
class Scratch {
 public:
  explicit Scratch(const Coefficients& c)
      : path_(std::filesystem::temp_directory_path() / fmt::format("froude-f3of-{}.h5", std::random_device{}())) {
    hydro::potential::write_froude(c, path_);
  }
  ~Scratch() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

}  // namespace

Outcome outcome(const Folders& folders) {
  const Coefficients data = database(folders);
  const Scratch file(data);
  Outcome out;
  double worst = 0;
  for (const int mode : {0, 4, 12, 16}) worst = std::max(worst, std::abs(kramers_kronig(data, mode)));
  out.numbers.push_back({"worst misfit of A(0) - A(inf) to the damping as B/(rho omega)", worst, ""});
  plot::Figure figure{.title = "Base and two locked flaps let go", .panels = {}};
  using enum scene::Memory::Method;
  std::vector<double> left;  // of surge, by method
  for (const auto& [method, word] : {std::pair{direct, "direct"}, {partitioned, "partitioned"}, {poles, "poles"}}) {
    const std::string name(word);
    const auto run = [&](const std::string& file_name) {
      auto scene = read_scene(folders, "f3of/wdn_hdb/B1ij.dat", "database.h5", file.path(), file_name);
      for (auto& body : scene.bodies) body.hydrodynamics->memory.method = method;
      return simulate(scene);
    };
    const Run pitching = run("scene.toml"), surging = run("surge.toml");
    Curve pitch{pitching.time, pitching.signal("base.pitch")};
    for (double& p : pitch.value) p *= 180 / std::numbers::pi;
    figure.panels.push_back({.x = {"time", "s"}, .y = {"pitch, " + name, "deg"}, .series = {}});
    compare(folders, "pitch, " + name, "DT2_PITCH.dat", pitch, out, figure.panels.back());
    figure.panels.push_back({.x = {"time", "s"}, .y = {"surge, " + name, "m"}, .series = {}});
    left.push_back(compare(folders, "surge, " + name, "DT1_SURGE.dat", {surging.time, surging.signal("base.surge")},
                           out, figure.panels.back()));
  }
  out.numbers.push_back({"surge, damping of poles beyond that of the convolution, of what poles leave open",
                         damping_between(data, left.front(), left.back(), 47) / damping_interpolation_error(data), ""});
  out.pictures.push_back({"decay", "Pitch and surge of the base against four codes.", figure, true});
  return out;
}

}  // namespace froude::validation::f3of
