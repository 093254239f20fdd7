#include "fit/several_records.hpp"

#include <algorithm>
#include <utility>

#include "hydro/base/error.hpp"

namespace fit {

SeveralRecords::SeveralRecords(std::vector<Record> records) : records_(std::move(records)) {
  hydro::require(!records_.empty(), "a fit needs a record at least");
  for (const Record& r : records_) hydro::require(r.windows > 0, "a record needs a window at least");
}

SeveralRecords::Of SeveralRecords::of(std::size_t window) const {
  for (const Record& record : records_) {
    if (window < record.windows) return {record, window};
    window -= record.windows;
  }
  hydro::ensure(false, "records have fewer windows than are asked for");
  return {records_.back(), 0};
}

Eigen::Index SeveralRecords::coordinates(std::size_t window) {
  const auto [record, own] = of(window);
  return record.simulation->coordinates(own);
}

Eigen::MatrixXd SeveralRecords::follow(std::size_t window, const Eigen::VectorXd& parameters,
                                       const Eigen::VectorXd& start) {
  const auto [record, own] = of(window);
  return record.simulation->follow(own, parameters(record.takes), start);
}

void SeveralRecords::hand_on(std::size_t window, const Eigen::VectorXd& parameters, const Eigen::VectorXd& start) {
  const auto [record, own] = of(window);
  if (own + 1 < record.windows) record.simulation->hand_on(own, parameters(record.takes), start);
}

bool SeveralRecords::moves(std::size_t window, std::size_t parameter) const {
  const auto& takes = of(window).record.takes;
  return std::find(takes.begin(), takes.end(), static_cast<Eigen::Index>(parameter)) != takes.end();
}

bool SeveralRecords::divide_steps(int by) {
  bool any = false;
  for (const Record& record : records_) any = record.simulation->divide_steps(by) || any;
  return any;
}

}  // namespace fit
