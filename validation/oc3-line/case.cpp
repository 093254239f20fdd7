#include <algorithm>
#include <cmath>

#include "harness/case.hpp"
#include "harness/oc3_line.hpp"

namespace froude::validation::oc3_line_case {
namespace {

struct Peak {
  double tension;
  plot::Series series;
};

Peak peak(int segments, double h) {
  const MooringLine line = oc3_line();
  const PrescribedRun run = run_prescribed(line, segments, std::make_shared<Oc3Moved>(line.fairlead), 0, 60, h);
  Peak out{0, {.name = std::to_string(segments) + " segments", .x = run.time, .y = {}}};
  for (std::size_t i = 0; i < run.time.size(); ++i) {
    out.series.y.push_back(run.fairlead[i] / 1e3);
    if (run.time[i] > 20) out.tension = std::max(out.tension, run.fairlead[i] / 1e3);
  }
  return out;
}

}  // namespace

Outcome outcome(const Folders&) {
  Outcome out;
  for (const int n : {20, 50, 200}) {
    const Eigen::Vector3d pull = end_pulls(oc3_line(), oc3_line().at_rest(n)).fairlead;
    out.numbers.push_back({"static fairlead tension, " + std::to_string(n) + " segments", pull.norm() / 1e3, "kN"});
    if (n == 200) {
      out.numbers.push_back({"its horizontal part", std::hypot(pull.x(), pull.y()) / 1e3, "kN"});
      out.numbers.push_back({"its vertical part", std::abs(pull.z()) / 1e3, "kN"});
    }
  }
  const Peak coarse = peak(20, 0.05), middle = peak(50, 0.05), fine = peak(200, 0.025);
  out.numbers.push_back({"peak while the fairlead moves, 20 segments, step 0.05 s", coarse.tension, "kN"});
  out.numbers.push_back({"peak while the fairlead moves, 50 segments, step 0.05 s", middle.tension, "kN"});
  out.numbers.push_back({"peak while the fairlead moves, 200 segments, step 0.025 s", fine.tension, "kN"});
  out.pictures = {{"tension",
                   "Fairlead tension while it moves by 2 m in surge and 1 m in heave.",
                   {.title = "OC3 line, moved fairlead",
                    .panels = {{.x = {.label = "time", .unit = "s"},
                                .y = {.label = "tension", .unit = "kN"},
                                .series = {coarse.series, fine.series}}}}}};
  return out;
}

}  // namespace froude::validation::oc3_line_case
