#pragma once
/// \file  Private: how fast this machine is, for costs that are told beforehand.

namespace hydro::potential {

/// Complex multiplications a second of products of matrices, one thread, measured now: some milliseconds.
double multiplications_per_second();

}  // namespace hydro::potential
