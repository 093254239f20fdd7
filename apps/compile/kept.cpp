#include "compile/kept.hpp"

#include <algorithm>

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
  if (folder && !kept) folder->keep(data, tolerance, known_.back()->fit);
  return *known_.back();
}

const hydro::potential::Coefficients& Kept::coefficients(const std::string& name,
                                                         const std::function<hydro::potential::Coefficients()>& make) {
  const std::scoped_lock one_at_a_time(mutex_);
  const auto known = coefficients_.find(name);
  return known != coefficients_.end() ? known->second : coefficients_.emplace(name, make()).first->second;
}

}  // namespace froude::compile
