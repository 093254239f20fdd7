#include <Eigen/QR>

#include <cmath>
#include <numbers>

#include "dynamics/force/buoyancy.hpp"
#include "dynamics/force/gravity.hpp"
#include "dynamics/force/pto.hpp"
#include "dynamics/model/assemble.hpp"
#include "dynamics/model/model.hpp"
#include "dynamics/spatial/rotation.hpp"
#include "harness/case.hpp"

namespace froude::validation::orszaghova_expansion {
namespace {

constexpr double pi = std::numbers::pi, rho = 1025, g = 9.81, L = 40, R = 4, draught = 8;
constexpr double m_B = 100e3, z_B = -3, I_B = 1.2e6, V_S = 28, m_S = 40e3, z_S = -22, I_S = 4.3e6;
constexpr double K1 = -350e3, K3 = 20e3, S_B = pi * R * R, S_11 = pi / 4 * R * R * R * R;
constexpr int buoy = 0, slide = 1;

/// One of the two hulls of the paper.
struct Hull {
  const char* name;
  hydro::hydrostatics::CircularCylinder cylinder;  ///< unless it is a sphere
  bool sphere;
  double volume, centre;  ///< V_B, z' of its centre
};
const Hull cylinder{"cylinder", {{0, 0, -draught}, {0, 0, draught}, R}, false, S_B* draught, -draught / 2};
const Hull sphere{"sphere", {}, true, 2 * pi / 3 * R* R* R, -3 * R / 8};

dynamics::Model model_of(const Hull& hull) {
  const auto body = [](const char* name, double mass, double z, double inertia) {
    return dynamics::RigidBody({.name = name,
                                .mass = mass,
                                .inertia = inertia * Eigen::Matrix3d::Identity(),
                                .centre_of_gravity = {Eigen::Vector3d(0, 0, z)},
                                .free = {true, false, true, false, true, false}});
  };
  std::vector<dynamics::RigidBody> bodies{body("buoy", m_B, z_B, I_B), body("slide", m_S, z_S, I_S)};
  const auto joint = [](const char* name, dynamics::JointKind kind, int first, std::optional<int> second,
                        const Eigen::Vector3d& at, const Eigen::Vector3d& axis) {
    return dynamics::Joint{.name = name, .kind = kind, .first = first, .second = second, .place = at, .axis = axis};
  };
  std::vector<dynamics::Joint> joints{
      joint("pivot", dynamics::JointKind::hinge, slide, {}, {0, 0, -L}, Eigen::Vector3d::UnitY()),
      joint("rack", dynamics::JointKind::slider, slide, buoy, {0, 0, 0}, Eigen::Vector3d::UnitZ())};
  const auto shape = [](auto what) { return std::make_shared<const dynamics::FloatingShape>(what); };
  std::vector<dynamics::Buoyancy> wet{
      {buoy, hull.sphere ? shape(hydro::hydrostatics::Sphere{{0, 0, 0}, R}) : shape(hull.cylinder)},
      {slide, shape(hydro::hydrostatics::Sphere{{0, 0, z_S}, std::cbrt(3 * V_S / (4 * pi))})}};
  const hydro::Water water{.density = rho, .gravity = g, .depth = hydro::WaterDepth::from_metres(L)};
  dynamics::PtoLaw take_off;
  take_off.line = {.stiffness = K1, .cubic = K3};
  take_off.preload = rho * g * hull.volume - m_B * g;
  std::vector<std::unique_ptr<const dynamics::ForceKind>> forces;
  forces.push_back(std::make_unique<dynamics::GravityKind>(bodies, g));
  forces.push_back(std::make_unique<dynamics::BuoyancyKind>(bodies, wet, water));
  forces.push_back(std::make_unique<dynamics::PtoKind>(
      std::vector<dynamics::Pto>{{dynamics::JointCoordinate(bodies, joints[1]), take_off}}));
  return {std::move(bodies), {}, std::move(forces), std::move(joints)};
}

Eigen::Vector3d along(double theta) { return {std::sin(theta), 0, std::cos(theta)}; }
Eigen::Vector3d across(double theta) { return {std::cos(theta), 0, -std::sin(theta)}; }

dynamics::State posed(const dynamics::Model& model, double r, double theta) {
  dynamics::State s = dynamics::rest_state(model.bodies());
  const Eigen::Vector3d anchor(0, 0, -L);
  s.pose[buoy].centre = anchor + (L + r + z_B) * along(theta);
  s.pose[slide].centre = anchor + (L + z_S) * along(theta);
  for (auto& pose : s.pose) pose.attitude = dynamics::rotation_exp({0, theta, 0});
  return s;
}

/// Minus the generalised loads of r and θ: what stands on the left of (4) and (5).
Eigen::Vector2d restoring(const dynamics::Model& model, double r, double theta) {
  const dynamics::State s = posed(model, r, theta);
  dynamics::Workspace w(model, s);
  const Eigen::VectorXd still = -model.residual(s, Eigen::VectorXd::Zero(model.modes()), w);
  const double moment = (L + r + z_B) * across(theta).dot(still.segment<3>(0)) + still[4] +
                        (L + z_S) * across(theta).dot(still.segment<3>(6)) + still[10];
  return {-along(theta).dot(still.segment<3>(0)), -moment};
}

/// Coefficients c(i, j) of rⁱθʲ up to order n of a smooth function, by least squares at Chebyshev's points of ±a, ±b.
template <class Function>
Eigen::MatrixXd series(const Function& f, int n, double a, double b) {
  const int points = 2 * n + 2;
  const auto node = [&](int k) { return std::cos(pi * (k + 0.5) / points); };
  std::vector<std::pair<int, int>> powers;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; i + j <= n; ++j) powers.emplace_back(i, j);
  Eigen::MatrixXd A(points * points, static_cast<Eigen::Index>(powers.size()));
  Eigen::VectorXd y(points * points);
  for (int p = 0; p < points; ++p)
    for (int q = 0; q < points; ++q) {
      for (std::size_t k = 0; k < powers.size(); ++k)
        A(p * points + q, static_cast<Eigen::Index>(k)) =
            std::pow(node(p), powers[k].first) * std::pow(node(q), powers[k].second);
      y[p * points + q] = f(a * node(p), b * node(q));
    }
  const Eigen::VectorXd x = A.householderQr().solve(y);
  Eigen::MatrixXd c = Eigen::MatrixXd::Zero(n + 1, n + 1);
  for (std::size_t k = 0; k < powers.size(); ++k)
    c(powers[k].first, powers[k].second) =
        x[static_cast<Eigen::Index>(k)] / std::pow(a, powers[k].first) / std::pow(b, powers[k].second);
  return c;
}

double kinetic(const dynamics::Model& model, double r, double theta, double r_rate, double theta_rate) {
  dynamics::State s = posed(model, r, theta);
  s.velocity.segment<3>(0) = r_rate * along(theta) + (L + r + z_B) * theta_rate * across(theta);
  s.velocity.segment<3>(6) = (L + z_S) * theta_rate * across(theta);
  s.velocity[4] = s.velocity[10] = theta_rate;
  return model.kinetic_energy(s);
}

void add_hull(const Hull& hull, Outcome& out) {
  const dynamics::Model model = model_of(hull);
  const auto in_r = series([&](double r, double t) { return restoring(model, r, t)[0]; }, 11, 0.3, 0.1);
  const auto in_theta = series([&](double r, double t) { return restoring(model, r, t)[1]; }, 11, 0.3, 0.1);
  const double K_theta = rho * g * S_11 + rho * g * (hull.volume * (L + hull.centre) + V_S * (L + z_S)) -
                         g * (m_B * (L + z_B) + m_S * (L + z_S));
  const double coupling = g * m_B - rho * g * hull.volume + rho * g * L * S_B, kind = hull.sphere ? 1 : 0.5;
  const auto compare = [&](const std::string& term, double ours, double printed) {
    out.numbers.push_back({fmt::format("{}: {}, relative", hull.name, term), ours / printed - 1, ""});
  };
  compare("r in (4)", in_r(1, 0), K1 + rho * g * S_B);
  compare("theta^2 in (4)", in_r(0, 2), -0.5 * coupling);
  compare("r theta^2 in (4)", in_r(1, 2), -kind * rho * g * S_B);
  compare("r^3 in (4)", in_r(3, 0), K3 - (hull.sphere ? pi / 3 * rho * g : 0));
  compare("theta in (5)", in_theta(0, 1), K_theta);
  compare("theta r in (5)", in_theta(1, 1), -coupling);
  compare("theta r^2 in (5)", in_theta(2, 1), -kind * rho * g * S_B);
  compare("theta^3 in (5)", in_theta(0, 3),
          -K_theta / 6 + 0.5 * rho * g * S_B * L * L + (hull.sphere ? 0 : 0.5 * rho * g * S_11));
  out.numbers.push_back(
      {fmt::format("{}: terms that (4) and (5) do not have, over K_theta", hull.name),
       (std::abs(in_r(0, 0)) + std::abs(in_r(0, 1)) + std::abs(in_r(1, 1)) + std::abs(in_r(2, 0)) +
        std::abs(in_theta(0, 0)) + std::abs(in_theta(1, 0)) + std::abs(in_theta(0, 2)) + std::abs(in_theta(2, 0))) /
           K_theta,
       ""});
}

}  // namespace

Outcome outcome(const Folders&) {
  Outcome out;
  add_hull(cylinder, out);
  add_hull(sphere, out);
  const dynamics::Model model = model_of(cylinder);
  const double I_0 = I_B + I_S + m_B * (L + z_B) * (L + z_B) + m_S * (L + z_S) * (L + z_S);
  const auto inertia = series([&](double r, double t) { return 2 * kinetic(model, r, t, 0, 1); }, 4, 0.5, 0.15);
  out.numbers.push_back({"inertia of theta: I_0 in (2), relative", inertia(0, 0) / I_0 - 1, ""});
  out.numbers.push_back(
      {"inertia of theta: r 2 m (L + z) in (2), relative", inertia(1, 0) / (2 * m_B * (L + z_B)) - 1, ""});
  out.numbers.push_back({"inertia of theta: r^2 m in (2), relative", inertia(2, 0) / m_B - 1, ""});
  out.numbers.push_back({"inertia of r: m in (1), relative", 2 * kinetic(model, 0.3, 0.1, 1, 0) / m_B - 1, ""});
  return out;
}

}  // namespace froude::validation::orszaghova_expansion
