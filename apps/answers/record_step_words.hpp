#pragma once
/// \file  Words and numbers of the steps of a record, which [prepare] of a fit and the options of commands that look at
///        series have alike. Private to apps.
#include <array>
#include <string>
#include <string_view>

#include "fit/prepare.hpp"

namespace froude::scene {

/// A low pass by its word. A kind without an order falls off as it must.
struct LowPassWord {
  std::string_view word;
  ::fit::FilterChoice::Kind kind;
  bool has_order, has_ripple;
};

inline constexpr std::array low_pass_words{
    LowPassWord{"butterworth", ::fit::FilterChoice::Kind::butterworth, true, false},
    LowPassWord{"chebyshev", ::fit::FilterChoice::Kind::chebyshev, true, true},
    LowPassWord{"gaussian", ::fit::FilterChoice::Kind::gaussian, false, false},
    LowPassWord{"symmetric weights", ::fit::FilterChoice::Kind::finite, false, false},
};

/// Of a Chebyshev filter: as little as a load cell is wrong by.
inline constexpr double usual_ripple = 0.005;
/// Deviations of the neighbours by which an outlier is off: noise itself comes as far as the least.
inline constexpr double least_outlier_deviations = 3, usual_outlier_deviations = 8;

/// The word of a low pass that is in the list.
inline std::string word_of(::fit::FilterChoice::Kind kind) {
  for (const LowPassWord& low_pass : low_pass_words)
    if (low_pass.kind == kind) return std::string(low_pass.word);
  return {};
}

}  // namespace froude::scene
