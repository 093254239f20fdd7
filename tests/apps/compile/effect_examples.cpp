#include "effect_examples.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <fstream>

#include "scenes.hpp"

namespace effects {
namespace {

using Kinds = std::vector<std::string>;

const std::string ask = R"([ask]
run = { duration = "2 s", every = "0.05 s" }
accuracy = 1e-2
[solve]
step = "0.05 s"
)";
const std::string waves = "[waves]\nkind = \"regular\"\nheight = \"1 m\"\nperiod = \"5 s\"\nheading = \"0 deg\"\n";
const std::string module = R"([[body]]
name = "m"
mass = "9088 kg"
centre_of_gravity = "(0, 0, 1.31) m"
radii_of_gyration = "(4.6, 4.6, 6.4) m"
)";
/// Coefficients with one effect of them.
std::string hydrodynamics(const std::string& effect) {
  return "[body.hydrodynamics]\nfile = \"pontoon1.nc\"\n" + effect;
}
/// A thin pile under the body, up to a height, m.
std::string member(const std::string& loads, double top = -0.5) {
  return fmt::format("[[member]]\non = \"m\"\nfrom = \"(0, 0, -2) m\"\nto = \"(0, 0, {}) m\"\ndiameter = \"0.1 m\"\n{}",
                     top, loads);
}
const std::string morison = "morison = { cd = 1.0, ca = 1.0, pieces = 3 }\n";

/// A body, with keys of its own and with further tables.
Example body(const std::string& name, const std::string& keys, const std::string& tables, const Kinds& kinds) {
  return {name, froude_test::water + module + keys + tables + ask, kinds};
}
/// The same in a regular wave.
Example in_waves(const std::string& name, const std::string& keys, const std::string& tables, const Kinds& kinds) {
  return {name, froude_test::water + waves + module + keys + tables + ask, kinds};
}
/// Waves of any kind around a member.
Example sea(const std::string& name, const std::string& table) {
  return {name,
          froude_test::water + "[waves]\nheading = \"0 deg\"\n" + table + module + "position = \"(5, 0, 0) m\"\n" +
              member(morison) + ask,
          {"morison"}};
}

std::vector<Example> of_body() {
  return {
      body("weight", "weight = true\n", "", {"weight"}),
      body("net load", "net_load = true\n", "", {}),
      body("own energy", "energy = true\n", "", {}),
      body("start", "initial = { heave = \"0.1 m\" }\ninitial_velocity = { surge = \"0.1 m/s\" }\n", "", {}),
      body("copies", "copies = { count = 2, step = \"(13, 0, 0) m\" }\n", "", {}),
      body("buoyancy of cylinders", "",
           "[body.buoyancy.cylinders]\nfrom = \"(0, 0, -1) m\"\nto = \"(0, 0, 1) m\"\ndiameter = \"3 m\"\n",
           {"buoyancy"}),
      body("buoyancy of spheres", "", "[body.buoyancy.spheres]\nat = \"(0, 0, 0) m\"\ndiameter = \"3 m\"\n",
           {"buoyancy"}),
      body("probe, point, relative motion", "",
           "[[probe]]\nat = \"(0, 0, -1) m\"\ngives = \"velocity\"\n"
           "[[point]]\non = \"m\"\nat = \"(1, 0, 0) m\"\ngives = \"position\"\n"
           "[[relative_motion]]\nbetween = [\"m\", \"ground\"]\nends = [\"(1, 0, 0) m\", \"(1, 0, 0) m\"]\n",
           {}),
      body("wind", "",
           "[[wind]]\non = \"m\"\nat = \"(0, 0, 4) m\"\narea = \"10 m^2\"\nspeed = \"12 m/s\"\nheading = \"30 deg\"\n",
           {"wind"}),
      body("damping", "",
           "[[damping]]\non = \"m\"\nlinear = { heave = \"2 kN s/m\" }\nquadratic = { pitch = \"3 kN m s^2/rad^2\" "
           "}\n",
           {"damping"}),
      body("load", "", "[[load]]\non = \"m\"\nforce = \"(1, 0, 0) kN\"\n", {"load"}),
  };
}

std::vector<Example> of_potential_flow() {
  const std::string turning =
      "excitation = true\nturning = { from = \"-5 deg\", to = \"0 deg\", slower_than = \"60 s\" }\n";
  const std::string cylinders = R"([body.hydrodynamics]
hydrostatics = true
[body.hydrodynamics.cylinders]
at = "(±5.2, 0, 0) m"
diameter = "1.6 m"
draught = "1.13 m"
frequencies = "0.5 rad/s .. 2 rad/s, 3 values"
others = [{ at = "(0, 5.2, 0) m", diameter = "1.2 m", draught = "1.13 m" }]
)";
  const std::string mesh = R"([body.hydrodynamics]
mesh = "inside_out.obj"
reverse = true
frequencies = "0.8 rad/s .. 1.4 rad/s, 3 values"
mesh_tolerance = 0.9
)";
  return {
      in_waves("hydrostatics", "", hydrodynamics("hydrostatics = true\n"), {"hydrostatics"}),
      in_waves("excitation", "", hydrodynamics("excitation = true\n"), {"excitation"}),
      in_waves("turning excitation", "", hydrodynamics(turning), {"excitation.turning"}),
      in_waves("radiation", "", hydrodynamics("radiation = { memory_tolerance = 1e-2 }\n"), {"radiation"}),
      in_waves("second order", "", "[body.second_order]\nfile = \"drift.8\"\nmethod = \"newman\"\n", {"second_order"}),
      in_waves("cylinders", "", cylinders, {"hydrostatics"}),
      in_waves("mesh", "", mesh + "hydrostatics = true\n", {"hydrostatics"}),
      in_waves("mesh in waves and still water", "",
               mesh + "excitation = true\n[body.buoyancy]\nmesh_of_hydrodynamics = true\n",
               {"excitation", "buoyancy"})};
}

std::vector<Example> of_springs() {
  const auto mooring = [](const std::string& kind) { return "[[mooring]]\non = [\"m\"]\n" + kind; };
  const std::string catenary = mooring(
      "kind = \"catenary\"\nfrom = \"(5, 0, 0) m\"\nto = \"(45, 0, -14) m\"\nlength = \"46 m\"\nmass_per_length = \"8 "
      "kg/m\"\ndiameter = \"36 mm\"\naxial_stiffness = \"30 MN\"\non_bed = true\n");
  const auto connector = [](const std::string& kind) {
    return "[[connector]]\nbetween = [\"m\", \"ground\"]\nends = [\"(6, 0, 0) m\", \"(9, 0, 0) m\"]\n" + kind;
  };
  const std::string switching =
      "kind = \"axial\"\nstiffness = \"1 kN/m\"\n[connector.switch]\nwatch = \"m.surge\"\nevery = \"0.5 s\"\nwindow = "
      "\"1 s\"\nhysteresis = \"0.01 Hz\"\nsettings = [{ from = \"0 s\", stiffness = \"2 kN/m\" }]\n";
  return {
      body("linear mooring", "",
           mooring("kind = \"linear\"\nstiffness = { surge = \"1 kN/m\" }\ndamping = { surge = \"1 kN s/m\" }\n"),
           {"mooring"}),
      body("catenary", "", catenary, {"mooring.catenary"}),
      body("catenary by a table", "", catenary + "table = { reach = \"1 m\", tolerance = 1e-2 }\n",
           {"mooring.catenary"}),
      body("axial connector", "", connector("kind = \"axial\"\nstiffness = \"1 kN/m\"\n"), {"connector.axial"}),
      body("switched connector", "", connector(switching), {"connector.switched"}),
      body("tabulated connector", "", connector("kind = \"tabulated\"\ntable = \"tension.csv\"\n"),
           {"connector.axial"}),
      body("cable", "", connector("kind = \"cable\"\nstiffness = \"1 kN/m\"\n"), {"connector.axial"}),
      body("bushing", "", connector("kind = \"bushing\"\nstiffness = \"(1, 1, 1) kN/m\"\n"), {"connector.bushing"})};
}

std::vector<Example> of_joints() {
  const auto joint = [](const std::string& kind) {
    return "[[joint]]\nbetween = [\"ground\", \"m\"]\nat = \"(0, 0, 0) m\"\n" + kind;
  };
  std::vector<Example> out;
  const std::vector<std::pair<const char*, const char*>> bare{
      {"fixed", ""}, {"hinge", "axis = \"y\"\n"},  {"universal", "axis = \"x\"\nsecond_axis = \"y\"\n"},
      {"ball", ""},  {"slider", "axis = \"z\"\n"}, {"planar", "axis = \"z\"\n"}};
  for (const auto& [kind, axis] : bare)
    out.push_back(body(kind, "", joint(fmt::format("kind = \"{}\"\n{}", kind, axis)), {}));
  struct Units {
    const char *kind, *axis, *load, *coordinate, *damping, *stiffness;
  };
  for (const Units& u : {Units{"hinge", "y", "kN m", "rad", "kN m s/rad", "kN m/rad"},
                         Units{"slider", "z", "kN", "m", "kN s/m", "kN/m"}}) {
    const std::string base = joint(fmt::format("kind = \"{}\"\naxis = \"{}\"\n", u.kind, u.axis));
    const auto named = [&](const char* what) { return fmt::format("{} of a {}", what, u.kind); };
    out.push_back(
        body(named("take-off"), "", base + fmt::format("pto = {{ damping = \"1 {}\" }}\n", u.damping), {"pto"}));
    out.push_back(body(named("stops"), "",
                       base + fmt::format("pto = {{ stops = {{ upper = \"0.1 {}\", stiffness = \"10 {}\" }} }}\n",
                                          u.coordinate, u.stiffness),
                       {"pto"}));
    out.push_back(
        body(named("spring"), "", base + fmt::format("spring = {{ file = \"{}_spring.csv\" }}\n", u.kind), {"spring"}));
    out.push_back(body(named("latch"), "", base + "pto = { latch = { hold = \"1 s\" } }\n", {"latch"}));
    out.push_back(body(named("friction"), "", base + fmt::format("friction = {{ dynamic = \"10 {}\" }}\n", u.load),
                       {"friction"}));
    out.push_back(
        body(named("prescribed motion"), "",
             base + fmt::format("prescribed = {{ amplitude = \"0.1 {}\", period = \"5 s\" }}\n", u.coordinate), {}));
  }
  return out;
}

std::vector<Example> of_contacts() {
  const auto contact = [](const std::string& kind) {
    return "[[contact]]\nbetween = [\"m\", \"ground\"]\nrestitution = 0\n" + kind;
  };
  const std::string rods =
      "kind = \"rods\"\nfirst = { from = \"(-1, 0, 0) m\", to = \"(1, 0, 0) m\", diameter = \"0.2 m\" }\n"
      "second = { from = \"(0, -1, -5) m\", to = \"(0, 1, -5) m\", diameter = \"0.2 m\" }\n";
  return {
      body("plane", "", contact("kind = \"plane\"\npoints = \"(0, 0, 0) m\"\nat = \"(0, 0, -10) m\"\nnormal = \"z\"\n"),
           {"contact"}),
      body("box", "",
           contact("kind = \"box\"\npoints = \"(0, 0, 0) m\"\nfrom = \"(-1, -1, -9) m\"\nto = \"(1, 1, -8) m\"\n"),
           {"contact"}),
      body("rods", "", contact(rods), {"contact"})};
}

std::vector<Example> of_members() {
  return {
      in_waves("drag", "", member("drag = { cd = 1.0 }\n"), {"drag"}),
      in_waves("Morison", "", member(morison), {"morison"}),
      in_waves("Morison, wet in part", "",
               member("morison = { cd = 1.0, ca = 1.0, partial_immersion = true, pieces = 3 }\n", 0.5), {"morison"}),
      in_waves("loads of a member", "", member(morison + "loads = true\n"), {"morison"}),
      in_waves("ends of members", "", member("ends = { at = [\"from\"], pressure = true, cd = 1.0, ca = 0.64 }\n"),
               {"ends"}),
      in_waves("slamming", "", member("slamming = { model = \"goda\", pieces = 3 }\n", 0.5), {"slamming"}),
      in_waves("current", "", "[current]\nvelocity = \"(0.5, 0, 0) m/s\"\n" + member(morison), {"morison"})};
}

/// A line from z = −1 m, with keys of its own.
Example line(const std::string& name, const std::string& keys, const std::string& more = "",
             const std::string& solve = "") {
  return {name,
          froude_test::water + waves +
              "[[line]]\nname = \"l\"\nfrom = \"(0, 0, -1) m\"\nlength = \"4 m\"\nsegments = 4\nmass_per_length = \"14 "
              "kg/m\"\n" +
              keys + more + ask + solve,
          {},
          1};
}

std::vector<Example> of_lines() {
  const std::string elastic = "axial_stiffness = \"1 MN\"\n", wide = "diameter = \"0.12 m\"\n";
  const std::string second =
      "[[line]]\nname = \"k\"\nfrom = \"(2, 0, -1) m\"\nlength = \"4 m\"\nsegments = "
      "4\nmass_per_length = \"14 kg/m\"\n";
  const std::string junction =
      "[[junction]]\nname = \"j\"\nmass = \"10 kg\"\ndiameter = \"0.2 m\"\nbuoyancy = "
      "true\npartial_immersion = true\nmorison = { cd = 0.5 }\n";
  const std::string head = froude_test::water + waves + "[[line]]\nfrom = \"(0, 0, -1) m\"\n";
  const std::string tail =
      "[[line]]\nfrom = \"(5, 0, 0) m\"\nto = \"(9, 0, -5) m\"\non = { from = \"m\" }\nlength = \"7 m\"\nsegments = "
      "4\nmass_per_length = \"14 kg/m\"\naxial_stiffness = \"1 MN\"\n";
  Example fastened = body("a line on a body", "", tail, {"lines"});
  fastened.lines = 1;
  return {
      line("line", ""),
      {"parts of a line",
       head + "[[line.part]]\nlength = \"2 m\"\nsegments = 2\nmass_per_length = \"14 kg/m\"\n" + ask,
       {},
       1},
      {"links of a line", head + "[[line.link]]\nlength = \"2 m\"\nmass = \"14 kg\"\n" + ask, {}, 1},
      line("clamp", "bending_stiffness = \"100 N m^2\"\nclamp = { from = \"(0, 0, -1)\" }\n"),
      line("tension only", elastic + "tension_only = true\n"),
      line("catenary segments", elastic + "to = \"(2, 0, -1) m\"\ncatenary_segments = true\n", "",
           "integrator = { name = \"generalized_alpha\", lines = \"generalized_alpha\" }\n"),
      line("buoyancy of a line", wide + "buoyancy = true\n"),
      line("a line wet in part", wide + "buoyancy = true\npartial_immersion = true\n"),
      line("Morison on a line", wide + "morison = { cd = 1.0, ca = 1.0 }\n"),
      line("waves at one place", wide + "morison = { cd = 1.0, ca = 1.0 }\nwaves = { at = \"(1, 0, -1) m\" }\n"),
      line("a cylinder of its own at each bob",
           "bob_cylinders = { length = \"1 m\", diameter = \"50 mm\", cd = 2.0, ca = 1.0, relative_acceleration = "
           "true, componentwise = true }\n"),
      line("damping of a line", "damping = { quadratic = \"0.1 kg/m\", componentwise = true }\n"),
      line("growth", wide + "buoyancy = true\ngrowth = { thickness = \"10 mm\", density = \"1200 kg/m^3\" }\n"),
      line("bed", wide + "bed = { stiffness = \"3 MPa/m\" }\n"),
      line("release",
           "release = { node = 4, at = \"(3, 0, -3) m\", also = [{ node = 2, at = \"(1.2, 0, -2.2) m\" }] }\n"),
      line("load on a node", "load = [{ node = 2, force = \"(1, 0, 0) N\", until = \"1 s\" }]\n"),
      line("start",
           "start = { at = [\"(0.1, 0, -1.995) m\", \"(0.2, 0, -2.99) m\", \"(0.3, 0, -3.985) m\", \"(0.4, 0, -4.98) "
           "m\"] }\n"),
      line("prescribed end", "prescribed = { end = \"from\", file = \"path.csv\" }\n"),
      line("snaps", elastic + "tension_only = true\nsnaps = { slack_below = \"1 N\", snap_above = \"1 kN\" }\n"),
      line("Lyapunov exponent", "lyapunov = { from = \"0.5 s\" }\n"),
      line("junction", "on = { to = \"j\" }\n", second + "on = { to = \"j\" }\n" + junction),
      fastened,
  };
}

std::vector<Example> of_seas() {
  const std::string cut = "components = { equal_energy = 8 }\n", hs = "hs = \"0.5 m\"\n", tp = "tp = \"4 s\"\n";
  const std::vector<std::pair<std::string, std::string>> random{
      {"jonswap", hs + tp},
      {"jonswap-dnv", hs + tp},
      {"fully-developed", "wind = \"8 m/s\"\n"},
      {"pierson-moskowitz", hs + tp},
      {"tma", hs + tp},
      {"ochi-hubble",
       "hs_low = \"0.5 m\"\ntp_low = \"6 s\"\nlambda_low = 2\nhs_high = \"0.4 m\"\ntp_high = \"4 s\"\nlambda_high = "
       "1\n"},
      {"torsethaugen", hs + tp},
      {"wallops", hs + tp},
      {"donelan", "wind = \"12 m/s\"\n" + tp},
      {"swell", hs + tp + "width = \"0.1 rad/s\"\n"},
      {"measured", "file = \"elevation.csv\"\nsegment = \"20 s\"\n"},
      {"tabulated", "file = \"spectrum.csv\"\n"}};
  std::vector<Example> out{
      sea("regular", "kind = \"regular\"\nheight = \"0.5 m\"\nperiod = \"4 s\"\n"),
      sea("components", "kind = \"components\"\nfile = \"waves.csv\"\n"),
      sea("components of second order", "kind = \"components\"\nfile = \"waves.csv\"\nsecond_order = true\n"),
      sea("record",
          "kind = \"record\"\nfile = \"elevation.csv\"\ngauge = \"(-5, 0, 0) m\"\nlowest = \"0.7 rad/s\"\nhighest = "
          "\"2 "
          "rad/s\"\ntaper = \"2 s\"\n"),
      sea("trains",
          "kind = \"trains\"\ntrain = [{ height = \"0.5 m\", period = \"4 s\" }, { height = \"0.5 m\", period = \"3 "
          "s\", "
          "from = \"0.5 s\", fade = \"1 s\" }]\n"),
      sea("focused packets",
          "kind = \"focused_packets\"\nfile = \"waves.csv\"\nfocus = { position = \"(0, 0, 0) m\", time = \"1 s\" }\n"),
      sea("tank",
          "kind = \"tank\"\nlength = \"20 m\"\nwavemaker = { kind = \"piston\", file = \"paddle.csv\", lowest = \"1 "
          "rad/s\", highest = \"4 rad/s\", active_absorption = true }\n"),
      sea("crest and kinematics", "kind = \"jonswap\"\n" + hs + tp + cut +
                                      "crest = { height = \"0.4 m\", position = \"(0, 0, 0) m\", time = \"1 s\" }\n"
                                      "kinematics = { above_still_water = \"wheeler\" }\n")};
  std::string parts = "kind = \"sum\"\n" + cut;
  for (const auto& [kind, keys] : random) {
    const std::string named = fmt::format("kind = \"{}\"\n{}", kind, keys);
    out.push_back(sea(kind, named + cut));
    out.push_back(sea(kind + " of second order", named + cut + "second_order = true\n"));
  }
  for (const auto& [kind, keys] : random)
    parts += fmt::format("[[waves.part]]\nkind = \"{}\"\nheading = \"0 deg\"\n{}", kind, keys);
  out.push_back(sea("sum", parts));
  out.push_back(sea("sum of second order", "second_order = true\n" + parts));
  for (const char* spreading : {"kind = \"cos2s\", s = 10", "kind = \"mitsuyasu\", s_max = 10",
                                "kind = \"cosn\", n = 2", "kind = \"wrapped-normal\", deviation = \"20 deg\"",
                                "kind = \"von-mises\", kappa = 4", "kind = \"tabulated\", file = \"spreading.csv\""})
    out.push_back(sea(spreading, "kind = \"jonswap\"\n" + hs + tp + cut + "spreading = { " + spreading + " }\n"));
  return out;
}

std::vector<Example> of_answers() {
  const std::string periods = "periods = \"3 s .. 6 s, 2 values\", heading = \"0 deg\"";
  return {{"what is asked",
           froude_test::water + waves + module + hydrodynamics("excitation = true\nhydrostatics = true\n") +
               member("drag = { cd = 1.0 }\n") +
               "[[probe]]\nat = \"(0, 0, 0) m\"\n[ask]\nrun = { duration = \"2 s\", every = \"0.05 s\" }\nrao = { " +
               periods +
               ", drag = { height = \"1 m\" } }\nmodes = {}\nstability = { periods = \"4 s .. 6 s, 2 values\", heights "
               "= \"1 m .. 2 m, 2 values\", branch = [{ height = \"1 m\" }, { period = \"5 s\" }] "
               "}\nfield = { period = \"5 s\", x = \"0 m .. 9 m, 2 values\", y = \"0 m .. 9 m, 2 values\", "
               "pressure = true, body_drift = true }\n"
               "waves = { duration = \"2 s\", every = \"0.5 s\" }\nuncompressed = true\n"
               "[solve]\naccept_error = true\nstep = \"0.05 s\"\nintegrator = { name = \"generalized_alpha\" }\n",
           {"hydrostatics", "excitation", "drag"}}};
}

}  // namespace

Example without_effects() { return body("nothing", "", "", {}); }

const std::vector<Example>& examples() {
  static const std::vector<Example> all = [] {
    std::vector<Example> out;
    for (auto* make :
         {of_body, of_potential_flow, of_springs, of_joints, of_contacts, of_members, of_lines, of_seas, of_answers})
      for (Example& one : make()) out.push_back(std::move(one));
    return out;
  }();
  return all;
}

Example of_responses_alone() {
  return body(
      "sections", "",
      "[body.hydrodynamics]\nmesh = \"inside_out.obj\"\nreverse = true\nfrequencies = \"0.8 rad/s .. 1.4 rad/s, "
      "3 values\"\nhydrostatics = true\n[[body.section]]\nname = \"mid\"\nat = \"(0, 0, 0) m\"\nmass = \"4544 "
      "kg\"\ncentre_of_gravity = \"(1, 0, 1.31) m\"\nradii_of_gyration = \"(1, 1, 1) m\"\naccept_error = 9\n",
      {});
}

std::vector<Example> held_by_laws() {
  const std::string slider = R"([[joint]]
between = ["ground", "m"]
at = "(0, 0, 0) m"
kind = "slider"
axis = "x"
friction = { dynamic = "1 kN" }
)";
  const std::string plane = R"([[contact]]
between = ["m", "ground"]
kind = "plane"
points = "(±4, ±4, 0) m"
at = "(0, 0, 0) m"
normal = "z"
restitution = 0
friction = 0.1
)";
  const std::string weight = "weight = true\n", moves = "initial_velocity = { surge = \"4 m/s\" }\n";
  std::string first_of_many = slider;  // so many that their factors are sparse, and with friction anew in each step
  first_of_many.replace(first_of_many.find("\"m\""), 3, "\"m1\"");
  const std::string copies = "copies = { count = 9, step = \"(13, 0, 0) m\" }\n";
  return {body("friction that slips", moves, slider, {"friction"}),
          body("friction that holds one of many", copies, first_of_many, {"friction"}),
          body("contacts that are closed", weight, plane, {"weight", "contact"}),
          body("contacts that slip", weight + moves, plane, {"weight", "contact"})};
}

namespace {

/// A box of 4 m x 4 m, from 1 m under water to 1 m above, each face in four: OBJ, whose normals point inwards.
std::string inside_out_box() {
  std::string vertices, faces;
  int count = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0})
      for (const double u : {-1.0, 0.0})
        for (const double v : {-1.0, 0.0}) {
          for (const auto& [du, dv] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
            std::array<double, 3> at{};
            at[axis] = side;
            at[(axis + 1) % 3] = u + du;
            at[(axis + 2) % 3] = v + dv;
            vertices += fmt::format("v {} {} {}\n", 2 * at[0], 2 * at[1], at[2]);
          }
          const int n = count += 4;
          faces += side > 0 ? fmt::format("f {} {} {} {}\n", n, n - 1, n - 2, n - 3)
                            : fmt::format("f {} {} {} {}\n", n - 3, n - 2, n - 1, n);
        }
  return vertices + faces;
}

}  // namespace

Files::Files() : folder_(std::filesystem::path(testing::TempDir()) / fmt::format("froude_effects_{}", ::getpid())) {
  std::filesystem::create_directories(folder_);
  std::filesystem::copy_file(froude_test::examples / "data/pontoon1.nc", folder_ / "pontoon1.nc",
                             std::filesystem::copy_options::overwrite_existing);
  const auto write = [&](const char* name, const std::string& text) { std::ofstream(folder_ / name) << text; };
  write("tension.csv", "elongation [m],tension [N]\n-1,-1000\n1,1000\n");
  write("slider_spring.csv", "stroke [m],force [N]\n-1,-1000\n1,1000\n");
  write("hinge_spring.csv", "angle [rad],moment [N m]\n-1,-1000\n1,1000\n");
  write("inside_out.obj", inside_out_box());
  write("waves.csv", "period [s],amplitude [m],phase [rad]\n4,0.05,0\n5,0.05,1\n");
  write("drift.8", "4 0 0 1 1 0 1 0\n6 0 0 1 2 0 2 0\n");
  write("path.csv", "time [s],x [m],y [m],z [m]\n0,0,0,-1\n1,0.1,0,-1\n3,0.3,0,-1\n");
  write("spectrum.csv", "omega [rad/s],density [m^2 s/rad]\n0.5,0\n1,0.05\n1.5,0.02\n2,0\n");
  write("spreading.csv", "direction [deg],density [1/rad]\n-30,0\n0,1.90986\n30,0\n");
  std::string paddle = "time [s],displacement [m]\n", elevation = "time [s],elevation [m]\n";
  for (int i = 0; i < 800; ++i) {
    const double t = 0.1 * i;
    paddle += fmt::format("{:.1f},{:.6f}\n", t, 0.02 * std::sin(2 * t));
    elevation += fmt::format("{:.1f},{:.6f}\n", t, 0.2 * std::sin(1.5 * t) + 0.1 * std::sin(1.9 * t));
  }
  write("paddle.csv", paddle);
  write("elevation.csv", elevation);
}

Files::~Files() { std::filesystem::remove_all(folder_); }

}  // namespace effects
