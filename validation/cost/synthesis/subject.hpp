#pragma once
/// \file  What the price list of sea synthesis is about: one sea, one record, fixed and moving points, each method.
///
/// Every method is first held to its stated error at scattered samples: a fast wrong answer is no result.
#include <functional>
#include <string>
#include <vector>

#include "hydro/waves/kinematics/sea.hpp"

namespace froude::cost {

inline constexpr std::size_t components = 1000, steps = 36000;
inline constexpr double dt_s = 0.1;

/// 1 000 components, 36 000 steps of 0.1 s; the repetition is the record, so that an inverse FFT can compete.
const hydro::waves::Sea& sea();

/// Points that move as a moored structure does: 8 m about, 3 m down, each in its own phase.
Eigen::Vector3d place(std::size_t point, std::size_t step);

enum class Wanted { fixed_elevation, moving_elevation, moving_kinematics };
std::string title_of(Wanted wanted);

/// One way to answer: `build` once, then `run` for all points from one step on up to another.
struct Method {
  std::string name;
  bool at_once;  ///< makes the whole record at once and ignores the range of steps
  std::function<void()> build;
  std::function<void(std::size_t from, std::size_t to)> run;
  std::function<Eigen::Vector4d(std::size_t point, std::size_t step)> answer;  ///< ζ and velocity, as found by run()
  std::function<double()> stated_error;  ///< of ζ, or of the velocity where kinematics are wanted; m or m/s; NaN: none
};

/// Steps that may be run at once without keeping too many answers.
std::size_t steps_at_most(std::size_t points);

/// Methods for this many points, the plain one with std::cos first.
std::vector<Method> methods(Wanted wanted, std::size_t points);

/// Largest error at scattered samples of the first `steps_made` steps, over the standard deviation of the sea's
/// elevation or vertical velocity, against sums in extended precision.
/// \throws std::runtime_error if it is larger than what the method states, or than 1e-9 where it states nothing
double guarded_error(const Method& method, Wanted wanted, std::size_t points, std::size_t steps_made);

}  // namespace froude::cost
