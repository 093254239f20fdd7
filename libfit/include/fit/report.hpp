#pragma once
/// \file  What a fit of any kind tells, as a value: estimates, facts, remarks, cautions, parts, and whether values may
///        be told at all.
#include <fmt/format.h>
#include <Eigen/Core>

#include <concepts>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "fit/coefficient.hpp"

namespace fit {

struct Fact;
/// Facts in the order in which they are told.
using Facts = std::vector<Fact>;
using FactValue = std::variant<bool, std::int64_t, double, std::string, Interval, std::vector<double>,
                               std::vector<std::string>, std::vector<Interval>, Facts, std::vector<Facts>>;

/// A value under its name. Dimensional values are in SI, or the name ends in the unit: "slip_s".
struct Fact {
  std::string name;
  FactValue value;

  Fact(std::string called, FactValue is) : name(std::move(called)), value(std::move(is)) {}
  Fact(std::string called, const char* is) : Fact(std::move(called), FactValue(std::string(is))) {}
  Fact(std::string called, const Eigen::VectorXd& is)
      : Fact(std::move(called), FactValue(std::vector<double>(is.begin(), is.end()))) {}
  template <std::integral Number>
  requires(!std::same_as<Number, bool>) Fact(std::string called, Number is)
      : Fact(std::move(called), FactValue(static_cast<std::int64_t>(is))) {}
};
void append(Facts& facts, Facts more);
/// The value under a name; null where nothing has it.
const FactValue* find(const Facts& facts, std::string_view name);

/// A coefficient with what belongs to it in a report.
struct Estimate {
  Coefficient coefficient;
  std::string unit = {};
  std::optional<Interval> profile = {};  ///< by profile likelihood, where asked for
  std::string key = {};                  ///< among facts; empty: the coefficient's name
  Facts facts = {};                      ///< beside its numbers
  std::string more = {};                 ///< said of it beside value and interval
  bool in_words = false;                 ///< a heading or remark tells it: it needs no line of its own
};
/// Value, errors, intervals, and why there is no value.
Facts facts_of(const Estimate& estimate);

/// Why no value may be told.
struct Refusal {
  enum class Reason {
    search_without_end,     ///< where it stands is no minimum (F65)
    residuals_too_large,    ///< than what was stated of them (F66), or than what is explained (F67)
    halves_differ,          ///< parts of the record tell values that exclude each other (F78)
    wrong_sign,             ///< force and motion work against each other (F26), or the water feeds the motion (F79)
    profile_without_an_end  ///< what is missing is the interval by likelihood: values stand in the report
  } reason;
  std::string why;          ///< one sentence
  std::string source = {};  ///< the run that it is true of; empty: all of them together
  /// Where the search ended or gave up, with units: the best point that is known, which nobody should take for a value.
  std::vector<std::string> best_point = {};  ///< "damping 0.12 kg/s"
};

/// What a fit tells, or a part of it: a run, runs together, the water. Each fact stands here once.
struct Report {
  std::string key = {};      ///< among the facts of the whole; empty: what it tells stands there itself
  bool one_of_many = false;  ///< there the key is that of a list
  std::string heading = {};
  Facts facts = {};
  std::string group = {};  ///< under which the estimates stand among the facts; empty: beside them
  std::vector<Estimate> estimates = {};
  std::vector<std::string> remarks = {};               ///< correlation, residuals, the search
  std::optional<std::vector<std::string>> steps = {};  ///< of the preparation
  std::vector<std::string> cautions = {};
  std::vector<Report> parts = {};
  std::optional<Refusal> refused = {};  ///< values may be told where it is empty

  template <class... Args>
  void say(fmt::format_string<Args...> text, Args&&... args) {
    remarks.push_back(fmt::format(text, std::forward<Args>(args)...));
  }
  void warn(const std::string& caution) {
    if (!caution.empty()) cautions.push_back(caution);
  }
  /// The first estimate of that name in this report and its parts, in their order; null where there is none.
  const Estimate* find(std::string_view coefficient) const;
};

}  // namespace fit
