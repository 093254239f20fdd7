// A hemisphere of our own panels, extrapolated in the size of panels and of faces, at the very frequencies of Hulme.
#include <set>

#include "harness/hulme.hpp"
#include "hydro/hydrostatics/shape_meshes.hpp"
#include "hydro/panels/solve.hpp"

namespace froude::validation::hull_hulme {
namespace {

using hydro::potential::Coefficients;

constexpr double highest_Ka = 3;  // waves of two radii

std::vector<double> frequencies(const hulme::Tables& table, const hydro::Water& water) {
  std::set<double> omega;
  for (const auto* one : {&table.heave, &table.surge})
    for (const double Ka : one->column("Ka"))
      if (Ka <= highest_Ka) omega.insert(std::sqrt(Ka * water.gravity / hulme::radius));
  return {omega.begin(), omega.end()};
}

hydro::panels::Solution hemisphere(int rows, const hydro::Water& water, const std::vector<double>& omega) {
  const hydro::panels::HullBody body{
      "hemisphere",
      {0, 0, 0},
      {},
      hydro::hydrostatics::Hull(hydro::hydrostatics::hemisphere_mesh(hulme::radius, rows, 4 * rows))};
  return hydro::panels::solve({body}, water, omega, {}, {.tolerance = 0.02, .threads = 1});
}

/// The round hemisphere from one of so many faces and one of four times as many: what they differ by is of second order
/// in the size of faces.
Coefficients round(const Coefficients& coarse, const Coefficients& fine) {
  const auto to_limit = [](const Eigen::MatrixXd& a, Eigen::MatrixXd& b) { b += (b - a) / 3; };
  Coefficients out = fine;
  for (std::size_t w = 0; w < out.omega.size(); ++w) {
    to_limit(coarse.A[w], out.A[w]);
    to_limit(coarse.B[w], out.B[w]);
  }
  to_limit(*coarse.A_inf, *out.A_inf);
  to_limit(*coarse.A_zero, *out.A_zero);
  return out;
}

}  // namespace

Outcome outcome(const Folders& folders) {
  const auto heave = folders.shared("hulme_hemisphere/heave.csv"), surge = folders.shared("hulme_hemisphere/surge.csv");
  const hulme::Tables table = hulme::tables(heave, surge);
  const hydro::Water water{.density = 1000, .gravity = 9.81};
  const std::vector<double> omega = frequencies(table, water);
  const auto coarse = hemisphere(6, water, omega), fine = hemisphere(12, water, omega);
  const Coefficients ours = round(coarse.coefficients, fine.coefficients);
  Outcome out = hulme::against(table, hydro::potential::FrequencyTable(ours, {Eigen::Vector3d::Zero()}));
  out.numbers.push_back({"error by the size of panels, estimated", fine.check.estimate, ""});
  out.numbers.push_back({"error by 576 flat faces, that are then extrapolated",
                         hydro::panels::difference(fine.coefficients, ours, fine.check.length), ""});
  return out;
}

}  // namespace froude::validation::hull_hulme
