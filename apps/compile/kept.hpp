#pragma once
/// \file  Private to apps: what is dear to make and serves every model of a scene, also after its numbers have changed.
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "hydro/potential/coefficients.hpp"
#include "hydro/radiation/rational.hpp"

namespace froude::compile {

/// A and B of some modes, made symmetric.
///
/// A and B of linear theory are symmetric. Panel codes miss that by their discretisation error, which in a run would be
/// energy from nowhere; the frequency domain, which has no ledger to close, takes the data as they are.
struct SymmetricData {
  hydro::radiation::DampingTable damping;
  std::vector<Eigen::MatrixXd> A;
  std::optional<Eigen::MatrixXd> A_inf;
  double asymmetry = 0;  ///< of the largest entry

  SymmetricData(const hydro::potential::Coefficients& c, const std::vector<int>& modes);
  bool operator==(const SymmetricData& other) const;

 private:
  Eigen::MatrixXd of(const Eigen::MatrixXd& whole, const std::vector<int>& modes);
};

/// A fit takes seconds, the run of one regular wave a tenth of one. One thread at a time. What the process keeps from
/// one start to the next, fit_folder(), is looked through first.
class RadiationFits {
 public:
  struct Known {
    SymmetricData data;
    double tolerance;
    hydro::radiation::RationalFit fit;
    std::optional<std::filesystem::path> kept_in;  ///< by an earlier process
  };
  const Known& of(const SymmetricData& data, double tolerance);
  std::size_t made() const { return known_.size(); }  ///< so far, whatever was asked again

 private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<const Known>> known_;
};

/// Coefficients as they were read from files or computed, and poles fitted to them. What changes in a file after it was
/// read is not seen.
class Kept {
 public:
  /// Those known by this name, or what `make` makes.
  const hydro::potential::Coefficients& coefficients(const std::string& name,
                                                     const std::function<hydro::potential::Coefficients()>& make);
  RadiationFits& fits() { return fits_; }

 private:
  std::mutex mutex_;
  std::map<std::string, hydro::potential::Coefficients> coefficients_;
  RadiationFits fits_;
};

}  // namespace froude::compile
