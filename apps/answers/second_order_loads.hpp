#pragma once
/// \file  Private to apps: spectra of the second-order wave loads of a random sea. (D142)
#include <Eigen/Core>

#include <functional>
#include <optional>
#include <vector>

#include "answers/sea_directions.hpp"
#include "compile/quadratic_transfer.hpp"
#include "dynamics/state/body.hpp"
#include "scene/scene.hpp"

namespace froude {

/// A direction of a sea and the energy that goes along it.
struct Ray {
  double heading;                         ///< rad
  std::function<double(double)> density;  ///< by ω in rad/s, m² s/rad, one-sided
};

/// The rays of a sea, spread ones cut into this many sectors of equal energy; the sea must live as long.
std::vector<Ray> rays_of(const scene::RandomSea& sea, int sectors);

/// The loads of all bodies with `[body.second_order]`, each about its centre of gravity, one after another.
class SecondOrderLoads {
 public:
  enum class Pairs { differences, sums };
  /// What a spectrum must be right for: integration is finer until this is within a tolerance, relative.
  using Measure = std::function<Eigen::VectorXd(const Eigen::MatrixXcd& spectrum)>;

  /// `notes` are told what files leave open. \throws hydro::InputError, at its place, as
  /// compile::read_second_order_files(); for headings or energy outside the files, Newman's approximation of several
  /// headings
  SecondOrderLoads(const scene::Scene& scene, const std::vector<dynamics::RigidBody>& bodies, std::vector<Ray> rays,
                   std::vector<std::string>& notes);

  bool has(Pairs pairs) const;
  const std::vector<int>& modes() const { return modes_; }  ///< of the model, in the order of the loads
  /// Between these lie differences or sums of the waves' frequencies, rad/s.
  double lowest(Pairs pairs) const;
  double highest(Pairs pairs) const;

  /// 2 ∫ S(ω) T(ω; ω) dω, N and N m, to a tolerance of the largest force and moment.
  Eigen::VectorXd mean(double tolerance) const;
  /// At a difference or sum ω of two waves' frequencies, one-sided, N² s/rad: the matrix of densities between all
  /// loads. \throws hydro::NumericsError where the tolerance is not met
  Eigen::MatrixXcd spectrum(Pairs pairs, double omega, double tolerance, const Measure& measure) const;
  /// The share of ∫∫ S S dω dω whose differences or sums are above ω.
  double share_above(Pairs pairs, double omega) const;

 private:
  /// Files of one body at the headings of the sea.
  struct OfBody {
    Eigen::Vector3d origin;
    std::vector<double> omega, sum_omega;      // rad/s, of the files
    std::vector<compile::Matrices> equal;      // ray by ray: T(ω; ω) as a column
    std::vector<compile::Matrices> pairs;      // of rays r₁, r₂ at r₁ · rays + r₂; empty: none
    std::vector<compile::Matrices> sum_pairs;  // likewise
    bool newman = false;
  };
  struct Wave {
    std::size_t ray;
    double omega, k;
  };
  using Load = Eigen::VectorXcd;

  void add_body(const scene::Body& body, const Eigen::Vector3d& to_centre, const scene::Scene& scene,
                const compile::SecondOrderFiles& files);
  void set_range(const SeaBand& band);
  void set_intervals();
  void add_pair(const OfBody& body, Pairs kind, const Wave& a, const Wave& b, Eigen::Ref<Load> out) const;
  Load of_equal_waves(std::size_t ray, double omega) const;
  Load of_pair(Pairs kind, const Wave& a, const Wave& b) const;
  Eigen::MatrixXcd density_of(Pairs kind, double first, double second) const;
  double all_rays(double omega) const;

  std::vector<Ray> rays_;
  std::vector<OfBody> bodies_;
  std::vector<int> modes_;
  hydro::Water water_;
  double low_ = 0, high_ = 0;  // rad/s: of all files
  int intervals_ = 32;         // of the band low … high in which the sea's own energy is right to a thousandth
};

}  // namespace froude
