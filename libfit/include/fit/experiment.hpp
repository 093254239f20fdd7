#pragma once
/// \file  Planning of experiments: the numbers that belong together, and how long a record must be; (F98)-(F99),
///        docs/theory/fit.md.
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "fit/coefficient.hpp"
#include "fit/morison.hpp"

namespace fit {

/// A cylinder that swings in still water, or in water that swings: U = 2πA/T, KC = UT/D, Re = UD/ν, β = Re/KC.
struct OscillationNumbers {
  std::optional<double> diameter = {};   ///< D, m
  std::optional<double> amplitude = {};  ///< A, m
  std::optional<double> period = {};     ///< T, s
  std::optional<double> speed = {};      ///< U, the largest, m/s
  std::optional<double> kc = {}, re = {}, beta = {};
};
/// All of them from any three that tell D, A and T; more may be given if they agree within 0.1 %. (F98)
/// \throws hydro::InputError for a number or a viscosity that is not positive, for numbers that do not tell all, with
/// what they leave open, and for ones that contradict each other
OscillationNumbers complete(const OscillationNumbers& given, double viscosity);

/// Amplitude of drag over that of inertia in a flow that swings, C_D KC/(π² C), C being C_M of a held cylinder and C_A
/// of one that moves. (F109) \throws hydro::InputError for a number that is not positive
double drag_over_inertia(double cd, double kc, double inertia);

/// What acts on a cylinder across a flow that swings, or that swings in still water; N.
struct LoadSizes {
  double drag, inertia;  ///< amplitudes; inertia with that of the mass beyond the load cells
  double largest;        ///< of both together
};
/// (F109). `speed`: the largest, m/s. \throws hydro::InputError for a number that is not positive
LoadSizes load_sizes(const Cylinder& cylinder, double speed, double period, double cd, double inertia);

/// Of the vortices that a cylinder sheds in a steady flow, St U/D, Hz; (F109). \throws hydro::InputError for a number
/// that is not positive
double shedding_frequency_hz(double strouhal, double speed, double diameter);

/// What a record is to be like, and what it is to tell.
struct PlannedOscillation {
  Cylinder cylinder;
  double amplitude = 0, period = 0;  ///< m, s
  double cd = 1.2, inertia = 1;      ///< what is expected: C_A of a body that moves, C_M of a held one
  double noise = 0;                  ///< standard deviation of the force's, N
  double memory = 0;                 ///< of that noise: its autocorrelation is e^{−t/memory}, s; 0: white
  double step = 0.01;                ///< between samples, s
  double confidence = 0.95;
};
/// How many records plans make of each length, where nothing else is said.
inline constexpr int made_records = 20;
/// What records of one length tell, over `seeds` made ones, each fitted as a measurement is.
struct PlannedLength {
  int cycles;
  double cd_half_width, inertia_half_width;  ///< medians of the half width of the intervals
  double cd_held, inertia_held;              ///< shares of the intervals that hold what was put in
};
/// (F99). \throws hydro::InputError as fit_morison(), for noise, memory or a step that make no sense, fewer than two
/// cycles, and no seeds
PlannedLength told_by(const PlannedOscillation& plan, int cycles, int seeds = made_records, std::uint64_t seed = 1);

enum class Wanted { cd, inertia };
/// Lengths that were tried on the way to one whose interval has at most the half width `width`; the last has, unless
/// that would take more than `most` cycles. Doubles from three on, then goes between the last two. (F99)
/// \throws as told_by(), and for a width that is not positive
std::vector<PlannedLength> lengths_for(const PlannedOscillation& plan, Wanted wanted, double width, int most = 400,
                                       int seeds = made_records);

/// How long a carriage tows at one speed: a tank of a length takes L/U − U/a from it, with the same acceleration at
/// both ends. \throws hydro::InputError unless all are positive; 0 where the speed is not reached
double steady_tow_s(double length_m, double speed, double acceleration);

}  // namespace fit
