#pragma once
/// \file  The waves of a scene as the user wrote them, and where water is told.
#include <Eigen/Core>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "hydro/base/error.hpp"
#include "hydro/base/types.hpp"
#include "hydro/waves/kinematics/focus.hpp"
#include "hydro/waves/kinematics/sea.hpp"

namespace froude::scene {

using hydro::Place;

template <class T>
struct Located {
  T value;
  Place place;
  operator const T&() const { return value; }  // NOLINT: reads as the value it holds
};

/// Theory of a regular wave; all but linear are for kinematics alone.
enum class RegularTheory { linear, stokes_second, stokes_fifth, stream_function };

struct RegularWave {
  double amplitude;  ///< m, half the height
  double period;     ///< s
  RegularTheory theory = RegularTheory::linear;
  double phase = 0;  ///< rad, φ of (W8), of linear waves
};

/// One system of waves with a spectrum of its own.
struct WaveSystem {
  std::string kind;  ///< as the scene names it
  std::shared_ptr<const hydro::waves::Spectrum> spectrum;
  std::shared_ptr<const hydro::waves::Spreading> spreading;  ///< null: long-crested
  hydro::Angle heading = hydro::Angle::from_radians(0);
};

/// A crest put into a random sea, or standing alone.
struct Crest {
  double height;  ///< m
  hydro::waves::Focus focus;
  bool alone;  ///< nothing around it
};

struct RandomSea {
  std::vector<WaveSystem> systems;  ///< one, or those of a sum
  std::uint64_t seed = 1;           ///< of phases and of whatever else is random
  std::variant<hydro::waves::FftGrid, hydro::waves::EqualEnergy, hydro::waves::RandomInBin> bins;
  hydro::waves::Amplitudes amplitudes = hydro::waves::Amplitudes::fixed;
  std::optional<Crest> crest;
  bool second_order = false;
  std::optional<double> lowest, highest;  ///< rad/s; empty: where next to nothing is left
  Place bins_place;
};

/// Waves of a list.
struct WaveList {
  std::vector<hydro::waves::GivenWave> waves;
  std::filesystem::path file;
  bool second_order = false;
  /// Where the waves are the components of a record at a gauge: what there is of it.
  struct Recorded {
    double begin, end;  ///< s, of the record
    double left_out;    ///< of its variance, outside the band
  };
  std::optional<Recorded> recorded = {};
};

/// Regular waves that take turns.
struct WaveTrains {
  struct Train {
    RegularWave wave;  ///< of linear theory
    std::optional<hydro::Angle> heading;
    double from = 0, fade = 0;  ///< s, as hydro::waves::WaveTrain; of the first 0
    Place place;
  };
  std::vector<Train> trains;
  Eigen::Vector3d at;  ///< where they come at those instants, m
};

struct FocusedPackets {
  std::vector<hydro::waves::Packet> packets;
  hydro::waves::Focus focus;
};

/// A paddle at x = 0 and what it does.
struct WaveTank {
  double length, reflection;         ///< m; relative amplitude
  std::optional<double> hinge;       ///< z of a flap's hinge, m; empty: a piston
  double lowest, highest;            ///< rad/s: the band of the motion that is taken
  bool active_absorption;            ///< waves that come back leave the tank
  double step;                       ///< s, of the record
  std::vector<double> displacement;  ///< m of the paddle at still water, from t = 0
};

struct Waves {
  std::variant<RegularWave, RandomSea, WaveList, WaveTrains, FocusedPackets, WaveTank> kind;
  hydro::Angle heading = hydro::Angle::from_radians(0);
  double ramp = 0;  ///< s; wave loads grow by a half cosine over this time
  hydro::waves::Stretching stretching = hydro::waves::Stretching::vertical;
  Place place;
};

/// A fixed point at which the water is told.
struct Probe {
  std::string name;
  Eigen::Vector3d at;  ///< global, m
  bool elevation = false, velocity = false, acceleration = false, pressure = false;
  Place place;
};

struct AskWaves {
  double from, duration, every;  ///< s
  Place place;
};

}  // namespace froude::scene
