// A force element of one's own: [[sail]] in a scene. Its force is 1/2 rho C A |w - v| (w - v), with the wind w and the
// velocity v of the point where it acts.  sail SCENE
#include <fmt/core.h>

#include <dynamics/force/point_force.hpp>
#include <froude/element.hpp>
#include <froude/scene.hpp>
#include <memory>
#include <vector>

namespace {

namespace dim = hydro::dim;
namespace fs = froude::scene;

struct Sail {
  Eigen::Vector3d at = Eigen::Vector3d::Zero(), wind = Eigen::Vector3d::Zero();
  double area = 0, drag = 0;
};

const fs::Binding<Sail>& keys() {
  static const fs::Binding<Sail> keys =
      fs::Binding<Sail>("[[sail]]", "catches the wind, however it is turned")
          .key(fs::vector("at", dim::length, "where the wind acts, body axes"), &Sail::at)
          .key(fs::vector("wind", dim::velocity, "of the wind, global axes"), &Sail::wind)
          .key(fs::quantity("area", dim::area, "that the wind meets").positive(), &Sail::area)
          .key(fs::number("drag", "C, on that area").positive().or_default("1.2", "a plate across the wind"),
               &Sail::drag);
  return keys;
}

/// The law by the velocity v of the point; what of the body's motion that is, dynamics::PointForceKind knows.
struct SailLaw {
  Eigen::Vector3d wind;
  double k;  ///< 1/2 rho C A, kg/m
  Eigen::Vector3d force(const Eigen::Vector3d& v) const { return k * (wind - v).norm() * (wind - v); }
  /// -k (|u| + u u^T / |u|), u = w - v.
  Eigen::Matrix3d by_velocity(const Eigen::Vector3d& v) const {
    const Eigen::Vector3d u = wind - v;
    if (u.isZero()) return Eigen::Matrix3d::Zero();
    return -k * (u.norm() * Eigen::Matrix3d::Identity() + u * u.transpose() / u.norm());
  }
};
constexpr double density_of_air = 1.225;  // kg/m^3

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 2) return fmt::print(stderr, "sail SCENE\n"), 2;
  froude::add_element(froude::on_bodies<Sail>("sail", keys(), [](const auto& all, const froude::Site& site) {
    std::vector<dynamics::AtPoint<SailLaw>> sails;
    for (const auto& [name, body, sail] : all)
      sails.push_back({site.point(body, sail.at), {sail.wind, 0.5 * density_of_air * sail.drag * sail.area}, name});
    return std::make_unique<dynamics::PointForceKind<SailLaw>>(
        std::move(sails), dynamics::PointForceWords{"sail", "quadratic drag of the air at the point's velocity"});
  }));
  const froude::Scene scene = froude::read(argv[1]);
  for (const auto& section : scene.plan().sections)
    for (const auto& line : section.lines)
      if (line.effect == "sail") fmt::print("{}: {}; {}\n", line.effect, line.method, line.size);
  const froude::Run run = scene.run();
  for (const froude::Signal& s : run.signals) fmt::print("{} ends at {:.4f} {}\n", s.name, s.values.back(), s.units);
} catch (const hydro::InputError& error) {
  return fmt::print(stderr, "{}\n", error.what()), 2;
}
