#pragma once
/// \file  Scenes of motion drawn at random, as text that may be looked at: the same text for the same seed on every
/// machine.
#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "hydro/base/random.hpp"

namespace support {

/// Numbers, drawn one after the other.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed, 0x5ce4e) {}
  double between(double low, double high) { return low + (high - low) * random_.uniform(next_++); }
  /// Spread evenly over the logarithm.
  double scale(double low, double high) { return std::exp(between(std::log(low), std::log(high))); }
  int count(int least, int most) { return least + static_cast<int>(between(0, most - least + 1)); }
  bool chance(double probability) { return between(0, 1) < probability; }

 private:
  hydro::RandomStream random_;
  std::uint64_t next_ = 0;
};

inline std::string drawn_water(const std::string& depth) {
  return fmt::format("schema = 1\n\n[water]\ndensity = \"1000 kg/m^3\"\ndepth = \"{}\"\n", depth);
}

inline std::string drawn_ask(double duration, double every, const std::string& of) {
  return fmt::format("\n[ask]\nrun = {{ duration = \"{} s\", every = \"{} s\", of = [{}] }}\naccuracy = 1e-2\n",
                     duration, every, of);
}

/// One regular wave after the other, of 3.5 s to 7 s; or a sea of 6 s to 8 s, so that next to nothing of it lies beyond
/// the data at hand, 4 rad/s. Heights are a hundredth to a thirtieth of the length in deep water.
inline std::string drawn_waves(Draw& draw) {
  const bool regular = draw.chance(0.5);
  const double period = regular ? draw.between(3.5, 7) : draw.between(6, 8);
  const double height = 1.56 * period * period * draw.between(0.01, 0.033);
  const std::string of_kind =
      regular ? fmt::format("kind = \"regular\"\nheight = \"{:.3g} m\"\nperiod = \"{:.3g} s\"", height, period)
              : fmt::format("kind = \"jonswap\"\nhs = \"{:.3g} m\"\ntp = \"{:.3g} s\"\nseed = {}", height, period,
                            draw.count(1, 1000));
  return "\n[waves]\n" + of_kind + "\nheading = \"0 deg\"\nramp = \"8 s\"\n";
}

/// One to three rods on hinges, one below the other, let go aslant; hinges damp, and one may rub.
inline std::string drawn_pendulums(Draw& draw) {
  const int n = draw.count(1, 3);
  const double largest = n == 1 ? 70 : 25;  // degrees: chains let go from higher up soon become chaotic
  std::string text = drawn_water("infinite");
  double x = 0, z = 0, level = 0;
  for (int i = 1; i <= n; ++i) {
    const double length = draw.between(0.5, 2), mass = draw.scale(2, 50), angle = draw.between(0.3, 1) * largest;
    const double inertia = mass * length * length / 12;
    text += fmt::format(
        "\n[[body]]\nname = \"rod{}\"\nposition = \"(0, 0, {:.12g}) m\"\nmass = \"{:.6g} kg\"\nweight = "
        "true\ncentre_of_gravity = \"(0, 0, {:.12g}) m\"\ninertia = \"({:.6g}, {:.6g}, {:.6g}) kg m^2\"\nfree = "
        "[\"surge\", \"heave\", \"pitch\"]\ninitial = {{ surge = \"{:.14g} m\", heave = \"{:.14g} m\", pitch = "
        "\"{:.14g} deg\" }}\n",
        i, level, mass, -length / 2, inertia, inertia, 0.01 * inertia, x, z, angle);
    text += fmt::format(
        "\n[[joint]]\nname = \"hinge{}\"\nkind = \"hinge\"\nbetween = [\"{}\", \"rod{}\"]\nat = \"(0, 0, {:.12g}) "
        "m\"\naxis = \"y\"\npto = {{ damping = \"{:.4g} N m s/rad\" }}\n",
        i, i == 1 ? "ground" : fmt::format("rod{}", i - 1), i, level, draw.scale(0.003, 0.1) * mass * length * length);
    const double torque = draw.between(0.01, 0.04) * mass * 9.81 * length;
    if (i == 1 && draw.chance(0.6))
      text += fmt::format("friction = {{ static = \"{:.4g} N m\", dynamic = \"{:.4g} N m\" }}\n", torque, 0.8 * torque);
    const double radians = angle * std::numbers::pi / 180;
    x -= length * std::sin(radians);
    z += length * (1 - std::cos(radians));
    level -= length;
  }
  return text + drawn_ask(12, 0.05, "\"hinge*.angle\", \"rod*.pitch\"");
}

/// Two to five masses in a row: springs with damping, some of them cables that go slack, and a push.
inline std::string drawn_row(Draw& draw) {
  const int n = draw.count(2, 5);
  std::string text = drawn_water("infinite"), springs;
  const double stiffness = draw.scale(2e3, 2e5);
  for (int i = 1; i <= n; ++i) {
    const double mass = draw.scale(500, 5000);
    text += fmt::format(
        "\n[[body]]\nname = \"b{}\"\nposition = \"({}, 0, 0) m\"\nmass = \"{:.5g} kg\"\nfree = [\"surge\"]\n", i, 4 * i,
        mass);
    if (i == 1) text += fmt::format("initial = {{ surge = \"{:.3g} m\" }}\n", draw.between(0.2, 0.6));
    const double k = stiffness * draw.between(0.5, 2), damping = draw.scale(0.01, 0.1) * std::sqrt(k * mass);
    const bool cable = draw.chance(0.4);
    springs += fmt::format(
        "\n[[connector]]\nname = \"c{}\"\nbetween = [\"b{}\", \"{}\"]\nends = [\"(-1, 0, 0) m\", \"({}, 0, 0) "
        "m\"]\nkind = "
        "\"{}\"\nstiffness = \"{:.5g} N/m\"\ndamping = \"{:.4g} N s/m\"\nrest_length = \"{:.4g} m\"\n",
        i, i, i == 1 ? "ground" : fmt::format("b{}", i - 1), i == 1 ? 0 : 1, cable ? "cable" : "axial", k, damping,
        (i == 1 ? 3 : 2) * (cable ? draw.between(0.97, 1.02) : 1));
  }
  springs += fmt::format("\n[[mooring]]\non = [\"b{}\"]\nkind = \"linear\"\nstiffness = {{ surge = \"{:.4g} N/m\" }}\n",
                         n, 0.3 * stiffness);
  return text + springs + drawn_ask(20, 0.05, "\"b*.surge\", \"c*.force\"");
}

inline std::string drawn_modules(Draw& draw, int n, const std::string& more) {
  return fmt::format(
             "\n[[body]]\nname = \"m\"\nposition = \"(-26, 0, 0) m\"\ncopies = {{ count = {}, step = \"(13, 0, 0) m\" "
             "}}\nmass = \"9088 kg\"\ncentre_of_gravity = \"(0, 0, 1.31) m\"\nradii_of_gyration = \"(4.6, 4.6, 6.4) "
             "m\"\nfree = [\"surge\", \"heave\", \"pitch\"]\n{}[body.hydrodynamics]\nfile = \"data/pontoon5.nc\"\nbody "
             "= "
             "1\nexcitation = true\nradiation = {{ accept_error = 0.1 }}\nhydrostatics = true\n",
             n, more) +
         fmt::format(
             "\n[[mooring]]\nname = \"mooring\"\non = [\"m*\"]\nkind = \"linear\"\nstiffness = {{ surge = \"{:.4g} "
             "N/m\" }}\n",
             draw.scale(1e3, 1e4));
}

inline std::string drawn_drag(Draw& draw) {
  return fmt::format(
      "\n[[member]]\non = \"m*\"\nfrom = \"(±5.2, ±5.2, -1.13) m\"\nto = \"(±5.2, ±5.2, 0) m\"\ndiameter = \"1.6 "
      "m\"\ndrag = {{ cd = {:.2g} }}\n",
      draw.between(0.6, 1.4));
}

/// One to four modules between springs, in waves.
inline std::string drawn_array(Draw& draw) {
  const int n = draw.count(1, 4);
  std::string text = drawn_water("14 m") + drawn_waves(draw) + drawn_modules(draw, n, "");
  if (draw.chance(0.6)) text += drawn_drag(draw);
  const double stiffness = draw.scale(5e3, 5e4);
  if (n > 1)
    text += fmt::format(
        "\n[[connector]]\nname = \"c\"\nbetween = \"neighbours of m\"\nends = [\"(6, ±5, 0.5) m\", \"(-6, ±5, 0.5) "
        "m\"]\nkind = \"{}\"\nstiffness = \"{:.4g} N/m\"\ndamping = \"1 kN s/m\"\n",
        draw.chance(0.5) ? "cable" : "axial", stiffness);
  return text + drawn_ask(40, 0.1, "\"m*.surge\", \"m*.heave\", \"m*.pitch\", \"wave.elevation\"");
}

/// Two or three modules on hinges, which spring, damp and may rub, in waves.
inline std::string drawn_hinged(Draw& draw) {
  const int n = draw.count(2, 3);
  std::string text = drawn_water("14 m") + drawn_waves(draw) + drawn_modules(draw, n, "");
  text += fmt::format(
      "\n[[joint]]\nname = \"hinge\"\nkind = \"hinge\"\nbetween = \"neighbours of m\"\nat = \"(-19.5, 0, 0.5) "
      "m\"\naxis = "
      "\"y\"\npto = {{ stiffness = \"{:.4g} N m/rad\", damping = \"{:.4g} N m s/rad\" }}\n",
      draw.scale(1e4, 1e6), draw.scale(1e4, 1e5));
  const double torque = draw.scale(500, 5000);
  if (draw.chance(0.5))
    text += fmt::format("friction = {{ static = \"{:.4g} N m\", dynamic = \"{:.4g} N m\" }}\n", torque, 0.8 * torque);
  return text + drawn_ask(40, 0.1, "\"m*.heave\", \"hinge*.angle\", \"wave.elevation\"");
}

/// A hemisphere, a module or two boxes, let go in still water.
inline std::string drawn_decay(Draw& draw) {
  const int kind = draw.count(0, 2);
  const double heave = draw.between(0.05, 0.5);
  if (kind == 0)
    return drawn_water("infinite") +
           fmt::format(
               "\n[[body]]\nname = \"ball\"\nmass = \"261.8 t\"\ncentre_of_gravity = \"(0, 0, -2) m\"\nfree = "
               "[\"heave\"]\ninitial = {{ heave = \"{:.3g} m\" }}\n[body.hydrodynamics]\nfile = "
               "\"data/hemisphere_r5.nc\"\nradiation = {{ accept_error = 0.5 }}\nhydrostatics = "
               "true\n\n[[mooring]]\non = "
               "[\"ball\"]\nkind = \"linear\"\nstiffness = {{ heave = \"{:.4g} N/m\" }}\n",
               heave, draw.scale(1e4, 1e6)) +
           drawn_ask(40, 0.1, "\"ball.heave\"");
  std::string text =
      drawn_water("14 m") + drawn_modules(draw, kind,
                                          fmt::format("initial = {{ surge = \"{:.3g} m\", heave = \"{:.3g} m\", pitch "
                                                      "= \"{:.3g} deg\" }}\n",
                                                      draw.between(-0.5, 0.5), heave, draw.between(-4, 4)));
  text.replace(text.find("excitation = true\n"), std::string("excitation = true\n").size(), "");
  if (draw.chance(0.6)) text += drawn_drag(draw);
  return text + drawn_ask(40, 0.1, "\"m*.surge\", \"m*.heave\", \"m*.pitch\"");
}

/// A rope between two places, taut or slack, in waves.
inline std::string drawn_rope(Draw& draw) {
  const double span = draw.between(4, 12), depth = draw.between(1, 4);
  return drawn_water("20 m") + drawn_waves(draw) +
         fmt::format(
             "\n[[line]]\nname = \"rope\"\nfrom = \"(0, 0, -1) m\"\nto = \"({:.4g}, 0, -{:.4g}) m\"\nlength = \"{:.5g} "
             "m\"\nsegments = {}\nmass_per_length = \"{:.3g} kg/m\"\ndiameter = \"{:.3g} m\"\nbuoyancy = "
             "true\n[line.morison]\ncd = {:.2g}\nca = 1.0\n",
             span, depth, std::hypot(span, depth - 1) * draw.between(1.05, 1.6), draw.count(8, 24), draw.between(4, 16),
             draw.between(0.03, 0.06), draw.between(0.8, 1.6)) +
         drawn_ask(20, 0.05, "\"rope.node4.*\", \"rope.from.force\", \"rope.largest_tension\"");
}

/// Of six kinds in turn.
inline std::string drawn_scene(std::uint64_t seed) {
  Draw draw(seed);
  switch (seed % 6) {
    case 0:
      return drawn_pendulums(draw);
    case 1:
      return drawn_row(draw);
    case 2:
      return drawn_array(draw);
    case 3:
      return drawn_hinged(draw);
    case 4:
      return drawn_decay(draw);
    default:
      return drawn_rope(draw);
  }
}

}  // namespace support
