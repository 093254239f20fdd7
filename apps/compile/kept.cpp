#include "compile/kept.hpp"

#include <algorithm>
#include <tuple>

#include "compile/fit_folder.hpp"
#include "hydro/base/dense.hpp"

namespace froude::compile {

SymmetricData::SymmetricData(const hydro::potential::Coefficients& c, const std::vector<int>& modes)
    : damping{c.omega, {}} {
  for (const auto& m : c.B) damping.B.push_back(of(m, modes));
  for (const auto& m : c.A) A.push_back(of(m, modes));
  if (c.A_inf) A_inf = of(*c.A_inf, modes);
}

bool SymmetricData::operator==(const SymmetricData& other) const {
  const bool as_large = damping.B.front().rows() == other.damping.B.front().rows();
  return as_large && damping.omega == other.damping.omega && damping.B == other.damping.B && A == other.A &&
         A_inf == other.A_inf;
}

Eigen::MatrixXd SymmetricData::of(const Eigen::MatrixXd& whole, const std::vector<int>& modes) {
  const Eigen::MatrixXd m = whole(modes, modes);
  const double largest = m.cwiseAbs().maxCoeff();
  if (largest > 0) asymmetry = std::max(asymmetry, (m - m.transpose()).cwiseAbs().maxCoeff() / largest);
  return hydro::dense::symmetric_part(m);
}

const RadiationFits::Known& RadiationFits::of(const SymmetricData& data, double tolerance) {
  const std::scoped_lock one_at_a_time(mutex_);
  for (const auto& known : known_)
    if (known->tolerance == tolerance && known->data == data) return *known;
  const auto folder = fit_folder();
  auto kept = folder ? folder->find(data, tolerance) : std::nullopt;
  if (kept)
    known_.push_back(std::make_unique<const Known>(Known{data, tolerance, std::move(*kept), folder->path()}));
  else
    known_.push_back(std::make_unique<const Known>(
        Known{data, tolerance, hydro::radiation::fit(data.damping, data.A, data.A_inf, {.tolerance = tolerance}), {}}));
  made_ = known_.size();
  if (folder && !kept) folder->keep(data, tolerance, known_.back()->fit);
  return *known_.back();
}

bool WeighedMemory::serves(const scene::Memory& other, double other_step, const SymmetricData& others) const {
  return asked.method == other.method && asked.tolerance == other.tolerance && asked.length == other.length &&
         asked.accepted_error == other.accepted_error && step == other_step && *data == others;
}

WeighedMemories::Weighed WeighedMemories::find(const scene::Memory& asked, double step,
                                               const SymmetricData& data) const {
  const std::scoped_lock one_at_a_time(mutex_);
  const auto known = std::ranges::find_if(last_, [&](const Weighed& one) { return one->serves(asked, step, data); });
  return known == last_.end() ? nullptr : *known;
}

void WeighedMemories::keep(Weighed one) {
  constexpr std::size_t most = 4;  // a run, those of twice and four times its step, and what held its method
  const std::scoped_lock one_at_a_time(mutex_);
  last_.push_front(std::move(one));
  if (last_.size() > most) last_.pop_back();
  ++made_;
}

namespace {

using hydro::waves::FieldBox;
using hydro::waves::FieldUse;
using hydro::waves::HarmonicField;

bool same(const HarmonicField& a, const HarmonicField& b) {
  const auto numbers = [](const hydro::waves::Harmonic& w) {
    return std::tie(w.omega, w.kx, w.ky, w.elevation, w.potential);
  };
  const hydro::Water &x = a.water(), &y = b.water();
  return a.current() == b.current() && a.options().stretching == b.options().stretching &&
         a.options().hs_m == b.options().hs_m && x.density == y.density && x.gravity == y.gravity &&
         x.depth.metres() == y.depth.metres() &&
         std::ranges::equal(a.harmonics(), b.harmonics(),
                            [&](const auto& one, const auto& other) { return numbers(one) == numbers(other); });
}

/// The end of a run of longer steps is that of the run but for rounding.
bool holds(const FieldBox& large, const FieldBox& small) {
  constexpr double rounding = 1e-9;
  return large.start_s <= small.start_s && small.end_s <= large.end_s * (1 + rounding) &&
         (large.low.array() <= small.low.array()).all() && (small.high.array() <= large.high.array()).all();
}

/// With room around the box, so that one a little beside it is held too: that of lines cut into more segments.
FieldUse with_room(FieldUse use, const HarmonicField& waves) {
  constexpr double room = 0.5;  // m
  use.box.low.array() -= room;
  use.box.high.head<2>().array() += room;
  use.box.low.z() = std::max(use.box.low.z(), -waves.water().depth.metres());
  return use;
}

double questions(const FieldUse& use) { return use.instants * use.points; }

}  // namespace

std::shared_ptr<const KeptWater::Made> KeptWater::found(const HarmonicField& waves, const FieldUse& use,
                                                        const Serves& serves) {
  const std::scoped_lock one_at_a_time(mutex_);
  if (last_ && serves(*last_)) return last_;
  const FieldUse wide = with_room(use, waves);
  const auto make = [waves, wide] { return std::make_shared<const hydro::waves::BoxedField>(waves, wide); };
  last_ = std::make_shared<const Made>(Made{waves, wide, std::async(std::launch::deferred, make).share()});
  ++made_;
  return last_;
}

// Where waves are summed since few points asked for them, a run that asks for more may do better with a table.
KeptWater::Field KeptWater::of(const HarmonicField& waves, const FieldUse& use) {
  const Serves serves = [&](const Made& made) {
    return made.use.tolerance == use.tolerance && holds(made.use.box, use.box) && same(made.waves, waves);
  };
  const auto known = found(waves, use, serves);
  Field field = known->field.get();
  if (field->tables() > 0 || questions(use) <= questions(known->use)) return field;
  return found(waves, use, [&](const Made& made) { return serves(made) && questions(use) <= questions(made.use); })
      ->field.get();
}

template <class Value>
const Value& Kept::known(std::map<std::string, Value>& all, const std::string& name,
                         const std::function<Value()>& make) {
  const std::scoped_lock one_at_a_time(mutex_);
  const auto known = all.find(name);
  if (known != all.end()) return known->second;
  const Value& out = all.emplace(name, make()).first->second;
  ++made_;
  return out;
}

const hydro::potential::Coefficients& Kept::coefficients(const std::string& name,
                                                         const std::function<hydro::potential::Coefficients()>& make) {
  return known(coefficients_, name, make);
}

const std::vector<hydro::potential::Finding>& Kept::findings(
    const std::string& name, const std::function<std::vector<hydro::potential::Finding>()>& make) {
  return known(findings_, name, make);
}

}  // namespace froude::compile
