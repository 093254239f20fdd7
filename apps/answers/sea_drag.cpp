#include "answers/sea_drag.hpp"

#include <cmath>

#include "compile/members.hpp"
#include "hydro/waves/spectra/spectrum.hpp"

namespace froude {

using Eigen::Index;

namespace {

/// Of the trapezium rule.
double weight(const std::vector<double>& omega, std::size_t w) {
  const double below = w == 0 ? omega[w] : omega[w - 1], above = w + 1 == omega.size() ? omega[w] : omega[w + 1];
  return (above - below) / 2;
}

}  // namespace

dynamics::frequency::SeaDrag sea_drag(const scene::Scene& scene, const compile::Prepared& prepared,
                                      const std::vector<System>& systems, const std::vector<double>& omega,
                                      const Eigen::VectorXd& start, const std::vector<Eigen::Matrix3d>& slow) {
  dynamics::frequency::DragSea sea{.water = scene.water,
                                   .heading = scene.rao->headings,
                                   .variance = Eigen::MatrixXd::Zero(static_cast<Index>(scene.rao->headings.size()),
                                                                     static_cast<Index>(omega.size())),
                                   .slow = slow};
  for (const System& system : systems)
    for (std::size_t w = 0; w < omega.size(); ++w)
      for (const Direction& d : system.directions)
        sea.variance(static_cast<Index>(d.heading), static_cast<Index>(w)) +=
            system.waves->spectrum->density(omega[w]) * system.share(d, omega[w]) * weight(omega, w);
  std::vector<std::string> told_by_responses;
  const dynamics::Model model = compile::frequency_model(prepared, scene.rao->about);
  const auto about = compile::small_motions(scene, model, scene.rao->about, told_by_responses);
  return dynamics::frequency::drag_in_sea(about, prepared.groups, omega,
                                          compile::drag_of_responses(scene, prepared.bodies).pieces, sea, start);
}

DragInSea by_member(const scene::Scene& scene, const compile::Prepared& prepared,
                    const dynamics::frequency::SeaDrag& found) {
  const auto member = compile::drag_of_responses(scene, prepared.bodies).member;
  DragInSea out{found.iterations, found.residual, {}};
  for (std::size_t first = 0, end = 0; first < member.size(); first = end) {
    while (end < member.size() && member[end] == member[first]) ++end;
    const auto pieces = static_cast<Index>(end - first);
    const Eigen::MatrixX2d sigma = found.sigma.middleRows(static_cast<Index>(first), pieces);
    out.members.push_back({scene.members[member[first]].name,
                           std::sqrt(sigma.col(0).squaredNorm() / static_cast<double>(pieces)),
                           std::sqrt(sigma.col(1).squaredNorm() / static_cast<double>(pieces)),
                           found.coefficient.segment(static_cast<Index>(first), pieces).sum()});
  }
  return out;
}

}  // namespace froude
