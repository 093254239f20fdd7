#include "dynamics/line/driven.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <utility>

#include "dynamics/time/alpha_parameters.hpp"
#include "hydro/base/error.hpp"

namespace dynamics::line {
namespace {

using Eigen::Vector3d;

/// From one place, velocity and acceleration to another: the polynomial of fifth degree between, for steps that the
/// line has to halve.
class Way final : public Path {
 public:
  double from = 0, to = 0;  // s
  Place begin{}, end{};

  Place at(double t_s) const override {
    const double h = to - from;
    if (!(h > 0) || t_s >= to - 1e-12 * h) return end;  // but for the rounding of sums of times
    if (t_s <= from) return begin;
    const double s = (t_s - from) / h;
    const Vector3d p0 = begin.position, p1 = h * begin.velocity, p2 = h * h / 2 * begin.acceleration;
    const Vector3d x = end.position - p0 - p1 - p2, v = h * end.velocity - p1 - 2 * p2,
                   a = h * h * end.acceleration - 2 * p2;
    const Vector3d c3 = 10 * x - 4 * v + a / 2, c4 = -15 * x + 7 * v - a, c5 = 6 * x - 3 * v + a / 2;
    const double s2 = s * s, s3 = s2 * s;
    return {p0 + s * p1 + s2 * p2 + s3 * (c3 + s * (c4 + s * c5)),
            (p1 + 2 * s * p2 + s2 * (3 * c3 + s * (4 * c4 + 5 * s * c5))) / h,
            (2 * p2 + s * (6 * c3 + s * (12 * c4 + 20 * s * c5))) / (h * h)};
  }
};

Description prescribed_by(Description d, const std::vector<int>& prescribed,
                          const std::vector<std::shared_ptr<Way>>& ways) {
  for (Held& h : d.held)
    for (std::size_t k = 0; k < prescribed.size(); ++k)
      if (h.node == prescribed[k]) h.path = ways[k];
  return d;
}

std::vector<std::shared_ptr<Way>> make_ways(std::size_t count) {
  std::vector<std::shared_ptr<Way>> out;
  for (std::size_t k = 0; k < count; ++k) out.push_back(std::make_shared<Way>());
  return out;
}

}  // namespace

struct DrivenLine::Work {
  std::vector<int> prescribed;
  std::vector<std::shared_ptr<Way>> ways;
  Line line;
  Stepper stepper;
  AlphaParameters alpha;
  State state;                        // accepted
  std::vector<Path::Place> now;       // of the ends, accepted
  std::vector<Vector3d> algorithmic;  // (D10) of the ends

  struct {
    double t = std::numeric_limits<double>::quiet_NaN();
    std::vector<End> ends = {};
    std::vector<Vector3d> algorithmic = {};
    State state = {};
    Pulls pulls = {};
    std::string failure = {};
    bool followed = false;  // pulls have their derivatives
  } tried = {};
  Stepper::Balance balance;  // of what is accepted, once somebody has asked for it
  bool balanced = false;
  State moved;  // room for look()
  Stepper::Balance moved_balance;

  Work(Description d, std::vector<int> nodes, double rho)
      : prescribed(std::move(nodes)),
        ways(make_ways(prescribed.size())),
        line(prescribed_by(std::move(d), prescribed, ways)),
        stepper(line, {.scheme = Scheme::generalised_alpha, .rho_infinity = rho}),
        alpha(rho) {}

  bool is_now(double t) const { return t - state.time <= 1e-12 * std::max(1.0, std::abs(t)); }
  void prescribe(double t, const std::vector<End>& ends);
  void stay() const;
  void try_at(double t, const std::vector<End>& ends);
  void try_step(double t);
  void find_derivatives();
  bool are_there(const std::vector<End>& ends) const;
  const Stepper::Balance& balance_now();
  const Stepper::Balance* balance_at(const std::vector<End>& ends);
  void look(const std::vector<End>& ends);
  void pull(double force);
};

DrivenLine::DrivenLine(Description description, std::vector<int> prescribed, double rho_infinity)
    : work_(std::make_unique<Work>(std::move(description), std::move(prescribed), rho_infinity)) {
  for (const int node : work_->prescribed)
    hydro::ensure(work_->line.held(node) != nullptr, "a node with prescribed motion is held");
}

DrivenLine::~DrivenLine() = default;

/// Pulls with that in each direction, whatever the ends do.
void DrivenLine::Work::pull(double force) {
  tried.followed = true;
  const auto n = static_cast<Eigen::Index>(prescribed.size());
  tried.pulls.force.setConstant(3, n, force);
  tried.pulls.by_place.setZero(3 * n, 3 * n);
  tried.pulls.by_velocity.setZero(3 * n, 3 * n);
}

void DrivenLine::Work::find_derivatives() {
  if (std::exchange(tried.followed, true)) return;
  const double h = tried.t - state.time;
  const Response& found = stepper.response(prescribed, (1 - alpha.alpha_m) / ((1 - alpha.alpha_f) * alpha.gamma * h));
  tried.pulls.by_place = -found.by_place;
  tried.pulls.by_velocity = -found.by_velocity;
}

/// Everything stays where it was accepted.
void DrivenLine::Work::stay() const {
  for (std::size_t k = 0; k < prescribed.size(); ++k) {
    ways[k]->from = ways[k]->to = state.time;
    ways[k]->begin = ways[k]->end = now[k];
  }
}

void DrivenLine::start(const State& state, const std::vector<End>& ends, const Places& accelerations) {
  Work& w = *work_;
  w.state = state;
  w.now.clear();
  w.algorithmic.clear();
  for (std::size_t k = 0; k < ends.size(); ++k) {
    w.now.push_back({ends[k].position, ends[k].velocity, accelerations.col(static_cast<Eigen::Index>(k))});
    w.algorithmic.push_back(w.now.back().acceleration);
  }
  w.tried.t = std::numeric_limits<double>::quiet_NaN();
  w.balanced = false;
  w.stay();
  w.stepper.start(w.state);
  w.stepper.keep(w.state);
}

/// Where the ends go until t, with the accelerations that (D10) makes of their velocities.
void DrivenLine::Work::prescribe(double t, const std::vector<End>& ends) {
  const double h = t - state.time;
  const auto [alpha_m, alpha_f, gamma, beta] = alpha;
  tried.algorithmic.resize(prescribed.size());
  for (std::size_t k = 0; k < prescribed.size(); ++k) {
    const Vector3d next = ((ends[k].velocity - now[k].velocity) / h - (1 - gamma) * algorithmic[k]) / gamma;
    const Vector3d a =
        ((1 - alpha_m) * next + alpha_m * algorithmic[k] - alpha_f * now[k].acceleration) / (1 - alpha_f);
    tried.algorithmic[k] = next;
    Way& way = *ways[k];
    way.from = state.time;
    way.to = t;
    way.begin = now[k];
    way.end = {ends[k].position, ends[k].velocity, a};
  }
}

void DrivenLine::Work::try_step(double t) {
  const double h = t - state.time;
  tried.followed = false;
  tried.state = state;
  try {
    stepper.try_step(tried.state, h);
    tried.pulls.force.resize(3, static_cast<Eigen::Index>(prescribed.size()));
    for (std::size_t k = 0; k < prescribed.size(); ++k)
      tried.pulls.force.col(static_cast<Eigen::Index>(k)) = -stepper.needed().col(prescribed[k]);
  } catch (const hydro::NumericsError& e) {
    tried.failure = e.what();
    pull(std::numeric_limits<double>::quiet_NaN());
  }
}

bool DrivenLine::Work::are_there(const std::vector<End>& ends) const {
  for (std::size_t k = 0; k < ends.size(); ++k)
    if (ends[k].position != now[k].position || ends[k].velocity != now[k].velocity) return false;
  return true;
}

const Stepper::Balance& DrivenLine::Work::balance_now() {
  if (!balanced) {
    stay();
    balanced = stepper.find_balance(state, balance);
    hydro::ensure(balanced, "a line with masses has accelerations");
  }
  return balance;
}

/// Of this instant with its ends moved to where they are asked for; null if there is none.
const Stepper::Balance* DrivenLine::Work::balance_at(const std::vector<End>& ends) {
  stay();
  moved = state;
  for (std::size_t k = 0; k < prescribed.size(); ++k) {
    moved.position.col(prescribed[k]) = ends[k].position;
    moved.velocity.col(prescribed[k]) = ends[k].velocity;
    ways[k]->end.velocity = ends[k].velocity;
  }
  return stepper.find_balance(moved, moved_balance) ? &moved_balance : nullptr;
}

/// Pulls of this instant.
void DrivenLine::Work::look(const std::vector<End>& ends) {
  pull(0);
  const Stepper::Balance* found = are_there(ends) ? &balance_now() : balance_at(ends);
  for (std::size_t k = 0; k < prescribed.size(); ++k)
    tried.pulls.force.col(static_cast<Eigen::Index>(k)) =
        found != nullptr ? Vector3d(-found->holding.col(prescribed[k]))
                         : Vector3d(Vector3d::Constant(std::numeric_limits<double>::quiet_NaN()));
}

void DrivenLine::Work::try_at(double t, const std::vector<End>& ends) {
  if (tried.t == t && tried.ends == ends) return;
  tried.t = t;
  tried.ends = ends;
  tried.failure.clear();
  if (is_now(t)) {
    look(ends);
  } else {
    prescribe(t, ends);
    try_step(t);
  }
}

const Places& DrivenLine::force(double t_s, const std::vector<End>& ends) {
  work_->try_at(t_s, ends);
  return work_->tried.pulls.force;
}

const DrivenLine::Pulls& DrivenLine::pulls(double t_s, const std::vector<End>& ends) {
  work_->try_at(t_s, ends);
  work_->find_derivatives();
  return work_->tried.pulls;
}

void DrivenLine::accept(double t_s, const std::vector<End>& ends) {
  Work& w = *work_;
  if (w.is_now(t_s)) return;
  w.try_at(t_s, ends);
  if (!w.tried.failure.empty()) throw hydro::NumericsError(w.tried.failure);
  w.state = w.tried.state;
  w.algorithmic = w.tried.algorithmic;
  for (std::size_t k = 0; k < w.prescribed.size(); ++k) w.now[k] = w.ways[k]->end;
  w.tried.t = std::numeric_limits<double>::quiet_NaN();
  w.balanced = false;
  w.stepper.keep(w.state);
  w.stay();
}

void DrivenLine::keep_state(hydro::StateBytes& bytes) {
  Work& w = *work_;
  bytes.pass(w.state);
  for (Path::Place& end : w.now) bytes.pass(end.position, end.velocity, end.acceleration);
  for (Vector3d& one : w.algorithmic) bytes.pass(one);
  w.stepper.keep_state(w.state, bytes);
  if (!bytes.gives_back()) return;
  w.tried.t = std::numeric_limits<double>::quiet_NaN();
  w.balanced = false;
  w.stay();
}

const Line& DrivenLine::line() const { return work_->line; }
const State& DrivenLine::state() const { return work_->state; }
const Energies& DrivenLine::energies() const { return work_->stepper.energies(); }
Stepper::Flow DrivenLine::flow() const { return work_->stepper.flow(); }

const Stepper::Balance& DrivenLine::balance() const {
  if (!work_->balanced) work_->tried.t = std::numeric_limits<double>::quiet_NaN();  // its ends stay
  return work_->balance_now();
}

}  // namespace dynamics::line
