// Fields of scenes: bodies that move take what their dampers take, however coarse the table of their coefficients is.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "answers/answers.hpp"
#include "apps/compile/scenes.hpp"
#include "support/hull_meshes.hpp"
#include "support/scratch.hpp"

namespace free_surface_test {
namespace {

using namespace froude;

/// Two buoys 8 m apart, near their resonance in heave; the table has two frequencies.
scene::Scene two_buoys(const std::string& further) {
  return froude_test::parse(R"(schema = 1
[water]
density = "1000 kg/m^3"
depth = "10 m"
[[body]]
name = "c"
copies = { count = 2, step = "(8, 3, 0) m" }
mass = "12566.4 kg"
free = ["surge", "heave"]
centre_of_gravity = "(0, 0, -0.5) m"
radii_of_gyration = "(1, 1, 1) m"
[body.hydrodynamics]
excitation = true
radiation = {}
hydrostatics = true
[body.hydrodynamics.cylinders]
at = "(0, 0, 0) m"
diameter = "4 m"
draught = "1 m"
frequencies = "1 rad/s .. 3 rad/s, 2 values"
)" + further + R"([ask]
field = { period = "3 s", heading = "25 deg", x = "20 m .. 30 m, 2 values", y = "20 m .. 30 m, 2 values" }
accuracy = 1e-3
)");
}

TEST(FieldOfAScene, HasBodiesThatTakeNothingWhereNothingDampsThem) {
  const FreeSurface f = free_surface(two_buoys(""));
  EXPECT_GT(f.power_sent_out, 1000);                            // W/m^2: waves of 4.9 kW/m at all
  EXPECT_NEAR(f.power_taken / f.power_sent_out, 0, 10 * 1e-4);  // coefficients of 1e-4, ten times that at a resonance
  EXPECT_GT(f.drift_x, 0);
}

TEST(FieldOfAScene, HasBodiesThatTakeWhatDampersTake) {
  const FreeSurface f = free_surface(two_buoys("[[damping]]\non = \"c1\"\nlinear = { heave = \"5000 N s/m\" }\n"));
  EXPECT_GT(f.power_taken, 0.02 * f.power_sent_out);
}

/// A drum of 16 m diameter and 4 m draught that nothing damps, as a mesh of few panels, in waves of 0.5 rad/s.
scene::Scene free_drum(const std::string& of_field, const std::string& damping = {}) {
  const auto mesh = support::cylinder_mesh({0, 0}, 8, -4, 1, 16);
  const std::filesystem::path file =
      support::scratch_folder() / (std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + ".obj");
  std::ofstream obj(file);
  for (const auto& v : mesh.vertices) obj << fmt::format("v {:.12g} {:.12g} {:.12g}\n", v.x(), v.y(), v.z());
  for (const auto& t : mesh.triangles) obj << fmt::format("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
  obj.close();
  return froude_test::parse(fmt::format(R"(schema = 1
[water]
density = "1025 kg/m^3"
depth = "30 m"
[[body]]
name = "drum"
mass = "802.9 t"
centre_of_gravity = "(0, 0, 1) m"
radii_of_gyration = "(5, 5, 5.5) m"
[body.hydrodynamics]
mesh = "{}"
frequencies = "0.4 rad/s .. 0.6 rad/s, 3 values"
mesh_tolerance = 0.1
excitation = true
radiation = {{}}
hydrostatics = true
{}[ask]
field = {{ omega = "0.5 rad/s", heading = "0 deg", x = "40 m .. 80 m, 2 values", y = "-41 m .. 49 m, 2 values"{} }}
accuracy = 0.1
)",
                                        file.string(), damping, of_field));
}

TEST(FieldOfAScene, RefusesADriftWhosePowerNothingTakes) {
  try {
    free_surface(free_drum(""));
    ADD_FAILURE() << "accepted";
  } catch (const hydro::InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("the mean drift is known to"));
    EXPECT_THAT(error.what(), testing::HasSubstr("accepted_drift_error"));
  }
}

TEST(FieldOfAScene, TellsTheErrorOfADriftThatIsAccepted) {
  const FreeSurface f = free_surface(free_drum(", accepted_drift_error = 100"));
  // Nothing damps the drum: all that it takes is error, as a force over the drift.
  const double wavenumber = 0.0334;  // of 0.5 rad/s over 30 m, to 1 %: ω² = gk tanh kh
  const double force = std::abs(f.power_taken) * wavenumber / 0.5;
  const double size = std::max(std::hypot(f.drift_x, f.drift_y), f.power_sent_out * wavenumber / 0.5);
  EXPECT_NEAR(f.body_drift_error, force / size, 0.03 * force / size);
  EXPECT_THAT(f.notes, testing::Contains(testing::HasSubstr("mean drift and power are known to")));
}

}  // namespace
}  // namespace free_surface_test
