#pragma once
/// \file  Parameters of any simulation from a record of what it should have told: single and multiple shooting with
///        differenced sensitivities; (F41)-(F43), docs/theory/fit.md.
///
/// The simulation is whatever computes samples: a scene of motion, a line, another program. It needs no derivatives.
#include <Eigen/Core>

#include <limits>
#include <string>
#include <vector>

#include "fit/coefficient.hpp"
#include "fit/least_squares.hpp"
#include "fit/verdict.hpp"

namespace fit {

/// A motion that somebody else computes, in windows. A short record is one window whose start the parameters tell; a
/// long or chaotic one is many windows, each with a start of its own.
class Simulation {
 public:
  virtual ~Simulation() = default;
  /// How many numbers describe the start of a window, each of order one per metre, radian, m/s or rad/s; all zero is
  /// the start that hand_on() left. None: it follows from the parameters.
  virtual Eigen::Index coordinates(std::size_t window) = 0;
  /// The samples of a window, shape as measured. \throws hydro::NumericsError or hydro::InputError where there is no
  /// such motion: a search then tries a shorter step
  virtual Eigen::MatrixXd follow(std::size_t window, const Eigen::VectorXd& parameters,
                                 const Eigen::VectorXd& start) = 0;
  /// The end of this window becomes the start of the next, about which its coordinates count. A window that is handed
  /// on again, by another search, makes what was handed on after it void.
  virtual void hand_on(std::size_t window, const Eigen::VectorXd& parameters, const Eigen::VectorXd& start) = 0;
  /// Whether this parameter can move this window: where it cannot, no sensitivity is run for.
  virtual bool moves(std::size_t /*window*/, std::size_t /*parameter*/) const { return true; }
  /// From now on its steps are those that it has of itself divided by this number, 1 or a power of two; what was handed
  /// on stays. False: it has no steps, and so no error of them. (F117)
  virtual bool divide_steps(int /*by*/) { return false; }
};

struct SimulationParameter {
  std::string name;
  double first;  ///< where the search begins
  double lowest = -std::numeric_limits<double>::infinity(), highest = std::numeric_limits<double>::infinity();
  /// A change that matters: |first|, or a tenth of the way between bounds where that is larger, or 1.
  double scale() const;
};

struct SimulationFit;
struct SimulationProblem {
  std::vector<SimulationParameter> parameters;
  std::vector<Eigen::MatrixXd> measured;  ///< one a window, shape (samples, channels)
  std::vector<double> deviations;         ///< of the noise, one a channel: weighs them
  /// Where samples differ in their errors, share them between channels, or were not measured: of each window, one a
  /// sample, shape (channels, channels), what makes of the errors of all channels, each over its deviation, independent
  /// ones of variance 1. Rows and columns of what was not measured, and is NaN, are zero. Empty: as `deviations` say.
  std::vector<std::vector<Eigen::MatrixXd>> whitening = {};
  /// One a channel that was measured up to whole multiples of it, as an angle is by a film: the motion is compared at
  /// the nearest. Zero: of one that was measured as it is. Empty: of all. (V11)
  std::vector<double> periods = {};
  double confidence = 0.95;
  int iterations_reach = 60;
  bool accept_residuals = false;  ///< values are told though residuals exceed what the deviations allow
  /// The fit of another record of the same motion in the same windows, by the same simulation: the search begins where
  /// that one ended, which spares finding starts and most sensitivities. Null: at the first values.
  const SimulationFit* begin = nullptr;
};

struct SimulationFit {
  std::vector<Coefficient> parameters;
  /// Whose interval is that of the likelihood, one a parameter: at its ends the cost does not rise as the second
  /// derivative says. (F76)
  std::vector<bool> by_likelihood;
  SearchReport search;
  std::vector<StatedResiduals> stated;  ///< residuals against their deviations, one a channel
  /// Why no parameter has a value or an interval, and the motion no bands: a search without an end, or residuals that
  /// the deviations do not allow and nobody accepted. Empty where they may be told. (F65), (F66)
  std::string refused;
  std::vector<Eigen::VectorXd> starts;  ///< coordinates of each window's start, those that the data see
  std::vector<Eigen::MatrixXd> motion;  ///< fitted, as measured
  /// Half-widths at each sample at the confidence asked for: of the fitted motion itself, and of a sample measured anew
  /// in the same motion. Each sample for itself, not all at once. (F46)
  std::vector<Eigen::MatrixXd> fit_band, sample_band;
  double inside;                         ///< share of the samples within sample_band
  std::vector<double> rms;               ///< of the residuals, one a channel, in its unit
  Eigen::Index starts_seen, starts_all;  ///< directions of all windows' starts that the data see, and all there are
  Eigen::VectorXd
      singular_values;          ///< of the parameters' columns over their scales once the starts are taken out (F43)
  std::string weakest;          ///< the combination of parameters that the record tells least, and how well
  Eigen::MatrixXd correlation;  ///< of the parameters
  double dof;                   ///< of Student's t behind the intervals
  std::string caution;          ///< why they may not hold; empty where nothing is known against them
  long windows_followed;        ///< what it took
  /// What SimulationProblem::begin goes on from.
  struct End {
    Eigen::VectorXd unknowns;           ///< parameters, then starts
    std::vector<Eigen::MatrixXd> seen;  ///< directions of each window's start that the data see
    Eigen::MatrixXd jacobian;
  } end;
};

/// Fits parameters and starts together (F41). A parameter that ends at a bound, or whose interval is wider than ten
/// times its scale, has no value and says why; where `refused` says so, none has. Intervals count the memory of the
/// residuals (F4), and are those of the likelihood where the second derivative does not describe it (F76).
/// \throws hydro::InputError: shapes that do not fit (also of `begin`), first values outside their bounds, what the
/// simulation throws at the first values
SimulationFit fit_simulation(Simulation& simulation, const SimulationProblem& problem);

/// The samples of all windows with these parameters, shape as measured; nothing is fitted. The simulation must have no
/// coordinates of starts. \throws hydro::InputError for shapes that do not fit or a window with a start of its own, and
/// what the simulation throws
std::vector<Eigen::MatrixXd> follow_all(Simulation& simulation, const SimulationProblem& problem,
                                        const Eigen::VectorXd& parameters);

/// Interval of one parameter from the likelihood itself: it is held at trial values, all else is fitted again from
/// where `fit` ended, and the ends are where the cost has risen as in (F37), or the parameter's bound where it has not
/// risen by then. Unlike `parameters[k].interval` it need not be symmetric. Each end takes four to six searches, and is
/// known to 3 % of its distance. `fit` is that of this problem, and the last that `simulation` was fitted in. \throws
/// hydro::InputError for a parameter without a value or error; hydro::NumericsError if an end is not found within 30
/// standard errors
Interval profile_interval(Simulation& simulation, const SimulationProblem& problem, const SimulationFit& fit,
                          std::size_t parameter);

/// The best of several searches, and whether the others found the same.
struct SeveralStarts {
  SimulationFit best;
  int tried, agree,
      failed;   ///< `agree` came to the cost of the best, itself counted; `failed` had no motion to follow
  int unended;  ///< came to no end; where one of these lies lowest, it is the best, and refused
  struct Search {
    Eigen::VectorXd first, last;  ///< parameters
    double cost;                  ///< ½‖r‖² at the last
    bool ended;
  };
  std::vector<Search> searches;  ///< of all that had a motion, in their order
  std::size_t best_of;           ///< which of them is the best
};
/// fit_simulation() from the first values and from `starts` − 1 points of a Halton sequence between the bounds, of
/// which the least cost is kept (F58). \throws hydro::InputError for fewer than two starts, `begin`, or a parameter
/// without both bounds, and what fit_simulation() throws where no start has a motion
SeveralStarts fit_simulation_from(Simulation& simulation, const SimulationProblem& problem, int starts);
/// fit_simulation() from the first values; where that is refused or has no motion, from `more` other points too, which
/// lie between a parameter's bounds, and where it has not both between a quarter and four times its first value (F58).
/// Of more than twelve parameters from the first values alone. \throws as fit_simulation(), where no start has a motion
SeveralStarts fit_simulation_insisting(Simulation& simulation, const SimulationProblem& problem, int more);

}  // namespace fit
