#include "dynamics/line/stepper.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "dynamics/time/alpha_parameters.hpp"
#include "equations.hpp"
#include "hydro/base/error.hpp"
#include "rosenbrock.hpp"

namespace dynamics::line {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double closed = 1e-9;  // of a length, and of a speed: what rounding of given places leaves

/// Two steps, each the difference of times that are sums of steps.
bool as_long(double one, double other) {
  constexpr double rounding = 1e-9;
  return std::abs(one - other) <= rounding * other;
}

}  // namespace

struct Stepper::Work {
  const Line& line;
  Settings settings;
  Equations equations;
  Places a, algorithmic;  // accelerations at the start of a step, and those that generalised-α steps with
  Energies energies;
  Powers before;  // at the start of a step
  struct {
    Stage stage;
    State from;
    Places u;
    VectorXd T;
  } last = {};  // step
  // Where the last whole step of generalised-α began, and how long it was: what follows goes on from it in a straight
  // line.
  struct Previous {
    double h = 0;
    Places algorithmic = {};
    VectorXd tension = {};
    void keep_state(hydro::StateBytes& bytes) { bytes.pass(h, algorithmic, tension); }
  } previous;
  // The state that was booked last, and whether what it holds is not in the energies yet: most steps nobody asks for
  // it.
  State to_note;
  bool unnoted = false;
  struct Earlier {
    Powers powers = {};
    double h = 0;
    void keep_state(hydro::StateBytes& bytes) { bytes.pass(powers, h); }
  };                    // where the last sub-step began, and how long it was; 0: there was none
  double unbooked = 0;  // s: the last step, or its last part, whose powers are not in the energies yet; 0: they are
  struct {
    Places a, algorithmic;
    Energies energies;
    Powers before;
    Previous previous;
    double sub_step = 0;
    Earlier earlier = {};
    double within = std::numeric_limits<double>::quiet_NaN();
  } kept = {};
  // Where a step that is tried began, and what it makes on the way: kept from step to step, so that it asks for no
  // memory.
  State before_step, next;
  Places a_before_step, algorithmic_before_step, velocity_before, known, none;
  Stage now;
  std::string failure;
  std::optional<Rosenbrock> rosenbrock = {};
  double sub_step = 0;  // s: of it, that the last one's error asks for; 0: not known yet
  Earlier earlier = {};

  Work(const Line& l, const Settings& s) : line(l), settings(s), equations(l), none(Places::Zero(3, l.nodes())) {}

  bool try_step(State& state, double h, StepReport& report);
  void book(State& state);
  bool energy_momentum(State& state, double h, StepReport& report);
  bool generalised_alpha(State& state, double h, StepReport& report);
  bool go_on_straight(double beta, const State& state, StepReport& report);
  bool gamma(State& state, double h, StepReport& report);
  bool euler(State& state, double h);
  bool newton(Stage& stage, const State& state, Places& u, VectorXd& T, StepReport& report);
  bool solve(Stage& stage, const State& state, Places& u, VectorXd& T, StepReport& report);
  void prescribe(State& state) const;
  void require_lengths(const State& state) const;
  void require_ties(const State& state) const;
  bool settle(State& state);
  bool has_stepped_to(const State& state) const;
  Powers powers_now(const State& state, const Stage* flow_of = nullptr);
  void note_powers(const Powers& mean, double h);
  void note_state(const State& state);
  void advance(State& state, double h, int depth, StepReport& report);
  void stay_in_piece_of(double t);
  bool changes_piece(double t, double then) const;
  void enter_piece(State& state, double within);
  void advance_between_corners(State& state, double h, StepReport& report);
  void advance_by_sub_steps(State& state, double h, StepReport& report);
  double next_sub_step(double taken, double error) const;
  void note_powers_since_sub_step(const Powers& after, double tau);
};

Stepper::Stepper(const Line& line, const Settings& settings) : work_(std::make_unique<Work>(line, settings)) {
  hydro::require(settings.rho_infinity >= 0 && settings.rho_infinity <= 1,
                 "rho_infinity must lie between 0 and 1, got {}", settings.rho_infinity);
  hydro::require(settings.gamma > 0 && settings.gamma <= 1, "gamma must lie above 0 and not above 1, got {}",
                 settings.gamma);
  bool kept = false, catenary = false;
  for (int j = 0; j < line.segments(); ++j) {
    kept = kept || line.segment(j).is_inextensible();
    catenary = catenary || line.segment(j).catenary;
  }
  if (settings.scheme == Scheme::energy_momentum && catenary)
    throw hydro::InputError("energy-momentum has no means of catenary segments", {}, "step with \"generalized_alpha\"");
  if (settings.scheme == Scheme::generalised_alpha && settings.rho_infinity == 1 && kept)
    throw hydro::InputError("generalised-α with rho_infinity = 1 lets the tensions of inextensible segments grow", {},
                            "take rho_infinity below 1, or step with \"energy_momentum\"");
  if (settings.scheme != Scheme::energy_momentum && line.has_massless_nodes())
    throw hydro::InputError(
        fmt::format("a free node of the line has no mass, so {} finds no accelerations", name_of(settings.scheme)), {},
        "give every free node or segment a mass, or step with \"energy_momentum\"");
  if (settings.scheme != Scheme::rosenbrock) return;
  hydro::require(settings.local_error > 0, "local_error must lie above 0, got {}", settings.local_error);
  if (const auto [why, remedy] = ChainBalance::unfit(line); !why.empty())
    throw hydro::InputError(fmt::format("steps of \"rosenbrock\" are not made for {}", why), {}, remedy);
  work_->rosenbrock.emplace(line);
}

Stepper::~Stepper() = default;

const Energies& Stepper::energies() const {
  Work& w = *work_;
  if (std::exchange(w.unnoted, false)) w.note_state(w.to_note);
  return w.energies;
}

Stepper::Flow Stepper::flow() const {
  const Powers& p = work_->before;
  return {p.drag_supplied + p.inertia_supplied + p.buoyancy_supplied + p.load_supplied,
          p.damping + p.drag_dissipated + p.axial + p.bed + p.friction};
}

void Stepper::keep(State& state) {
  Work& w = *work_;
  w.book(state);
  w.kept.a = w.a;
  w.kept.algorithmic = w.algorithmic;
  w.kept.energies = w.energies;
  w.kept.before = w.before;
  w.kept.previous = w.previous;
  w.kept.sub_step = w.sub_step;
  w.kept.earlier = w.earlier;
  w.kept.within = w.equations.within();
}

void Stepper::keep_state(State& state, hydro::StateBytes& bytes) {
  Work& w = *work_;
  energies();  // which are brought up to the state
  double within = w.equations.within();
  bytes.pass(w.a, w.algorithmic, w.energies, w.before, w.previous, w.sub_step, w.earlier, within);
  if (!bytes.gives_back()) return;
  w.unbooked = 0;
  w.unnoted = false;
  w.stay_in_piece_of(within);
  if (w.rosenbrock) w.rosenbrock->begin(state, w.a);
  keep(state);
}

StepReport Stepper::try_step(State& state, double h) {
  Work& w = *work_;
  w.a = w.kept.a;
  w.algorithmic = w.kept.algorithmic;
  w.energies = w.kept.energies;
  w.before = w.kept.before;
  w.previous = w.kept.previous;
  w.sub_step = w.kept.sub_step;
  w.earlier = w.kept.earlier;
  w.stay_in_piece_of(w.kept.within);
  w.unbooked = 0;
  StepReport report;
  w.advance_between_corners(state, h, report);
  return report;
}

const Places& Stepper::needed() const { return work_->equations.needed(); }

const Response& Stepper::response(const std::vector<int>& prescribed, double a_by_v) {
  Work& w = *work_;
  return w.equations.response(w.last.stage, w.last.from, w.last.u, w.last.T, prescribed, a_by_v);
}

std::optional<Stepper::Balance> Stepper::balance(const State& state) {
  Balance out;
  if (!find_balance(state, out)) return std::nullopt;
  return out;
}

bool Stepper::find_balance(const State& state, Balance& out) {
  const Stage* flow_of = work_->has_stepped_to(state) ? &work_->last.stage : nullptr;
  if (!work_->equations.accelerations(state, out.acceleration, out.tension, flow_of)) return false;
  work_->equations.find_holding(state, out.acceleration, out.tension, out.holding, flow_of);
  return true;
}

/// True where the last step of generalised-α ended there: its flow is that of the state.
bool Stepper::Work::has_stepped_to(const State& state) const {
  constexpr double rounding = 1e-12;  // of places
  if (settings.scheme != Scheme::generalised_alpha || last.stage.end != state.time) return false;
  if (last.from.position.cols() != state.position.cols()) return false;
  const double farthest = state.position.cwiseAbs().maxCoeff();
  return (state.position - last.from.position - last.u).cwiseAbs().maxCoeff() <= rounding * farthest;
}

/// Held nodes where their paths have them.
void Stepper::Work::prescribe(State& state) const {
  for (const Held& h : line.description().held) {
    if (!h.path) {
      state.velocity.col(h.node).setZero();
      continue;
    }
    const Path::Place p = h.path->at(state.time);
    state.position.col(h.node) = p.position;
    state.velocity.col(h.node) = p.velocity;
  }
}

void Stepper::Work::require_lengths(const State& state) const {
  const double fastest = std::max(1.0, state.velocity.cwiseAbs().maxCoeff());
  for (int j = 0; j < line.segments(); ++j) {
    if (!line.segment(j).is_inextensible()) continue;
    const int i = line.first(j);
    const Vector3d d = state.position.col(i + 1) - state.position.col(i);
    hydro::require(std::abs(d.norm() - line.segment(j).length) <= closed * line.segment(j).length,
                   "segment {} is inextensible, {} m long, but the line starts with its nodes {} m apart", j + 1,
                   line.segment(j).length, d.norm());
    const double rate = d.normalized().dot(state.velocity.col(i + 1) - state.velocity.col(i));
    hydro::require(std::abs(rate) <= closed * fastest,
                   "segment {} is inextensible, but the velocities at the start change it by {} m/s", j + 1, rate);
  }
}

void Stepper::Work::require_ties(const State& state) const {
  for (int i = 0; i < line.nodes(); ++i) {
    const int one = line.same_as(i);
    hydro::require(state.position.col(i) == state.position.col(one) && state.velocity.col(i) == state.velocity.col(one),
                   "nodes {} and {} are tied, but start at different places or velocities", one, i);
  }
}

void Stepper::start(State& state) {
  Work& w = *work_;
  const Line& line = w.line;
  hydro::require(state.position.cols() == line.nodes() && state.velocity.cols() == line.nodes(),
                 "a line of {} nodes cannot start with {}", line.nodes(), state.position.cols());
  w.prescribe(state);
  // A line at rest whose end moves off at once takes the nearest velocities that its lengths allow.
  const bool prescribed = std::any_of(line.description().held.begin(), line.description().held.end(),
                                      [](const Held& h) { return h.path != nullptr; });
  if (prescribed) w.equations.project_velocity(state, state.velocity);
  w.require_lengths(state);
  w.require_ties(state);
  if (state.grip.cols() != line.nodes()) state.grip = state.position.topRows<2>();
  go_on(state);
  w.energies = {};
  w.unnoted = false;
  w.before = w.powers_now(state);
  w.note_state(state);
  w.energies.lost_friction = 0;
  w.energies.at_start = w.energies.total();
}

void Stepper::go_on(State& state) {
  Work& w = *work_;
  w.previous.h = 0;
  w.sub_step = w.earlier.h = 0;
  w.stay_in_piece_of(std::numeric_limits<double>::quiet_NaN());  // whichever its time lies in
  if (!w.settle(state) && !w.line.has_massless_nodes())
    throw hydro::NumericsError(fmt::format(
        "the line has no accelerations at t = {} s: masses or loads are singular or not finite", state.time));
  w.algorithmic = w.a;
}

/// Accelerations and tensions of the state. Where masses leave them open, tensions to begin Newton with: the weight.
bool Stepper::Work::settle(State& state) {
  if (equations.accelerations(state, a, state.tension)) return true;
  a = none;
  state.tension = VectorXd::Constant(line.segments(), line.constant_load().colwise().norm().sum());
  return false;
}

void Stepper::Work::note_state(const State& state) {
  energies.kinetic = equations.kinetic(state.velocity);
  energies.height = -line.constant_load().cwiseProduct(state.position).sum();
  energies.axial = equations.stored_in_segments(state);
  energies.bed = equations.stored_in_bed(state);
  energies.bending = equations.stored_in_bending(state);
  const double shear = equations.stored_in_shear(state);
  energies.lost_friction -= shear - energies.shear;  // of what friction took, this is held
  energies.shear = shear;
}

/// `flow_of`: a stage of the same instant whose flow the loads had.
Powers Stepper::Work::powers_now(const State& state, const Stage* flow_of) {
  set_instant(state, a, flow_of, now);
  return equations.powers(now, state, none, state.tension);
}

void Stepper::Work::note_powers(const Powers& mean, double h) {
  energies.held += h * mean.held;
  energies.drag += h * mean.drag_supplied;
  energies.inertia += h * mean.inertia_supplied;
  energies.buoyancy += h * mean.buoyancy_supplied;
  energies.loads += h * mean.load_supplied;
  energies.lost_damping += h * mean.damping;
  energies.lost_drag += h * mean.drag_dissipated;
  energies.lost_axial += h * mean.axial;
  energies.lost_bed += h * mean.bed;
  energies.lost_friction += h * mean.friction;
}

/// From the guesses u and T; the flow is foreseen where velocities and accelerations lead, whatever the guess.
bool Stepper::Work::newton(Stage& stage, const State& state, Places& u, VectorXd& T, StepReport& report) {
  stage.foreseen = true;
  stage.water_at = state.position + stage.x_by * (stage.h * state.velocity + stage.h * stage.h / 2 * a);
  const auto outcome = equations.solve(stage, state, settings.tolerance, settings.iterations, u, T);
  report.newton_iterations += outcome.iterations;
  if (!outcome.converged) failure = fmt::format("{}; node {} is worst", outcome.why, outcome.worst);
  return outcome.converged;
}

bool Stepper::Work::solve(Stage& stage, const State& state, Places& u, VectorXd& T, StepReport& report) {
  u = stage.h * state.velocity + stage.h * stage.h / 2 * a;
  T = state.tension;
  return newton(stage, state, u, T, report);
}

// (D79)
bool Stepper::Work::energy_momentum(State& state, double h, StepReport& report) {
  Stage& stage = last.stage;
  Places& u = last.u;
  stage.set(state.time + h / 2, state.time + h, h);
  stage.set_factors(0.5, 1 / h, 2 / (h * h));
  stage.v_from = none;
  stage.a_from = -2 / h * state.velocity;
  stage.mean = true;
  if (!solve(stage, state, u, last.T, report)) return false;
  note_powers(equations.powers(stage, state, u, last.T), h);
  velocity_before = state.velocity;
  state.position += u;
  state.velocity = 2 / h * u - velocity_before;
  state.tension = last.T;
  state.time = stage.end;
  prescribe(state);
  a = (state.velocity - velocity_before) / h;
  return true;
}

/// From accelerations and tensions that go on as they went in the step before. \returns false where that leads nowhere
bool Stepper::Work::go_on_straight(double beta, const State& state, StepReport& report) {
  const double h = last.stage.h;
  if (!as_long(previous.h, h)) return false;
  last.u = known + h * h * beta * (2 * algorithmic - previous.algorithmic);
  last.T = 2 * state.tension - previous.tension;
  return newton(last.stage, state, last.u, last.T, report);
}

// (D80), with the parameters of (D11).
bool Stepper::Work::generalised_alpha(State& state, double h, StepReport& report) {
  const auto [alpha_m, alpha_f, g, beta] = AlphaParameters(settings.rho_infinity);
  known = h * state.velocity + h * h * (0.5 - beta) * algorithmic;
  const double a_by = (1 - alpha_m) / ((1 - alpha_f) * h * h * beta);
  Stage& stage = last.stage;
  Places& u = last.u;
  stage.set(state.time + h, state.time + h, h);
  stage.set_factors(1, g / (h * beta), a_by);
  stage.v_from = state.velocity + h * (1 - g) * algorithmic - g / (h * beta) * known;
  stage.a_from = (alpha_m * algorithmic - alpha_f * a) / (1 - alpha_f) - a_by * known;
  if (!go_on_straight(beta, state, report) && !solve(stage, state, u, last.T, report)) return false;
  last.from = state;
  state.position += u;
  state.velocity = stage.v_from + stage.v_by * u;
  state.tension = last.T;
  state.time = stage.end;
  a = stage.a_from + stage.a_by * u;
  algorithmic = (u - known) / (h * h * beta);
  prescribe(state);
  return equations.project_velocity(state, state.velocity);
}

// (D81)
bool Stepper::Work::gamma(State& state, double h, StepReport& report) {
  const double g = settings.gamma;
  Stage& stage = last.stage;
  Places& u = last.u;
  stage.set(state.time + h, state.time + h, h);
  stage.set_factors(1, 1 / (h * g), 1 / (h * h * g * g));
  stage.v_from = -(1 - g) / g * state.velocity;
  stage.a_from = -1 / (h * g * g) * state.velocity - (1 - g) / g * a;
  if (!solve(stage, state, u, last.T, report)) return false;
  next = state;
  next.position += u;
  next.velocity = stage.v_from + stage.v_by * u;
  next.time = stage.end;
  prescribe(next);
  if (!equations.project_velocity(next, next.velocity) || !settle(next)) return false;
  state = next;
  return true;
}

// (D82)
bool Stepper::Work::euler(State& state, double h) {
  next = state;
  next.time = state.time + h;
  const bool place_first = settings.scheme == Scheme::explicit_euler;
  next.velocity += h * a;
  next.position += h * (place_first ? state.velocity : next.velocity);
  prescribe(next);
  if (!equations.project_place(state.position, closed * 1e-3 * line.length(), next.position)) {
    failure = "lengths cannot be kept";
    return false;
  }
  if (!place_first) next.velocity = (next.position - state.position) / h;
  prescribe(next);
  if (!equations.project_velocity(next, next.velocity) || !settle(next)) {
    failure = "its equations are singular or not finite";
    return false;
  }
  state = next;
  return true;
}

/// What the last step did to the energies, and to where the bed holds the line.
void Stepper::Work::book(State& state) {
  const double h = std::exchange(unbooked, 0);
  if (h == 0) return;
  if (settings.scheme != Scheme::energy_momentum && settings.scheme != Scheme::rosenbrock) {
    const Powers after = powers_now(state, settings.scheme == Scheme::generalised_alpha ? &last.stage : nullptr);
    note_powers(before, h / 2);
    note_powers(after, h / 2);
    before = after;
  }
  equations.take_grip(state);
  // What friction loses is summed up from step to step.
  unnoted = !line.rubs_on_bed();
  if (unnoted)
    to_note = state;
  else
    note_state(state);
}

bool Stepper::Work::try_step(State& state, double h, StepReport& report) {
  book(state);
  if (settings.scheme == Scheme::energy_momentum) {
    if (!energy_momentum(state, h, report)) return false;
  } else {
    before_step = state;
    a_before_step = a;
    algorithmic_before_step = algorithmic;
    const bool done = settings.scheme == Scheme::generalised_alpha ? generalised_alpha(state, h, report)
                      : settings.scheme == Scheme::gamma           ? gamma(state, h, report)
                                                                   : euler(state, h);
    if (!done || !state.position.allFinite() || !state.velocity.allFinite()) {
      state = before_step;
      a = a_before_step;
      algorithmic = algorithmic_before_step;
      return false;
    }
  }
  previous.h = settings.scheme == Scheme::generalised_alpha ? h : 0;
  previous.algorithmic = algorithmic_before_step;
  previous.tension = before_step.tension;
  unbooked = h;
  return true;
}

/// (D140)
double Stepper::Work::next_sub_step(double taken, double error) const {
  constexpr double safety = 0.9, shortest = 0.2, longest = 3, where_there_is_none = 0.25;
  if (!std::isfinite(error)) return where_there_is_none * taken;
  const double share = safety * std::pow(settings.local_error / error, 0.25);
  return taken * std::clamp(share, shortest, longest);
}

/// The work of the parabola through the powers at this sub-step's end, at its beginning and at that of the one before.
void Stepper::Work::note_powers_since_sub_step(const Powers& after, double tau) {
  if (earlier.h == 0) {
    note_powers(before, tau / 2);
    note_powers(after, tau / 2);
  } else {
    const double r = earlier.h / tau;
    note_powers(earlier.powers, -tau / (6 * r * (r + 1)));
    note_powers(before, tau * (1 / (6 * r) + 0.5));
    note_powers(after, tau * (2 + 3 * r) / (6 * (1 + r)));
  }
  earlier = {before, tau};
  before = after;
}

/// By sub-steps as long as their error allows, all of which end with the step.
void Stepper::Work::advance_by_sub_steps(State& state, double h, StepReport& report) {
  constexpr double shortest = 1e-7;  // of the step
  book(state);
  if (!rosenbrock->is_at(state)) rosenbrock->begin(state, a);
  const double end = state.time + h;
  if (sub_step == 0) sub_step = h;
  for (double left = h; left > 0;) {
    const double count = std::ceil((1 - 1e-9) * left / sub_step), tau = left / count;
    const double error = rosenbrock->try_step(tau);
    ++report.newton_iterations;
    sub_step = next_sub_step(tau, error);
    if (error <= settings.local_error) {
      note_powers_since_sub_step(rosenbrock->accept(state, a), tau);
      unbooked = h;
      left = count > 1 ? left - tau : 0;
      continue;
    }
    ++report.halvings;
    if (sub_step >= shortest * h) continue;
    book(state);
    throw hydro::NumericsError(
        fmt::format("the line cannot go on from t = {:.6g} s, even with a step of {:.3g} s: {}", state.time, tau,
                    std::isfinite(error) ? "its error stays too large" : "its equations are singular or not finite"));
  }
  state.time = end;
}

void Stepper::Work::advance(State& state, double h, int depth, StepReport& report) {
  if (rosenbrock) return advance_by_sub_steps(state, h, report);
  if (try_step(state, h, report)) return;
  if (depth == settings.deepest_halving) {
    book(state);
    throw hydro::NumericsError(fmt::format("the line cannot go on from t = {:.6g} s, even with a step of {:.3g} s: {}",
                                           state.time, h, failure));
  }
  ++report.halvings;
  advance(state, h / 2, depth + 1, report);
  advance(state, h / 2, depth + 1, report);
}

void Stepper::Work::stay_in_piece_of(double t) {
  equations.stay_in_piece_of(t);
  if (rosenbrock) rosenbrock->stay_in_piece_of(t);
}

bool Stepper::Work::changes_piece(double t, double then) const {
  if (std::isnan(t)) return true;
  for (int i = 0; i < line.nodes(); ++i)
    for (const TimedForce& load : line.node(i).loads)
      if (load.history.piece(t) != load.history.piece(then)) return true;
  return false;
}

/// The motion goes on from the accelerations that the loads of another piece give it: of a jump those behind it. (D150)
void Stepper::Work::enter_piece(State& state, double within) {
  if (!changes_piece(equations.within(), within)) return;
  book(state);
  stay_in_piece_of(within);
  previous.h = earlier.h = 0;
  settle(state);
  algorithmic = a;
  before = powers_now(state);
  if (rosenbrock) rosenbrock->begin(state, a);
}

/// A step, cut where a load over time has a corner. (D150)
void Stepper::Work::advance_between_corners(State& state, double h, StepReport& report) {
  if (!line.has_timed_loads()) return advance(state, h, 0, report);
  constexpr double rounding = 1e-9;  // of the step: times are sums of steps
  for (double left = h; left > 0;) {
    const double way = line.next_corner(state.time + rounding * h) - state.time;
    const double part = way < left - rounding * h ? way : left;
    enter_piece(state, state.time + part / 2);
    advance(state, part, 0, report);
    left = part < left ? left - part : 0;
  }
}

StepReport Stepper::step(State& state, double h) {
  StepReport report;
  work_->advance_between_corners(state, h, report);
  work_->book(state);
  return report;
}

}  // namespace dynamics::line
