#pragma once
/// \file  What the spacing of the coefficients' frequencies does to linear answers: (E3). Private to apps.
#include <complex>
#include <functional>
#include <vector>

#include "compile/compile.hpp"
#include "compile/signal_list.hpp"
#include "froude/result.hpp"
#include "scene/scene.hpp"

namespace froude {

/// Values of signal number i per metre of wave amplitude, heading by heading: worked out as they are asked for, since
/// those of all signals at once would fill fresh memory.
using SignalValues = std::function<std::vector<std::complex<double>>(std::size_t)>;

/// Of each signal its largest value, but none less than a thousandth of the largest of its unit, nor than what rounding
/// leaves.
std::vector<double> peaks_of(const std::vector<ComplexSignal>& signals);

/// A linear answer from these coefficients.
using LinearAnswer = std::function<SignalValues(const compile::Prepared&)>;

/// The error of each value over the largest of its signal, and of signals of less than a thousandth of the largest of
/// their unit over that thousandth, by answers from every second and every fourth frequency. Values at frequencies of
/// the data have none. `whole` is the answer from all of them, at `omega`, rad/s, heading by heading. Nothing without
/// coefficients; ErrorEstimate::missing where they have too few frequencies.
ErrorEstimate error_of_spacing(const scene::Scene& scene, const compile::Prepared& prepared,
                               const std::vector<double>& omega, const std::vector<ComplexSignal>& whole,
                               const LinearAnswer& answer);

/// The same of a sea's answer: amplitudes of all signals, one row a signal, one column a component. Errors are rms over
/// the components, over rms of the signal.
ErrorEstimate error_of_spacing(const scene::Scene& scene, const compile::Prepared& prepared,
                               const std::vector<compile::Signal>& signals, const Eigen::MatrixXcd& whole,
                               const std::function<Eigen::MatrixXcd(const compile::Prepared&)>& answer);

}  // namespace froude
