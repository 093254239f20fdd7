#include "rosenbrock.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dynamics::line {

/// RODAS in the form that needs no products with the derivatives (Hairer & Wanner 1996, section IV.7; the numbers are
/// those of their program of that name): a and c of each stage, its time, and what it takes of the derivative by time.
namespace rodas {
constexpr double gamma = 0.25;
constexpr double a[6][5] = {{},
                             {1.544},
                             {0.9466785280815826, 0.2557011698983284},
                             {3.314825187068521, 2.896124015972201, 0.9986419139977817},
                             {1.221224509226641, 6.019134481288629, 12.53708332932087, -0.6878860361058950},
                             {1.221224509226641, 6.019134481288629, 12.53708332932087, -0.6878860361058950, 1}};
constexpr double c[6][5] = {
    {},
    {-5.6688},
    {-2.430093356833875, -0.2063599157091915},
    {-0.1073529058151375, -9.594562251023355, -20.47028614809616},
    {7.496443313967647, -10.24680431464352, -33.99990352819905, 11.70890893206160},
    {8.083246795921522, -7.981132988064893, -31.52159432874371, 16.31930543123136, -6.058818238834054}};
constexpr double time[6] = {0, 0.386, 0.21, 0.63, 1, 1};
constexpr double by_time[6] = {0.25, -0.1043, 0.1035, -0.0362, 0, 0};

}  // namespace rodas

Rosenbrock::Rosenbrock(const Line& line)
    : line_(line), balance_(line), nodes_(line.nodes()), places_(3 * line.nodes()) {
  const Eigen::Index size = 3 * places_ + line.segments();
  from_ = at_ = Eigen::VectorXd::Zero(size);
  add_ = Eigen::MatrixXd::Zero(size, stages);
  rates_ = Eigen::VectorXd::Zero(2 * places_);
  here_ = {Places::Zero(3, nodes_), Eigen::VectorXd::Zero(line.segments())};
  by_time_ = right_ = here_;
  weight_ = line.constant_load().colwise().norm().sum();
}

Instant Rosenbrock::instant(double t, double* y, const Places* water_at) {
  const Eigen::Map<Eigen::VectorXd> T(y + 3 * places_, line_.segments());
  return {t, places(y), places(y + places_), places(y + 2 * places_), T, water_at};
}

const Powers& Rosenbrock::begin(const State& state, const Places& a) {
  t_ = state.time;
  places(from_.data()) = state.position;
  places(from_.data() + places_) = state.velocity;
  places(from_.data() + 2 * places_) = a;
  from_.tail(line_.segments()) = state.tension;
  balance_.linearise(instant(t_, from_.data()), here_, powers_);
  return powers_;
}

bool Rosenbrock::is_at(const State& state) {
  if (places(from_.data()) != state.position || places(from_.data() + places_) != state.velocity) return false;
  t_ = state.time;
  return true;
}

// (D138)
bool Rosenbrock::add_stage(int i, double h) {
  const double by = 1 / (rodas::gamma * h), past = rodas::time[i] * h;
  double* const y = at_.data();
  at_ = from_;
  for (int j = 0; j < i; ++j) at_ += rodas::a[i][j] * add_.col(j);
  balance_.prescribe(t_ + past, places(y), places(y + places_), places(y + 2 * places_));
  if (i == 0) {
    right_.force = -here_.force;
    right_.law = -here_.law;
  } else {
    water_at_ = places(from_.data()) + past * places(from_.data() + places_) +
                past * past / 2 * places(from_.data() + 2 * places_);
    balance_.evaluate(instant(t_ + past, y, &water_at_), right_);
    right_.force = -right_.force;
    right_.law = -right_.law;
  }
  if (rodas::by_time[i] != 0 && balance_.changes_by_time()) {
    right_.force -= h * rodas::by_time[i] * by_time_.force;
    right_.law -= h * rodas::by_time[i] * by_time_.law;
  }
  auto rho = rates_.head(places_), sum = rates_.tail(places_);
  rho = at_.segment(places_, places_);
  sum = at_.segment(2 * places_, places_);
  for (int j = 0; j < i; ++j) {
    rho += rodas::c[i][j] / h * add_.col(j).head(places_);
    sum += rodas::c[i][j] / h * add_.col(j).segment(places_, places_);
  }
  for (const Held& held : line_.description().held) {
    rho.segment<3>(3 * held.node).setZero();
    sum.segment<3>(3 * held.node).setZero();
  }
  auto x = add_.col(i).head(places_), v = add_.col(i).segment(places_, places_),
       acceleration = add_.col(i).segment(2 * places_, places_);
  const Eigen::VectorXd sigma = sum;
  sum += by * rho;
  balance_.add_rates(places(rates_.data()), places(rates_.data() + places_), right_);
  balance_.solve(right_, places(add_.col(i).data()), add_.col(i).tail(line_.segments()));
  v = by * x - rho;
  acceleration = by * v - sigma;
  return add_.col(i).allFinite();
}

double Rosenbrock::error() const {
  const auto last = add_.col(stages - 1);
  const double pull = std::max(weight_, from_.tail(line_.segments()).cwiseAbs().maxCoeff());
  return std::max(last.tail(line_.segments()).cwiseAbs().maxCoeff() / pull,
                  last.head(places_).cwiseAbs().maxCoeff() * line_.segments() / line_.length());
}

double Rosenbrock::try_step(double h) {
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  constexpr double share_of_step = 1e-5;
  if (!balance_.factorise(1 / (rodas::gamma * h))) return nothing;
  if (balance_.changes_by_time())
    balance_.differentiate_by_time(instant(t_, from_.data()), here_, share_of_step * h, by_time_);
  for (int i = 0; i < stages; ++i)
    if (!add_stage(i, h)) return nothing;
  at_ += add_.col(stages - 1);
  balance_.prescribe(t_ + h, places(at_.data()), places(at_.data() + places_), places(at_.data() + 2 * places_));
  h_ = h;
  return error();
}

const Powers& Rosenbrock::accept(State& state, Places& a) {
  t_ += h_;
  from_.swap(at_);
  state.time = t_;
  state.position = places(from_.data());
  state.velocity = places(from_.data() + places_);
  a = places(from_.data() + 2 * places_);
  state.tension = from_.tail(line_.segments());
  balance_.linearise(instant(t_, from_.data()), here_, powers_);
  return powers_;
}

}  // namespace dynamics::line
