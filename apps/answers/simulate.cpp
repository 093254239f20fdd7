#include "answers/simulate.hpp"

#include <chrono>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "answers/controlled_run.hpp"
#include "answers/estimate.hpp"
#include "answers/far_from_place.hpp"
#include "answers/linear_response.hpp"
#include "answers/provenance.hpp"
#include "compile/integrator.hpp"
#include "compile/joint_control.hpp"
#include "compile/sections.hpp"
#include "compile/signal_list.hpp"
#include "dynamics/force/fastened_line.hpp"
#include "dynamics/integrate/start_with_lines.hpp"
#include "hydro/base/error.hpp"
#include "hydro/base/look_up.hpp"

namespace froude {
namespace {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

/// What rounding leaves of the energies of bodies: that of lifting them by a nanometre, J.
double rounding_of(const dynamics::Model& model) {
  constexpr double gravity = 9.81, lift = 1e-9;
  double mass = 0;
  for (const auto& body : model.bodies()) mass += body.mass();
  return mass * gravity * lift;
}

/// What sets numbers of a run between its steps.
struct Rulers {
  compile::Controllers connectors;
  compile::JointControllers joints;
};

/// One run on its way: stepping, book-keeping of energy, samples.
class March {
 public:
  March(const compile::TimeModel& m, const std::vector<compile::Signal>& signals, Rulers rulers,
        const scene::Scene& scene, const KeptRun& kept, Run& record)
      : m_(m),
        scene_(scene),
        kept_(kept),
        signals_(signals),
        rulers_(std::move(rulers)),
        record_(record),
        workspace_(std::in_place, m.model, m.start),
        integrator_(compile::make_integrator(scene, m.model)),
        rounding_(rounding_of(m.model)),
        places_(scene, m.water.sea) {
    if (const auto& every = scene.run->checkpoint) {
      require_kept();
      checkpoint_steps_ = static_cast<std::size_t>(std::max(1LL, std::llround(every->value / m.step)));
    }
    for (const auto& s : signals) record_.signals.push_back({s.name, s.unit, s.meaning});
    const std::size_t samples = m.steps / m.steps_per_sample + 1;
    record_.time.reserve(samples);
    for (auto& s : record_.signals) s.values.reserve(samples);
  }

  /// The velocities at each step are kept from the start on.
  void keep_motion(compile::VelocityRecord& motion) {
    motion_ = &motion;
    motion = {m_.step, Eigen::MatrixXd::Zero(m_.model.modes(), static_cast<Eigen::Index>(m_.steps) + 1)};
  }

  void run(const std::function<void(double)>& done) {
    if (const auto state = kept_.in ? kept_.in->find(kept_.name) : std::nullopt)
      go_on_from(*state, done);
    else
      begin(done);
  }

  compile::MovingState end() const {
    compile::MovingState out{workspace_->state, {}, {}};
    for (const auto& line : lines_) {
      out.lines.push_back(line->state());
      out.angles.emplace_back(line->angles().begin(), line->angles().end());
    }
    return out;
  }

 private:
  void begin(const std::function<void(double)>& done) {
    if (bodies()) dynamics::start_with_lines(*integrator_, *workspace_);
    begin_lines();
    dynamics::EnergyLedger ledger(m_.model, *workspace_);
    const bool ruled = rule_first(ledger);
    sample(ledger);
    if (motion_) motion_->of_modes.col(0) = workspace_->state.velocity;
    if (ruled)
      march(1, ledger, done);
    else
      close(ledger);
  }
  /// Forces of joints are set where the run begins. False where their controller ends it there.
  bool rule_first(dynamics::EnergyLedger& ledger) {
    try {
      follow(rulers_.joints.decide({m_.model, *workspace_, ledger, lines_}), ledger);
      return true;
    } catch (const hydro::NumericsError& e) {
      record_.stopped = e.what();
      return false;
    }
  }
  void follow(bool loads_jumped, dynamics::EnergyLedger& ledger) {
    if (!loads_jumped) return;
    integrator_->loads_jumped(*workspace_);
    ledger.note(*workspace_);
  }
  void march(std::size_t first, dynamics::EnergyLedger& ledger, const std::function<void(double)>& done) {
    try {
      for (std::size_t n = first; n <= m_.steps; ++n) {
        hydro::look_up();
        advance(n, ledger);
        if (motion_) motion_->of_modes.col(static_cast<Eigen::Index>(n)) = workspace_->state.velocity;
        if (n % m_.steps_per_sample == 0) {
          sample(ledger);
          if (done) done(static_cast<double>(n) / static_cast<double>(m_.steps));
        }
        if (checkpoint_steps_ > 0 && (n % checkpoint_steps_ == 0 || n == m_.steps)) checkpoint(n, ledger);
        if (n < m_.steps && asks_to_end(kept_.interruption)) {
          record_.stopped = fmt::format("{} at t = {:.6g} s", sentence(*kept_.interruption), workspace_->state.time);
          break;
        }
      }
    } catch (const hydro::NumericsError& e) {
      record_.stopped = e.what();
    }
    close(ledger);
  }

  /// \throws hydro::InputError naming what of the run has a state that no checkpoint holds
  void require_kept() const {
    const auto refuse = [&](const std::string& what, const std::string& why) {
      throw hydro::InputError(fmt::format("[ask.run] checkpoint: the state of {} cannot be kept: {}", what, why),
                              scene_.run->checkpoint->place,
                              "leave `checkpoint` out; such a run goes on to its end or begins anew");
    };
    if (!rulers_.connectors.can_be_kept() || !rulers_.joints.empty())
      refuse("controllers", "nobody but the caller's program knows what they have seen");
    if (const char* why = integrator_->cannot_be_kept()) refuse(scene_.solve.integrator, why);
    for (std::size_t k = 0; k < workspace_->memory.size(); ++k)
      if (workspace_->needs_memory(k) && !workspace_->memory[k]->can_be_kept())
        refuse(m_.model.forces()[k]->effect(), "it has a memory of its own kind");
  }
  /// All of the run after step n, into bytes or out of them.
  void keep_state(std::size_t& n, dynamics::EnergyLedger& ledger, hydro::StateBytes& bytes) {
    for (std::size_t k = 0; k < workspace_->memory.size(); ++k)
      if (workspace_->needs_memory(k)) workspace_->memory[k]->keep_state(bytes);
    integrator_->keep_state(*workspace_, bytes);
    for (auto& line : lines_) line->keep_state(bytes);
    rulers_.connectors.keep_state(bytes);
    bytes.pass(n, workspace_->evaluations, ledger, record_.time);
    for (Signal& s : record_.signals) bytes.pass(s.values);
    bytes.pass(record_.steps, record_.parts, record_.newton_iterations, record_.halvings, record_.events, record_.leaps,
               record_.worst_residual.energy, record_.worst_residual.time);
    places_.keep_state(bytes);
    bool has_motion = motion_ != nullptr;
    bytes.pass(has_motion);
    if (has_motion && motion_) bytes.pass(motion_->of_modes);
  }
  /// The run goes on from what is kept of it, also where nobody has stopped it: what is not kept is lost either way,
  /// so that both have the same bits. Writing takes a twentieth of the time at most.
  void checkpoint(std::size_t n, dynamics::EnergyLedger& ledger) {
    constexpr double share = 0.05;
    hydro::StateBytes taken;
    keep_state(n, ledger, taken);
    lines_.clear();
    workspace_.emplace(m_.model, m_.start);
    integrator_ = compile::make_integrator(scene_, m_.model);
    begin_lines();
    hydro::StateBytes given(taken.bytes());
    keep_state(n, ledger, given);
    if (!kept_.in || (n < m_.steps && share * seconds_since(written_) < writing_s_)) return;
    const auto begin = Clock::now();
    kept_.in->keep(kept_.name, taken.bytes());
    writing_s_ = seconds_since(begin);
    written_ = Clock::now();
  }
  void go_on_from(const std::string& state, const std::function<void(double)>& done) {
    begin_lines();
    dynamics::EnergyLedger ledger(m_.model, *workspace_);
    hydro::StateBytes bytes(state);
    std::size_t n = 0;
    try {
      keep_state(n, ledger, bytes);
    } catch (const std::length_error&) {
      kept_.in->refuse(kept_.name);
    }
    if (!bytes.at_end() || n > m_.steps) kept_.in->refuse(kept_.name);
    kept_.in->went_on(kept_.name, workspace_->state.time);
    march(n + 1, ledger, done);
  }
  bool bodies() const { return !m_.model.bodies().empty(); }
  void begin_lines() {
    auto* memory = workspace_->find_memory<dynamics::FastenedLineMemory>();
    for (const auto& line : m_.lines)
      lines_.push_back(line.fastened ? std::make_unique<compile::LineRun>(line, memory->line(*line.fastened))
                                     : std::make_unique<compile::LineRun>(line));
  }
  void advance(std::size_t n, dynamics::EnergyLedger& ledger) {
    for (auto& line : lines_) {
      const auto report = line->step(m_.step);
      record_.newton_iterations += report.newton_iterations;
      record_.halvings += report.halvings;
    }
    const auto report = bodies() ? integrator_->step(*workspace_, m_.step) : dynamics::StepReport{};
    // Sums of steps drift, products do not.
    workspace_->state.time = m_.start.time + static_cast<double>(n) * m_.step;
    record_.newton_iterations += report.newton_iterations;
    record_.halvings += report.halvings;
    record_.parts += static_cast<std::size_t>(report.parts);
    record_.events += static_cast<int>(report.events.size());
    record_.leaps += report.leaps;
    record_.steps = n;
    ledger.note(*workspace_);
    for (auto& line : lines_) line->note(m_.step);
    const compile::Moment now{m_.model, *workspace_, ledger, lines_};
    const bool joints_jumped = rulers_.joints.decide(now);
    follow(rulers_.connectors.decide(now) || joints_jumped, ledger);
    places_.look(workspace_->state);
    watch(n, balance(ledger));
    watch_losses(n, ledger);
  }
  struct Balance {
    double residual, turnover, rounding;  // J, of bodies and lines together
  };
  Balance balance(const dynamics::EnergyLedger& ledger) const {
    Balance out{ledger.residual(), ledger.turnover(), rounding_};
    for (std::size_t k = 0; k < lines_.size(); ++k) {
      if (m_.lines[k].fastened) continue;  // in the ledger of the bodies already
      const auto& e = lines_[k]->energies();
      out.residual += e.residual();
      out.turnover += lines_[k]->turnover();
      out.rounding += 1e-9 * (e.kinetic + std::abs(e.stored()));
    }
    return out;
  }
  /// Energy that comes from nowhere is a motion that has gone wrong; how much of it there was at most is told.
  void watch(std::size_t n, const Balance& now) {
    constexpr std::size_t first = 20;  // steps: in the first few little has been turned over
    constexpr double most = 0.25;      // of what was turned over; sound runs stay below a fiftieth
    if (std::abs(now.residual) <= now.rounding) return;
    if (std::abs(now.residual) > std::abs(record_.worst_residual.energy))
      record_.worst_residual = {now.residual, workspace_->state.time};
    if (n < first || now.residual <= most * now.turnover) return;
    throw hydro::NumericsError(fmt::format(
        "energy comes from nowhere: by t = {:.6g} s {:.3g} J that nothing has supplied, of {:.3g} J turned over; "
        "the step of {:.4g} s is too long for this motion: give a shorter one, [solve] step = \"{:.6g} s\"",
        workspace_->state.time, now.residual, now.turnover, m_.step, m_.step / 4));
  }
  /// An effect that takes energy has none to give: impacts that a step delivers after the body has turned round do.
  void watch_losses(std::size_t n, const dynamics::EnergyLedger& ledger) const {
    constexpr std::size_t first = 20;  // steps, as for the residual
    constexpr double most = 0.25;      // of what was turned over
    if (n < first) return;
    for (const auto& e : ledger.entries())
      if (-e.dissipated > rounding_ + most * ledger.turnover())
        throw hydro::NumericsError(
            fmt::format("energy comes from nowhere: by t = {:.6g} s {} has given {:.3g} J, of {:.3g} J turned over, "
                        "and should have "
                        "taken some; the step of {:.4g} s is too long for this motion: give a shorter one, [solve] "
                        "step = \"{:.6g} s\"",
                        workspace_->state.time, e.effect, -e.dissipated, ledger.turnover(), m_.step, m_.step / 4));
  }
  void sample(const dynamics::EnergyLedger& ledger) {
    record_.time.push_back(workspace_->state.time);
    for (auto& line : lines_) line->look();
    const compile::Moment now{m_.model, *workspace_, ledger, lines_};
    for (std::size_t i = 0; i < signals_.size(); ++i) record_.signals[i].values.push_back(signals_[i].value(now));
  }
  void close(const dynamics::EnergyLedger& ledger) {
    for (std::size_t k = 0; k < workspace_->evaluations.size(); ++k)
      record_.evaluations.emplace_back(m_.model.forces()[k]->effect(), workspace_->evaluations[k]);
    record_.energy.emplace_back("kinetic", ledger.kinetic());
    for (const auto& e : ledger.entries()) {
      record_.energy.emplace_back(e.effect + ".stored", e.stored);
      record_.energy.emplace_back(e.effect + ".supplied", e.supplied);
      record_.energy.emplace_back(e.effect + ".dissipated", e.dissipated);
    }
    for (std::size_t k = 0; k < lines_.size(); ++k)
      for (std::size_t part = 0; part < m_.lines[k].parts.size(); ++part)
        if (const auto* s = lines_[k]->snaps(part))
          record_.snaps.push_back({m_.lines[k].parts[part].name, s->slack_share(), s->snaps(), s->largest().tension,
                                   s->largest().time, s->largest().segment + 1});
    for (std::size_t k = 0; k < lines_.size(); ++k)
      if (const auto exponent = lines_[k]->exponent()) record_.exponents.push_back({m_.lines[k].name, *exponent});
    for (std::size_t k = 0; k < lines_.size(); ++k) {
      const auto& e = lines_[k]->energies();
      const std::string& name = m_.lines[k].name;
      if (m_.lines[k].fastened) continue;  // in the ledger of the bodies already
      record_.energy.emplace_back(name + ".kinetic", e.kinetic);
      record_.energy.emplace_back(name + ".stored", e.stored());
      record_.energy.emplace_back(name + ".supplied", e.supplied());
      record_.energy.emplace_back(name + ".dissipated", e.dissipated());
    }
    record_.error.unseen = places_.told();
    const Balance whole = balance(ledger);
    record_.energy.emplace_back("residual", whole.residual);
    record_.energy.emplace_back("largest_residual", record_.worst_residual.energy);
    record_.energy.emplace_back("turnover", whole.turnover);
  }

  const compile::TimeModel& m_;
  const scene::Scene& scene_;
  const KeptRun& kept_;
  std::size_t checkpoint_steps_ = 0;  // from one to the next; 0: there are none
  double writing_s_ = 0;              // that the last one took
  Clock::time_point written_ = {};
  const std::vector<compile::Signal>& signals_;
  Rulers rulers_;
  std::vector<std::unique_ptr<compile::LineRun>> lines_;
  Run& record_;
  std::optional<dynamics::Workspace> workspace_;
  std::unique_ptr<dynamics::Integrator> integrator_;
  double rounding_;  // J
  FarFromPlace places_;
  compile::VelocityRecord* motion_ = nullptr;
};

/// What the scene tells, and what it left to be chosen.
Provenance provenance_of_run(const scene::Scene& scene) {
  Provenance out = provenance_of(scene);
  if (scene.solve.integrator == "generalized_alpha") {
    out.settings.emplace_back("chosen.rho_infinity", fmt::format("{}", scene.solve.rho_infinity));
    out.settings.emplace_back("chosen.newton_tolerance", fmt::format("{}", scene::newton_tolerance(scene)));
  }
  if (compile::has_own_tolerance(scene.solve.integrator) && !scene.solve.tolerance)
    out.settings.emplace_back("chosen.tolerance", fmt::format("{}", compile::tolerance_of_pair));
  return out;
}

Run run_ruled(const scene::Scene& scene, const compile::TimeModel& model, std::vector<compile::RuledJoint> joints,
              const std::function<void(double)>& done, compile::MovingState* end, compile::VelocityRecord* motion,
              const KeptRun& kept) {
  Run record;
  const auto all = compile::signal_list(scene, model);
  const auto signals = compile::chosen(all, scene.run->of, scene.run->of_places);
  record.step = model.step;
  record.notes = model.notes;
  record.provenance = provenance_of_run(scene);
  March march(model, signals, {{model.rules, all}, {std::move(joints), all}}, scene, kept, record);
  if (motion) march.keep_motion(*motion);
  const auto stepping = Clock::now();
  march.run(done);
  record.stepping_s = seconds_since(stepping);
  if (end) *end = march.end();
  return record;
}

}  // namespace

Run run_model(const scene::Scene& scene, const compile::TimeModel& model, const std::function<void(double)>& done,
              compile::MovingState* end, compile::VelocityRecord* motion, const KeptRun& kept) {
  return run_ruled(scene, model, {}, done, end, motion, kept);
}

Run simulate_controlled(const scene::Scene& scene, const std::function<void(double)>& done,
                        const std::vector<Control>& controls, const std::vector<JointControl>& of_joints,
                        const std::shared_ptr<compile::Kept>& kept) {
  if (scene.run->steady)
    throw hydro::InputError("[ask.run] start = \"steady\" takes no step at which a controller could decide",
                            scene.run->place, "step the run from \"as placed\"");
  compile::require_no_sections(scene);
  const auto begin = Clock::now();
  compile::Prepared prepared = compile::prepare(scene, kept);
  compile::set_controllers(controls, prepared);
  std::vector<compile::RuledJoint> joints = compile::set_joint_controllers(scene, of_joints, prepared);
  const compile::TimeModel model = compile::time_model(scene, prepared);
  const double preparation = seconds_since(begin);
  Run record = run_ruled(scene, model, std::move(joints), done, nullptr, nullptr, {});
  record.preparation_s = preparation;
  set_error(record, unknown_error(scene, "controllers of the caller decide, which can be asked once only"));
  return record;
}

Run simulate(const scene::Scene& scene, const std::function<void(double)>& done, const std::vector<Control>& controls,
             const std::shared_ptr<compile::Kept>& kept, int threads, Checkpoints* checkpoints,
             const Interruption* interruption) {
  if (!controls.empty()) return simulate_controlled(scene, done, controls, {}, kept);
  if (scene.run->steady) return steady_run(scene, kept, threads);
  compile::require_no_sections(scene);
  const auto begin = Clock::now();
  const compile::Prepared prepared = compile::prepare(scene, kept);
  const double preparation = seconds_since(begin);
  Run record = run_to_accuracy(scene, prepared, done, threads, checkpoints, interruption);
  record.preparation_s += preparation;
  record.estimating_s = seconds_since(begin) - record.preparation_s - record.stepping_s;
  return record;
}

}  // namespace froude
