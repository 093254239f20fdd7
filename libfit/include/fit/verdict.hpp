#pragma once
/// \file  When a fit may tell a value: its search has ended, and what it leaves over is what was stated of the noise;
///        (F65)-(F67), docs/theory/fit.md.
#include <Eigen/Core>

#include <string>

#include "fit/coefficient.hpp"
#include "fit/least_squares.hpp"
#include "hydro/base/error.hpp"

namespace fit {

/// A search without an end: of where it stands no value is told.
class SearchFailed : public hydro::NumericsError {
 public:
  SearchFailed(const std::string& why, double cost) : hydro::NumericsError(why), cost_(cost) {}
  double cost() const noexcept { return cost_; }  ///< ½‖r‖² where it stands

 private:
  double cost_;
};

/// Why a search has no end, with its numbers; empty where it has one. (F65)
std::string why_unended(const SearchReport& search);
/// \throws SearchFailed "the search for `what` has no end: …" unless it has one
void require_ended(const SearchReport& search, const std::string& what);

/// Residuals of one channel against the standard deviation that was stated of its noise, in the channel's unit. (F66)
struct StatedResiduals {
  double stated;   ///< the deviation
  double rms;      ///< of the residuals, with what the fit took out of them put back
  double allowed;  ///< the largest rms that the statement allows
  double squares;  ///< independent ones that the rms is made of
  bool hold() const { return rms <= allowed; }
};
/// The largest ratio that a deviation allows of an rms of so many independent squares: one right fit in a thousand
/// leaves more by chance, and a deviation stated with one digit, 2 mm, stands for up to 2.5 mm.
double allowed_ratio(double squares);
/// Residuals are in the order of time; the fit took the share `taken` of their squares, unknowns over samples. Squares
/// of residuals that are correlated are counted as (F4) counts them. \throws hydro::InputError for fewer than 8
/// samples
StatedResiduals against_stated(const Eigen::VectorXd& residuals, double stated, double taken);

/// Where no deviation was stated, a motion must at least be explained for the larger part: the share of its variance
/// that a fit explains, so many at the least. (F67)
constexpr double least_explained = 0.5;

/// No value, and an interval that says nothing.
void withhold(Coefficient& c, const std::string& why);

}  // namespace fit
