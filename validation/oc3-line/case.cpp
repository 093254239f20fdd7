#include <algorithm>
#include <cmath>

#include "harness/case.hpp"
#include "harness/line_cases.hpp"

namespace froude::validation {
namespace {

/// Two metres of surge and one of heave together, period 10 s.
class Moved final : public dynamics::line::Path {
 public:
  explicit Moved(const Eigen::Vector3d& place) : place_(place) {}
  Place at(double t) const override {
    constexpr double omega = 2 * std::numbers::pi / 10;
    const Eigen::Vector3d way(2, 0, 1);
    return {place_ + std::sin(omega * t) * way, omega * std::cos(omega * t) * way,
            -omega * omega * std::sin(omega * t) * way};
  }

 private:
  Eigen::Vector3d place_;
};

MooringLine oc3() {
  constexpr double damping = 0.8 * 902.2 / 200 * 172791;  // 0.8 of ℓ√(EA m) at 200 segments, N s
  return {.length = 902.2,
          .mass_per_length = 77.7066,
          .diameter = 0.09,
          .axial_stiffness = 384.243e6,
          .axial_damping = damping,
          .cd = 1.6,
          .cd_tangential = 0.1,
          .ca = 1,
          .anchor = {853.87, 0, -320},
          .fairlead = {5.2, 0, -70},
          .water = {.density = 1025, .gravity = 9.80665, .depth = hydro::WaterDepth::from_metres(320)},
          .bed = {{.z = -320, .stiffness = 3e6, .damping = 3e5}}};
}

struct Peak {
  double tension;
  plot::Series series;
};

Peak peak(int segments, double h) {
  const MooringLine line = oc3();
  const LedRun run = run_led(line, segments, std::make_shared<Moved>(line.fairlead), 0, 60, h);
  Peak out{0, {.name = std::to_string(segments) + " segments", .x = run.time, .y = {}}};
  for (std::size_t i = 0; i < run.time.size(); ++i) {
    out.series.y.push_back(run.fairlead[i] / 1e3);
    if (run.time[i] > 20) out.tension = std::max(out.tension, run.fairlead[i] / 1e3);
  }
  return out;
}

}  // namespace

Outcome oc3_line(const Folders&) {
  Outcome out;
  for (const int n : {20, 50, 200}) {
    const Eigen::Vector3d pull = end_pulls(oc3(), oc3().at_rest(n)).fairlead;
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

}  // namespace froude::validation
