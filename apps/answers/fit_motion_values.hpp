#pragma once
/// \file  Values of a scene's numbers from the file of an earlier fit. Private to apps.
#include <filesystem>
#include <string>
#include <vector>

#include "fit/problem/motion.hpp"

namespace froude::scene {

/// Values of parameters, and where each is from.
struct GivenValues {
  Eigen::VectorXd at;
  std::vector<std::string> from;
};
/// What parameters begin at.
GivenValues first_values(const ::fit::motion::Problem& problem);
/// Those of a file that `froude fit -o` wrote, each by its key, in the unit of the scene. A record's own parameter is
/// in it where the fit had a record of that name, and begins as the scene says where it had not. \throws
/// hydro::InputError for a file that is no such fit, a parameter that all records share and it has not, one without a
/// value, or one of another dimension
GivenValues values_of_fit(const ::fit::motion::Problem& problem, const std::filesystem::path& file);

}  // namespace froude::scene
