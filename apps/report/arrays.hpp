#pragma once
/// \file  Numbers as a report holds them: base64 of their bytes, little-endian, and series thinned by their extremes.
#include <nlohmann/json.hpp>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace froude::html {

using Json = nlohmann::ordered_json;

/// {"n": how many, "f32": base64}: seven digits, enough for what is drawn.
Json single_array(std::span<const double> values);
/// {"n": how many, "f64": base64}: of times, whose differences must keep their digits, and of tables.
Json double_array(std::span<const double> values);
/// Real and imaginary parts that stand side by side, as files have them: {"re": …, "im": …}, single_array() each.
Json complex_array(std::span<const double> pairs);

/// How a record is shown in fewer points: it is cut into pieces of equally many samples, of each of which the lowest
/// and the highest value are kept in the order in which they come, so that no extreme is lost. Where the record is
/// short enough a piece is a sample, and all are kept.
class Thinning {
 public:
  /// `most`: points that may be shown, 2 at least.
  Thinning(std::size_t samples, std::size_t most);

  std::size_t samples() const { return samples_; }
  std::size_t shown() const;
  bool thins() const { return piece_ > 1; }
  /// Of a record of samples(); not finite where the piece has no finite value.
  std::vector<double> values(std::span<const double> of) const;
  /// The times at which the points are drawn: those of the first sample of a piece and of the one in its middle. A
  /// point is off by less than the length of a piece.
  std::vector<double> times(std::span<const double> of) const;
  std::size_t piece() const { return piece_; }  ///< samples

 private:
  std::size_t samples_, piece_;
};

}  // namespace froude::html
