#include <algorithm>
#include <cmath>

#include "fit/decay.hpp"
#include "harness/case.hpp"
#include "hydro/io/csv.hpp"

namespace froude::validation::roll_decay {

Outcome outcome(const Folders& folders) {
  const auto table = hydro::io::CsvTable::read(folders.shared("ecn_roll_decay/roll_decay_experiment.csv"));
  const auto &all_time = table.column("t_fullscale_s"), &all_roll = table.column("roll_rad");
  const auto n =
      static_cast<std::size_t>(std::count_if(all_time.begin(), all_time.end(), [](double t) { return t <= 100; }));
  fit::Window record{(all_time[n - 1] - all_time[0]) / static_cast<double>(n - 1),
                     Eigen::Map<const Eigen::VectorXd>(all_roll.data(), static_cast<Eigen::Index>(n))};
  const std::vector<fit::Window> records{record};
  const auto both = fit::fit_decay(records);
  const auto linear = fit::fit_decay(records, {.terms = {.linear = true}});
  const auto value = [](const fit::Coefficient& c) { return c.value.value_or(std::nan("")); };
  const auto half = [](const fit::Coefficient& c) { return (c.interval.high - c.interval.low) / 2; };

  const std::span<const double> time(all_time.data(), n), roll(all_roll.data(), n);
  plot::Series measured{"measured", {time.begin(), time.end()}, {roll.begin(), roll.end()}},
      fitted{"fitted", measured.x, {}, true, false, true};
  const Eigen::MatrixXd& motion = both.motion.motion[0];
  fitted.y.assign(motion.data(), motion.data() + motion.rows());
  return {
      .numbers = {{"period", value(both.period), "s"},
                  {"half width of the interval of the period", half(both.period), "s"},
                  {"linear damping", value(both.damping[0]), "1/s"},
                  {"half width of the interval of linear damping", half(both.damping[0]), "1/s"},
                  {"quadratic damping", value(both.damping[1]), "1/rad"},
                  {"half width of the interval of quadratic damping", half(both.damping[1]), "1/rad"},
                  {"residual", both.motion.rms[0], "rad"},
                  {"quadratic damping by energy over that of the whole motion",
                   *both.energy.damping[1].value / value(both.damping[1]), ""},
                  {"AICc gained by the quadratic term", linear.aicc - both.aicc, ""},
                  {"change of a sample if integration steps are halved", both.motion.integration_error, "deviations"}},
      .pictures = {{"decay",
                    "Roll of a ship model let go, full scale, and the motion that linear and quadratic damping give.",
                    {.title = "Roll decay",
                     .panels = {{.x = {.label = "time", .unit = "s"},
                                 .y = {.label = "roll", .unit = "rad"},
                                 .series = {measured, fitted}}}},
                    true}}};
}

}  // namespace froude::validation::roll_decay
