#include "compile/radiation.hpp"

#include <algorithm>
#include <cmath>

#include "hydro/base/dense.hpp"
#include "hydro/radiation/choice.hpp"
#include "hydro/radiation/constant_memory.hpp"

namespace froude::compile {
namespace {

using hydro::InputError;
using hydro::radiation::ChosenMemory;

/// The free modes of a group: their numbers in the model, and in the group's matrices.
struct FreeModes {
  std::vector<int> in_model, in_group;
};

FreeModes free_modes(const Prepared& p, const std::vector<int>& bodies) {
  FreeModes out;
  for (std::size_t b = 0; b < bodies.size(); ++b)
    for (int mode = 0; mode < 6; ++mode)
      if (p.bodies[static_cast<std::size_t>(bodies[b])].is_free(mode)) {
        out.in_model.push_back(6 * bodies[b] + mode);
        out.in_group.push_back(6 * static_cast<int>(b) + mode);
      }
  return out;
}

const hydro::radiation::Alternative& taken_of(const ChosenMemory& chosen) {
  return *std::find_if(chosen.alternatives.begin(), chosen.alternatives.end(),
                       [&](const auto& a) { return a.method == chosen.method; });
}

/// The number, rounded up to two digits: what a scene may write to let it pass.
double rounded_up(double x) {
  const double unit = std::pow(10, std::floor(std::log10(x)) - 1);
  return std::ceil(x / unit * (1 - 1e-12)) * unit;
}

/// \throws InputError if the memory misses its tolerance and the scene does not accept by how much
void require_within(const hydro::potential::Coefficients& c, const ChosenMemory& chosen, const scene::Memory& asked) {
  const auto& taken = taken_of(chosen);
  if (taken.within || taken.error <= asked.accepted_error) return;
  std::string others;
  for (const auto& a : chosen.alternatives)
    if (a.method != chosen.method) others += fmt::format(", {} by {:.2g}", name_of(a.method), a.error);
  throw InputError(
      fmt::format(
          "{}: no memory of the radiated waves is within {:.2g} of these coefficients: {} misses them by {:.2g} of "
          "the largest damping, at {:.3g} rad/s{}",
          c.source, asked.tolerance, name_of(chosen.method), taken.error, taken.at_omega, others),
      asked.place,
      fmt::format(
          "compute them at more and higher frequencies, or take the error by name: radiation = {{ accept_error = "
          "{:.2g} }}",
          rounded_up(taken.error)));
}

void note_what_was_done(const hydro::potential::Coefficients& c, const ChosenMemory& chosen, double asymmetry,
                        const scene::Memory& asked, std::vector<std::string>& notes) {
  if (const auto& taken = taken_of(chosen); !taken.within)
    notes.push_back(fmt::format(
        "{}: the memory ({}) differs from the data by up to {:.2g} of the largest damping, at {:.3g} rad/s (tolerance "
        "{:.2g}; accept_error = {:.2g})",
        c.source, name_of(chosen.method), taken.error, taken.at_omega, asked.tolerance, asked.accepted_error));
  if (chosen.method == hydro::radiation::Method::poles) {
    const auto& fit = *chosen.fit;
    notes.push_back(fmt::format(
        "{}: added mass and damping fitted with poles: {}; {}; A(inf) moved by {:.2g}{}", c.source, fit.why,
        fit.passive
            ? fmt::format("passive, which cost an error of {:.2g} in place of {:.2g}", fit.error, fit.error_before)
            : std::string("not certified passive: the memory may give energy"),
        fit.shift, c.A_inf ? "" : "; the data lack A(inf), which was found with it"));
  } else {
    notes.push_back(fmt::format(
        "{}: damping extrapolated beyond {:.4g} rad/s so that it belongs to the added mass, which is left off by "
        "{:.2g} "
        "(rms, worst pair); A(inf) moved by {:.2g}{}; the memory leaves out up to {:.2g} of the radiation damping",
        c.source, c.omega.back(), chosen.misfit, chosen.shift,
        c.A_inf ? "" : "; added mass at infinite frequency, which the data lack, found with it", chosen.truncation));
  }
  if (asymmetry > 1e-9)
    notes.push_back(fmt::format(
        "{}: added mass and damping made symmetric for the run; they were off by up to {:.2g} of the largest entry",
        c.source, asymmetry));
  if (chosen.negative_share > 1e-3)
    notes.push_back(fmt::format("{}: radiation damping is negative somewhere, by up to {:.2g} of its mode's largest{}",
                                c.source, chosen.negative_share,
                                chosen.method == hydro::radiation::Method::poles ? "" : "; taken as it is"));
}

std::vector<PlanLine> lines(const ChosenMemory& chosen) {
  std::vector<PlanLine> out;
  for (const auto& a : chosen.alternatives) {
    const bool runs = a.method == chosen.method;
    PlanLine line{"radiation", runs ? chosen.memory->describe() + " (" + chosen.why + ")" : name_of(a.method),
                  fmt::format("{} modes, off the data by up to {:.2g}, about {:.2g} us a step", chosen.memory->modes(),
                              a.error, a.microseconds),
                  runs};
    if (runs)
      out.insert(out.begin(), std::move(line));
    else
      out.push_back(std::move(line));
  }
  return out;
}

/// Damping below zero serves for responses, where `accept` lets it pass; as a memory it would feed a motion.
/// \throws InputError where the scene asks for the memory
void require_no_source(const hydro::radiation::DampingTable& damping, const hydro::potential::Coefficients& c,
                       const hydro::Place& place) {
  try {
    hydro::radiation::negative_share(damping);
  } catch (const InputError& error) {
    throw InputError(
        fmt::format("{}: {}; a run cannot take that, even where the finding is accepted", c.source, error.rule()),
        place, "heal the data and name the new file: froude bem heal FILE --passivity -o healed.h5");
  }
}

/// A and B at the frequency of the one wave there is.
RadiationParts at_one_frequency(const dynamics::frequency::PotentialGroup& g, const FreeModes& modes,
                                const scene::Memory& asked, double step, const hydro::waves::Sea* sea) {
  if (!sea || sea->components().size() != 1)
    throw InputError("constant radiation coefficients hold in one regular wave only", asked.place,
                     "leave out `method`, or make [waves] regular");
  const double omega = sea->components().front().omega;
  const auto symmetric = [&](const Eigen::MatrixXd& whole) {
    return hydro::dense::symmetric_part(whole(modes.in_group, modes.in_group));
  };
  const Eigen::Index n = g.table.coefficients().modes();
  RadiationParts out;
  out.added_mass = {g.bodies, Eigen::MatrixXd::Zero(n, n)};
  out.added_mass.value(modes.in_group, modes.in_group) = symmetric(g.table.added_mass(omega));
  const auto memory =
      std::make_shared<hydro::radiation::ConstantMemory>(symmetric(g.table.damping(omega)), omega, step);
  out.memory = {modes.in_model, memory};
  const Eigen::MatrixXcd B = memory->instantaneous(1).cast<std::complex<double>>();
  out.in_run = {modes.in_model, std::make_shared<const SymmetricData>(g.table.coefficients(), modes.in_group),
                out.added_mass.value(modes.in_group, modes.in_group), [B](double) { return B; }, nullptr};
  out.lines = {{"radiation", memory->describe() + " (asked for)",
                fmt::format("{} modes, true of the steady motion only", memory->modes()), true}};
  return out;
}

}  // namespace

Radiation::Radiation(const Prepared& prepared, double step, const hydro::waves::Sea* sea)
    : prepared_(prepared), step_(step), sea_(sea) {}

WeighedMemories::Weighed Radiation::weighed_for(std::size_t group, const std::vector<int>& modes) const {
  using enum scene::Memory::Method;
  const scene::Memory& asked = prepared_.memory[group];
  const auto& c = prepared_.groups[group].table.coefficients();
  const auto data = std::make_shared<const SymmetricData>(c, modes);
  for (const auto& known : told_)
    if (known->serves(asked, step_, *data)) return known;
  Kept& kept = *prepared_.kept;
  if (auto known = kept.memories().find(asked, step_, *data)) return known;
  hydro::radiation::MemoryDemand demand{
      .step = step_, .tolerance = asked.tolerance, .length = asked.length, .method = {}};
  if (asked.method == direct) demand.method = hydro::radiation::Method::direct;
  if (asked.method == partitioned) demand.method = hydro::radiation::Method::partitioned;
  if (asked.method == poles) demand.method = hydro::radiation::Method::poles;
  require_no_source(data->damping, c, asked.place);
  std::optional<std::filesystem::path> kept_in;
  ChosenMemory memory = choose(data->damping, data->A, data->A_inf, demand, [&] {
    const auto& known = kept.fits().of(*data, asked.tolerance);
    kept_in = known.kept_in;
    return known.fit;
  });
  require_within(c, memory, asked);
  std::vector<std::string> notes;
  note_what_was_done(c, memory, data->asymmetry, asked, notes);
  if (kept_in)
    notes.push_back(fmt::format("{}: poles were fitted to these data before and kept in {}; FROUDE_CACHE=off fits anew",
                                c.source, kept_in->string()));
  auto out =
      std::make_shared<const WeighedMemory>(WeighedMemory{asked, step_, data, std::move(memory), std::move(notes)});
  kept.memories().keep(out);
  return out;
}

RadiationParts Radiation::of(std::size_t group, std::vector<std::string>& notes) {
  const auto& g = prepared_.groups[group];
  const FreeModes modes = free_modes(prepared_, g.bodies);
  if (prepared_.memory[group].method == scene::Memory::Method::constant)
    return at_one_frequency(g, modes, prepared_.memory[group], step_, sea_);
  const auto weighed = weighed_for(group, modes.in_group);
  const ChosenMemory& chosen = weighed->memory;
  const Eigen::Index n = g.table.coefficients().modes();
  RadiationParts out{{g.bodies, Eigen::MatrixXd::Zero(n, n)}, {modes.in_model, chosen.memory}, {}, {}};
  out.in_run = {modes.in_model, weighed->data, chosen.A_inf, chosen.transform,
                std::dynamic_pointer_cast<const hydro::radiation::PoleMemory>(chosen.memory)};
  if (std::ranges::find(told_, weighed) == told_.end()) {
    told_.push_back(weighed);
    out.lines = lines(chosen);
    notes.insert(notes.end(), weighed->notes.begin(), weighed->notes.end());
  }
  out.added_mass.value(modes.in_group, modes.in_group) = chosen.A_inf;
  return out;
}

void hold_memories(Prepared& prepared, double step) {
  using enum scene::Memory::Method;
  Radiation radiation(prepared, step, nullptr);
  std::vector<std::string> told_with_the_runs;
  for (std::size_t i = 0; i < prepared.groups.size(); ++i)
    if (auto& method = prepared.memory[i].method; prepared.groups[i].radiation && method == automatic)
      method = radiation.of(i, told_with_the_runs).in_run.poles ? poles : partitioned;
}

}  // namespace froude::compile
