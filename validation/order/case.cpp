#include <cmath>
#include <functional>
#include <limits>
#include <memory>

#include "dynamics/integrate/energy_momentum.hpp"
#include "dynamics/integrate/euler.hpp"
#include "dynamics/integrate/explicit_pair.hpp"
#include "dynamics/integrate/generalized_alpha.hpp"
#include "harness/case.hpp"
#include "support/double_pendulum.hpp"

namespace froude::validation::order {
namespace {

using dynamics::Integrator, dynamics::Model, dynamics::State;
using Make = std::function<std::unique_ptr<Integrator>(const Model&)>;
constexpr double duration = 1.6;  // both rods have swung through

State after(const Model& model, const Make& make, double h) {
  dynamics::Workspace w(model, dynamics::rest_state(model.bodies()));
  const auto integrator = make(model);
  integrator->start(w);
  for (int i = 0; i < std::lround(duration / h); ++i) integrator->step(w, h);
  return w.state;
}

double distance(const State& a, const State& b) {
  double d = (a.velocity - b.velocity).norm();
  for (std::size_t i = 0; i < a.pose.size(); ++i) d += (a.pose[i].centre - b.pose[i].centre).norm();
  return d;
}

struct Method {
  const char* name;
  Make make;
  double coarsest;  ///< s
};

const std::vector<Method>& methods() {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  static const std::vector<Method> all{
      {"generalised-alpha, rho_infinity 0.8",
       [](const Model& m) {
         return std::make_unique<dynamics::GeneralizedAlpha>(m, dynamics::GeneralizedAlpha::Settings{});
       },
       0.016},
      {"energy-momentum", [](const Model& m) { return std::make_unique<dynamics::EnergyMomentum>(m); }, 0.016},
      {"explicit pair, one step of order 5 each",
       [](const Model& m) {
         return std::make_unique<dynamics::ExplicitPair>(m, dynamics::ExplicitPair::Settings{infinite});
       },
       0.04},
      {"implicit Euler", [](const Model& m) { return std::make_unique<dynamics::ImplicitEuler>(m); }, 4e-3},
      {"semi-implicit Euler", [](const Model& m) { return std::make_unique<dynamics::SemiImplicitEuler>(m); }, 4e-3}};
  return all;
}

double energy_drift(const Model& model) {
  dynamics::Workspace w(model, dynamics::rest_state(model.bodies()));
  dynamics::EnergyMomentum integrator(model);
  integrator.start(w);
  double worst = 0, most = 0;
  for (int i = 0; i < 1000; ++i) {
    integrator.step(w, 0.03);
    const double kinetic = model.kinetic_energy(w.state);
    worst = std::max(worst, std::abs(kinetic + support::height_energy(w.state)));
    most = std::max(most, kinetic);
  }
  return worst / most;
}

}  // namespace

Outcome outcome(const Folders&) {
  const Model model = support::double_pendulum(0.4);
  const State exact = after(
      model,
      [](const Model& m) {
        return std::make_unique<dynamics::ExplicitPair>(m, dynamics::ExplicitPair::Settings{1e-13});
      },
      0.01);
  Outcome out;
  plot::Figure f{.title = "Error of each integrator after 1.6 s",
                 .panels = {{.x = {"step", "s"}, .y = {"error", "m and m/s"}, .series = {}}}};
  f.panels[0].x.scale = f.panels[0].y.scale = plot::Scale::logarithmic;
  for (const Method& method : methods()) {
    plot::Series series{.name = method.name, .x = {}, .y = {}};
    for (double h = method.coarsest; series.x.size() < 4; h /= 2) {
      series.x.push_back(h);
      series.y.push_back(distance(after(model, method.make, h), exact));
    }
    const auto& error = series.y;
    out.numbers.push_back({method.name, std::log2(error[error.size() - 2] / error.back()), ""});
    f.panels[0].series.push_back(std::move(series));
  }
  out.numbers.push_back(
      {"energy-momentum: energy lost or gained in 30 s at h = 0.03 s, relative", energy_drift(model), ""});
  out.pictures.push_back({"orders", "Straight lines whose slopes are the orders: 1, 2 and 5.", f});
  return out;
}

}  // namespace froude::validation::order
