// A force element of one's own: [[sail]] in a scene. Its force is 1/2 rho C A |w - v| (w - v), with the wind w and the
// velocity v of the point where it acts.  sail SCENE
#include <fmt/core.h>

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

struct PlacedSail {
  dynamics::PointOnBody point;
  Sail sail;
  double k() const { return 0.5 * 1.225 * sail.drag * sail.area; }  ///< with the density of air, kg/m³
};

/// All sails of a scene. With J = (1, -[r]x) of the point at r from the centre of gravity its velocity is J times that
/// of the body, and the body's load J^T times the force.
class SailKind final : public dynamics::ForceKind {
 public:
  explicit SailKind(std::vector<PlacedSail> sails) : sails_(std::move(sails)) {}
  std::string effect() const override { return "sail"; }
  std::size_t elements() const override { return sails_.size(); }
  std::string method() const override { return "quadratic drag of the air at the point's velocity"; }
  void add_load(const dynamics::Instant& now, dynamics::LoadSink& out) const override {
    for (const PlacedSail& s : sails_) out.add(s.point.body, load_of(s, now.state));
  }
  /// By velocity -k J^T (|u| + u u^T / |u|) J, u = w - v; that the lever turns is left to the iteration.
  void add_jacobian(const dynamics::Instant& now, dynamics::JacobianSink& out) const override {
    for (const PlacedSail& s : sails_) {
      const Eigen::Vector3d u = s.sail.wind - velocity_of(s.point, now.state);
      if (u.isZero()) continue;
      const Eigen::Matrix3d by_point = -s.k() * (u.norm() * Eigen::Matrix3d::Identity() + u * u.transpose() / u.norm());
      const auto J = dynamics::place_by_displacement(arm_of(s.point, now.state));
      out.add(s.point.body, s.point.body, dynamics::Matrix6::Zero(), J.transpose() * by_point * J);
    }
  }
  dynamics::EnergyFlow energy(const dynamics::Instant& now) const override {
    dynamics::EnergyFlow flow;
    for (const PlacedSail& s : sails_) flow.supplied += load_of(s, now.state).dot(now.state.twist(s.point.body));
    return flow;
  }

 private:
  static dynamics::Vector6 load_of(const PlacedSail& s, const dynamics::State& state) {
    const Eigen::Vector3d u = s.sail.wind - velocity_of(s.point, state);
    return dynamics::place_by_displacement(arm_of(s.point, state)).transpose() * (s.k() * u.norm() * u);
  }
  std::vector<PlacedSail> sails_;
};

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 2) return fmt::print(stderr, "sail SCENE\n"), 2;
  froude::add_element(froude::on_bodies<Sail>("sail", keys(), [](const auto& all, const froude::Site& site) {
    std::vector<PlacedSail> sails;
    for (const auto& one : all) sails.push_back({site.point(one.body, one.value.at), one.value});
    return std::make_unique<SailKind>(std::move(sails));
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
