#pragma once
/// \file  Panels of all hulls, and by which equations they are solved. Not installed.
#include <memory>

#include "hydro/potential/wave_field.hpp"
#include "panel_mesh.hpp"

namespace hydro::panels {

/// The answer at one frequency: (6N, 6N) and (6N, headings). Far: from the waves that motions make (G14).
struct OneFrequency {
  Eigen::MatrixXd A, B, B_far;
  Eigen::MatrixXcd X, X_far;
  int partial_waves = 0;  ///< a hull; 0: all panels together
  /// Loads on the parts that sections cut off, (6S, 6N) and (6S, headings); empty without sections.
  Eigen::MatrixXd A_parts = {}, B_parts = {};
  Eigen::MatrixXcd X_parts = {};
};

/// What is extrapolated to panels of no size, entry by entry: the answers, or what kinds of hulls do to waves.
using Extrapolated = std::vector<Eigen::MatrixXcd>;

/// Solves frequency by frequency; from several threads at a time. Frequencies may be +∞, and 0 where has_zero().
class Solver {
 public:
  virtual ~Solver() = default;
  virtual Extrapolated solved(double omega, const std::vector<double>& heading) const = 0;
  /// The answer that solved() means; omega > 0 and finite.
  virtual OneFrequency answer(double omega, const std::vector<double>& heading, const Extrapolated& from) const = 0;
  /// A that solved() means in a limit.
  virtual Eigen::MatrixXd added_mass(double limit, const Extrapolated& from) const = 0;
  /// By what corrections of `solved` values are divided before they are interpolated over frequencies, and multiplied
  /// after: where values vanish as waves become long, so do corrections. At the rising frequencies of the values;
  /// empty: by nothing.
  virtual std::vector<Extrapolated> scales(const std::vector<const Extrapolated*>& solved) const;
  /// The answers of hulls that stand alone, from which their own resonances are seen; of all together that one answer.
  virtual std::vector<OneFrequency> alone(double omega, const std::vector<double>& heading,
                                          const Extrapolated& from) const = 0;
  /// The surface about the hulls, not extrapolated. `threads`: which share the points.
  virtual potential::WaveField field(const potential::FieldQuestion& question, int threads) const = 0;

  OneFrequency at(double omega, const std::vector<double>& heading) const {
    return answer(omega, heading, solved(omega, heading));
  }
  Eigen::MatrixXd added_mass_limit(double limit) const { return added_mass(limit, solved(limit, {})); }
};

/// By how much lower the threshold of partial waves is where their number is tried: what is left out falls at least as
/// the threshold.
inline constexpr double more_partial_waves = 4;

/// Panels of one size, before anything is computed from them.
class Discretisation {
 public:
  virtual ~Discretisation() = default;
  virtual std::unique_ptr<const Solver> solver() const = 0;
  /// Every panel cut in four.
  virtual std::unique_ptr<const Discretisation> refined() const = 0;
  /// With panels halved so often at edges, and no panel that waves reach longer than waves of the frequency `highest`
  /// allow.
  virtual std::unique_ptr<const Discretisation> graded(double highest, int gradings) const = 0;
  /// \throws InputError if panels are longer than waves of the frequency `highest` allow
  virtual void require_short_panels(double highest) const = 0;
  /// Of answers at `omega`, and of these again with every panel cut in four at so many frequencies.
  virtual Cost cost(const std::vector<double>& omega, std::size_t headings, int threads, int refined) const = 0;
  virtual bool has_zero() const = 0;
  /// True if what is extrapolated has the same meaning at all frequencies, so that it can be interpolated.
  virtual bool varies_smoothly() const { return true; }
  virtual double length() const = 0;  ///< the side of a square of the mean wet area of a hull, m
  /// Numbers of panels, planes and partial waves.
  virtual void describe(SelfCheck& check) const = 0;
  /// With a threshold that is more_partial_waves times lower; none where there are no partial waves.
  virtual std::unique_ptr<const Solver> with_more_partial_waves() const { return nullptr; }
};

/// Of `bodies` by the equations that `options` and cost ask for. `bodies` must outlive it.
std::unique_ptr<const Discretisation> discretised(const std::vector<HullBody>& bodies, const Water& water,
                                                  const std::vector<double>& omega, std::size_t headings,
                                                  const Options& options);

/// Of solve(), with a tolerance of its first two meshes.
Cost cost_as_asked(const Discretisation& given, const std::vector<double>& omega, std::size_t headings,
                   const Options& options);

/// Of the coarsest mesh that an error is controlled with: edge panels a quarter as wide. More is not seen beside the
/// others' error.
inline constexpr int usual_gradings = 2;

/// As Discretisation::graded().
PanelMesh first_mesh(const PanelMesh& given, const Water& water, double highest, int gradings);

}  // namespace hydro::panels
