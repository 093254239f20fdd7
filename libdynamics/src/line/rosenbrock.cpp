#include "rosenbrock.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hydro/base/machine.hpp"

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
  rates_ = Eigen::VectorXd::Zero(3 * places_);
  here_ = {Places::Zero(3, nodes_), Eigen::VectorXd::Zero(line.segments())};
  by_time_ = right_ = here_;
  weight_ = line.constant_load().colwise().norm().sum();
  for (const Node& n : line.description().nodes)
    for (const TimedForce& load : n.loads) weight_ += load.force.norm();
}

Instant Rosenbrock::instant(double t, double* y, const Places* water_at) {
  const Eigen::Map<Eigen::VectorXd> T(y + 3 * places_, line_.segments());
  return {{t, places(y), places(y + places_), places(y + 2 * places_), water_at}, T};
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

namespace {

/// out = base + Σ c_j k_j over `size` numbers; the k_j are the columns of a matrix with so many rows.
FROUDE_EVERY_MACHINE void combine(Eigen::Index size, const double* base, const double* k, Eigen::Index rows, int count,
                                  const double* c, double* out) {
  using hydro::Four;
  Eigen::Index e = 0;
  for (; e + 4 <= size; e += 4) {
    Four sum = *reinterpret_cast<const Four*>(base + e);
    for (int j = 0; j < count; ++j) sum += c[j] * *reinterpret_cast<const Four*>(k + j * rows + e);
    *reinterpret_cast<Four*>(out + e) = sum;
  }
  for (; e < size; ++e) {
    out[e] = base[e];
    for (int j = 0; j < count; ++j) out[e] += c[j] * k[j * rows + e];
  }
}

}  // namespace

/// What the balance of stage i leaves over, with its sign turned.
void Rosenbrock::find_right_side(int i, double h) {
  const double past = rodas::time[i] * h;
  double* const y = at_.data();
  if (i == 0) {
    right_ = here_;
  } else {
    water_at_ = places(from_.data()) + past * places(from_.data() + places_) +
                past * past / 2 * places(from_.data() + 2 * places_);
    balance_.evaluate(instant(t_ + past, y, &water_at_), right_);
  }
  const double share = balance_.changes_by_time() ? h * rodas::by_time[i] : 0;
  right_.force = -right_.force - share * by_time_.force;
  right_.law = -right_.law - share * by_time_.law;
}

// (D139)
void Rosenbrock::add_stage(int i, double h) {
  const double by = 1 / (rodas::gamma * h);
  double* const y = at_.data();
  combine(at_.size(), from_.data(), add_.data(), add_.rows(), i, rodas::a[i], y);
  balance_.prescribe(t_ + rodas::time[i] * h, places(y), places(y + places_), places(y + 2 * places_));
  find_right_side(i, h);
  // ρ and σ, of places and velocities.
  double c[stages];
  for (int j = 0; j < i; ++j) c[j] = rodas::c[i][j] / h;
  combine(2 * places_, y + places_, add_.data(), add_.rows(), i, c, rates_.data());
  for (const Held& held : line_.description().held)
    for (const Eigen::Index begin : {3L * held.node, places_ + 3L * held.node}) rates_.segment<3>(begin).setZero();
  const auto rho = rates_.head(places_), sigma = rates_.segment(places_, places_);
  rates_.tail(places_) = by * rho + sigma;
  balance_.add_rates(places(rates_.data()), places(rates_.data() + 2 * places_), right_);
  auto added = add_.col(i);
  balance_.solve(right_, places(added.data()), added.tail(line_.segments()));
  added.segment(places_, places_) = by * added.head(places_) - rho;
  added.segment(2 * places_, places_) = by * added.segment(places_, places_) - sigma;
}

/// (D140)
double Rosenbrock::error() const {
  const auto last = add_.col(stages - 1);
  const double pull = std::max(weight_, from_.tail(line_.segments()).cwiseAbs().maxCoeff());
  double push = 0;
  for (const Bed& bed : line_.description().bed)
    for (int i = 0; i < nodes_; ++i)
      if (std::min(from_[3 * i + 2], at_[3 * i + 2]) < bed.z)
        push = std::max(push, bed.stiffness * line_.bed_area(i) * std::abs(last[3 * i + 2]));
  return std::max({last.tail(line_.segments()).cwiseAbs().maxCoeff() / pull, push / pull,
                   last.head(places_).cwiseAbs().maxCoeff() * line_.segments() / line_.length()});
}

double Rosenbrock::try_step(double h) {
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  constexpr double share_of_step = 1e-5;
  if (!balance_.factorise(1 / (rodas::gamma * h))) return nothing;
  if (balance_.changes_by_time())
    balance_.differentiate_by_time(instant(t_, from_.data()), here_, share_of_step * h, by_time_);
  for (int i = 0; i < stages; ++i) add_stage(i, h);
  at_ += add_.col(stages - 1);
  if (!at_.allFinite()) return nothing;
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
