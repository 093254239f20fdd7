#pragma once
/// \file  The ways of summing Re Σ_j c_sj e^{iω_j t} on an even grid of times, for several signals s at once.
#include <Eigen/Core>

#include <span>

#include "hydro/waves/synthesis/synthesis.hpp"

namespace hydro::waves::series {

/// What all methods are given: ω (components), times, c (signals, components) with the start time turned into it.
struct Task {
  std::span<const double> omega;
  double dt;
  std::size_t samples;
  const Eigen::MatrixXcd& amplitudes;
};

/// Each fills `out`, shape (samples, signals).
void plain(const Task& task, Eigen::MatrixXd& out);
void blocked_phasors(const Task& task, Eigen::MatrixXd& out);
void nonuniform_fft(const Task& task, Eigen::MatrixXd& out);
/// Every component is the bin `index` of a transform over one repetition of `period` samples (W10).
void inverse_fft(const Task& task, std::span<const std::size_t> index, std::size_t period, Eigen::MatrixXd& out);

/// Only one sample in `decimation` is summed, by the method given, and the others interpolated (W99).
using Summation = void (*)(const Task&, Eigen::MatrixXd&);
void decimated(const Task& task, Summation coarse_method, Eigen::MatrixXd& out);

/// The power of two by which the samples may be thinned out, 1 … 64; 1 means not at all.
std::size_t decimation(std::span<const double> omega, double dt);
/// Samples that are summed then.
std::size_t decimated_samples(std::size_t samples, std::size_t factor);
/// Largest relative error that the interpolation brings in, and the factor by which it amplifies those of the sum.
double decimation_error();
double decimation_amplification();

/// Half the samples of a block of phasors. Longer blocks need fewer operands at their centres, of each signal, but a
/// longer table, which all signals share.
std::size_t half_block(std::size_t samples);

/// Length of the transform that nonuniform_fft takes.
std::size_t nonuniform_length(std::size_t samples);
/// Largest relative error that interpolation brings into nonuniform_fft.
double nonuniform_error();

}  // namespace hydro::waves::series
