#pragma once
/// \file  Private to apps: what is dear to make and serves every model of a scene, also after its numbers have changed.
#include <atomic>
#include <deque>
#include <filesystem>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "hydro/potential/coefficients.hpp"
#include "hydro/potential/doctor/check.hpp"
#include "hydro/radiation/choice.hpp"
#include "hydro/radiation/rational.hpp"
#include "hydro/waves/synthesis/boxed_field.hpp"
#include "scene/scene.hpp"

namespace froude::compile {

/// A and B of some modes, made symmetric.
///
/// A and B of linear theory are symmetric. Panel codes miss that by their discretisation error, which in a run would be
/// energy from nowhere; the frequency domain, which has no ledger to close, takes the data as they are.
struct SymmetricData {
  hydro::radiation::DampingTable damping;
  std::vector<Eigen::MatrixXd> A;
  std::optional<Eigen::MatrixXd> A_inf;
  double asymmetry = 0;  ///< of the largest entry

  SymmetricData(const hydro::potential::Coefficients& c, const std::vector<int>& modes);
  bool operator==(const SymmetricData& other) const;

 private:
  Eigen::MatrixXd of(const Eigen::MatrixXd& whole, const std::vector<int>& modes);
};

/// A fit takes seconds, the run of one regular wave a tenth of one. One thread at a time. What the process keeps from
/// one start to the next, fit_folder(), is looked through first.
class RadiationFits {
 public:
  struct Known {
    SymmetricData data;
    double tolerance;
    hydro::radiation::RationalFit fit;
    std::optional<std::filesystem::path> kept_in;  ///< by an earlier process
  };
  const Known& of(const SymmetricData& data, double tolerance);
  std::size_t made() const { return made_; }  ///< so far, whatever was asked again

 private:
  std::mutex mutex_;
  std::atomic<std::size_t> made_ = 0;
  std::vector<std::unique_ptr<const Known>> known_;
};

/// The memory that was weighed and taken for some data at one step. Weighing costs as much as some thousand steps, and
/// trials of a fit differ in neither.
struct WeighedMemory {
  scene::Memory asked;
  double step;  ///< s
  std::shared_ptr<const SymmetricData> data;
  hydro::radiation::ChosenMemory memory;
  std::vector<std::string> notes;

  bool serves(const scene::Memory& other, double other_step, const SymmetricData& others) const;
};

/// The last ones: kernels of many lags are large. Threads that ask for the same may each make it.
class WeighedMemories {
 public:
  using Weighed = std::shared_ptr<const WeighedMemory>;
  Weighed find(const scene::Memory& asked, double step, const SymmetricData& data) const;
  void keep(Weighed one);
  std::size_t made() const { return made_; }  ///< so far

 private:
  mutable std::mutex mutex_;
  std::atomic<std::size_t> made_ = 0;
  std::deque<Weighed> last_;
};

/// The waves in a box, around members or lines: runs of a scene that differ in their steps and pieces, and trials of a
/// fit, ask for the same ones. Whoever asks first makes them; threads that ask for the same wait, others do not.
class KeptWater {
 public:
  using Field = std::shared_ptr<const hydro::waves::BoxedField>;
  /// That which was made last, if it is of the same waves to the same tolerance, for a box that holds this one.
  Field of(const hydro::waves::HarmonicField& waves, const hydro::waves::FieldUse& use);
  std::size_t made() const { return made_; }  ///< so far

 private:
  struct Made {
    hydro::waves::HarmonicField waves;
    hydro::waves::FieldUse use;
    std::shared_future<Field> field;
  };
  using Serves = std::function<bool(const Made&)>;
  std::shared_ptr<const Made> found(const hydro::waves::HarmonicField& waves, const hydro::waves::FieldUse& use,
                                    const Serves& serves);

  std::mutex mutex_;
  std::atomic<std::size_t> made_ = 0;
  std::shared_ptr<const Made> last_;
};

/// Coefficients as they were read from files or computed, what the doctor finds in them, poles fitted to them, memories
/// that were weighed, and waves around members and lines. What changes in a file after it was read is not seen.
class Kept {
 public:
  /// Those known by this name, or what `make` makes.
  const hydro::potential::Coefficients& coefficients(const std::string& name,
                                                     const std::function<hydro::potential::Coefficients()>& make);
  /// What the doctor finds in coefficients, likewise.
  const std::vector<hydro::potential::Finding>& findings(
      const std::string& name, const std::function<std::vector<hydro::potential::Finding>()>& make);
  RadiationFits& fits() { return fits_; }
  WeighedMemories& memories() { return memories_; }
  KeptWater& water_of_members() { return water_of_members_; }
  KeptWater& water_of_lines() { return water_of_lines_; }
  /// Sets of coefficients, of findings and of fits, so far.
  std::size_t made() const { return made_ + fits_.made(); }

 private:
  /// One thread at a time.
  template <class Value>
  const Value& known(std::map<std::string, Value>& all, const std::string& name, const std::function<Value()>& make);

  std::mutex mutex_;
  std::atomic<std::size_t> made_ = 0;
  std::map<std::string, hydro::potential::Coefficients> coefficients_;
  std::map<std::string, std::vector<hydro::potential::Finding>> findings_;
  RadiationFits fits_;
  WeighedMemories memories_;
  KeptWater water_of_members_, water_of_lines_;
};

}  // namespace froude::compile
