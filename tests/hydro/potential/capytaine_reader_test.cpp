#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>
#include <hdf5_hl.h>
#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/lsan_interface.h>
#endif

#include <fstream>
#include <functional>

#include "capytaine_file.hpp"
#include "hydro/base/error.hpp"

namespace capytaine_reader_test {
namespace {

using froude_test::CapytaineFile;
using froude_test::largest_relative_error;
using froude_test::listed;
using froude_test::TemporaryFolder;
using hydro::InputError;
using hydro::potential::Coefficients;
using hydro::potential::read;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr double inf = std::numeric_limits<double>::infinity();

Coefficients written_and_read(const CapytaineFile& file) {
  TemporaryFolder folder;
  file.write(folder / "data.bin");  // no name helps: formats are told by content
  return read(folder / "data.bin");
}

/// Numbers pass through the file as doubles; only a computed ω may be off by a few roundings.
void expect_same_numbers(const Coefficients& c, const Coefficients& expected, double omega_error = 0) {
  ASSERT_EQ(c.omega.size(), expected.omega.size());
  for (std::size_t k = 0; k < c.omega.size(); ++k)
    EXPECT_NEAR(c.omega[k], expected.omega[k], omega_error * expected.omega[k]);
  EXPECT_EQ(c.heading, expected.heading);
  EXPECT_EQ(largest_relative_error(c.A, expected.A), 0);
  EXPECT_EQ(largest_relative_error(c.B, expected.B), 0);
  EXPECT_EQ(largest_relative_error(listed(c.A_zero), listed(expected.A_zero)), 0);
  EXPECT_EQ(largest_relative_error(listed(c.A_inf), listed(expected.A_inf)), 0);
  EXPECT_EQ(largest_relative_error(listed(c.C), listed(expected.C)), 0);
  EXPECT_EQ(largest_relative_error(c.X, expected.X), 0);
}

TEST(CapytaineReader, TakesBothContainersAndBothOrdersOfAxes) {
  for (const bool classic : {true, false})
    for (const bool version2 : {true, false}) {
      const CapytaineFile file{.classic = classic, .version2 = version2};
      expect_same_numbers(written_and_read(file), file.expected());
    }
}

TEST(CapytaineReader, ReadsTheComplexAxisByItsLabelsAndConjugates) {
  // (P7): a force that lags in the file's e^{−iωt} leads by as much in ours; expected() holds ours.
  const CapytaineFile file{.im_first = true};
  expect_same_numbers(written_and_read(file), file.expected());
}

TEST(CapytaineReader, AddsTheTwoPartsOfTheExcitationWhereTheSumIsAbsent) {
  const CapytaineFile file{.in_parts = true};
  const auto c = written_and_read(file);
  // 1000 is added to one part and taken from the other: the sum keeps 1e-13 of what is there, relative to the largest.
  EXPECT_LT(froude_test::relative_difference(c.X, file.expected().X), 1e-14);
  EXPECT_THAT(c.notes, Contains(HasSubstr("sum of Froude_Krylov_force and diffraction_force")));
}

class CapytaineFrequency : public ::testing::TestWithParam<const char*> {};
TEST_P(CapytaineFrequency, MayBeTheAxisUnderAnyOfItsMeasures) {
  for (const bool says_omega : {true, false}) {
    const CapytaineFile file{.measure = GetParam(), .says_omega = says_omega};
    expect_same_numbers(written_and_read(file), file.expected(), says_omega ? 0 : 2e-15);
  }
}
INSTANTIATE_TEST_SUITE_P(Measures, CapytaineFrequency,
                         ::testing::Values("omega", "freq", "period", "wavenumber", "wavelength"));

TEST(CapytaineReader, OrdersBodiesAsTheModesDoAndFindsTheirPointsByName) {
  const CapytaineFile file{.body = {.bodies = 3}, .version2 = false, .name = {"west", "east", "deep__one"}};
  const auto c = written_and_read(file);
  expect_same_numbers(c, file.expected());
  ASSERT_EQ(c.bodies(), 3);
  EXPECT_EQ(c.body[0].name, "west");
  EXPECT_EQ(c.body[2].name, "deep__one");
  for (std::size_t b = 0; b < 3; ++b) {
    const Eigen::Vector3d p(10.0 * double(b + 1), 0.5, -0.25);
    EXPECT_EQ(c.body[b].reference_point, p);
    EXPECT_EQ(c.body[b].centre_of_gravity, p);
    EXPECT_EQ(c.body[b].displaced_volume, 5.0 * double(b + 1)) << "displaced mass over density";
  }
}

TEST(CapytaineReader, NamesASingleBodyFromEitherVariable) {
  EXPECT_EQ(written_and_read({.version2 = true}).body[0].name, "old buoy");
  EXPECT_EQ(written_and_read({.version2 = false}).body[0].name, "new buoy");
  EXPECT_THAT(written_and_read({.version2 = true}).notes, Contains(HasSubstr("about which point")));
}

TEST(CapytaineReader, TakesWaterFromTheFileAndTellsWhoAskedForAnother) {
  TemporaryFolder folder;
  CapytaineFile file;
  file.water = {1025, 9.8, hydro::WaterDepth::infinite()};
  file.write(folder / "a.nc");
  const auto c = read(folder / "a.nc", {1000, 9.8, hydro::WaterDepth::from_metres(50), {}, {}});
  EXPECT_EQ(c.water.density, 1025);
  EXPECT_EQ(c.water.gravity, 9.8);
  EXPECT_TRUE(c.water.depth.is_infinite());
  EXPECT_THAT(c.notes, Contains(HasSubstr("density 1000 was asked for")));
  EXPECT_THAT(c.notes, Contains(HasSubstr("depth 50 was asked for")));
  EXPECT_THAT(c.notes, ::testing::Not(Contains(HasSubstr("gravity"))));
}

TEST(CapytaineReader, RefusesNanNamingVariableFrequencyAndMode) {
  const auto refused = [](CapytaineFile file) { return [file] { written_and_read(file); }; };
  // The middle number of five frequencies is at the third, 0.3 rad/s.
  EXPECT_THAT(refused({.nan_in = "added_mass"}),
              ThrowsMessage<InputError>(AllOf(HasSubstr("added_mass at omega = 0.3 rad/s"), HasSubstr("of body 1"))));
  EXPECT_THAT(refused({.nan_in = "radiation_damping"}),
              ThrowsMessage<InputError>(HasSubstr("radiation_damping at omega = 0.3 rad/s")));
  EXPECT_THAT(refused({.nan_in = "hydrostatic_stiffness"}),
              ThrowsMessage<InputError>(HasSubstr("hydrostatic_stiffness")));
  EXPECT_THAT(
      refused({.omega = {0.3, 0.7, 1.1}, .nan_in = "excitation_force"}),
      ThrowsMessage<InputError>(AllOf(HasSubstr("excitation_force at omega = 0.3 rad/s"), HasSubstr("heading"))));
}

TEST(CapytaineReader, LeavesOutAFrequencyAtWhichNothingWasSolvedAndSaysSo) {
  const CapytaineFile file{.unsolved = 0.7};
  const auto c = written_and_read(file);
  expect_same_numbers(c, file.expected());
  EXPECT_EQ(c.omega.size(), 2u);
  EXPECT_THAT(c.notes, Contains(AllOf(HasSubstr("omega = 0.7 rad/s"), HasSubstr("left out"))));
  EXPECT_THAT([] { written_and_read({.omega = {0.7}, .unsolved = 0.7}); },
              ThrowsMessage<InputError>(HasSubstr("no frequency was solved")));
}

TEST(CapytaineReader, RefusesWhatItCannotMean) {
  const auto refused = [](CapytaineFile file, const char* rule) {
    EXPECT_THAT([&] { written_and_read(file); }, ThrowsMessage<InputError>(HasSubstr(rule)));
  };
  refused({.omega = {0.3, 0.7, 0.3}}, "0.3 rad/s is there twice");
  refused({.omega = {0.3, -0.7}}, "must be zero, positive or infinite");
  refused({.omega = {0, inf}}, "no finite, positive frequency");
  refused({.omega = {inf, 1, inf}}, "twice");
  refused({.heading = {0.5, 0.5}}, "heading 28.6479 deg is there twice");
  refused({.forward_speed = 2}, "forward speed of 2 m/s");
}

TEST(CapytaineReader, RefusesModesThatAreNoRigidSix) {
  TemporaryFolder folder;
  const auto write = [&](const std::vector<std::string>& dof) {
    froude_test::NetcdfFile file(folder / "m.nc", NC_64BIT_OFFSET);
    const std::map<std::string, std::size_t> length{
        {"omega", 1}, {"influenced_dof", dof.size()}, {"radiating_dof", dof.size()}};
    const std::vector<double> values(dof.size() * dof.size(), 1.0);
    file.texts("influenced_dof", "influenced_dof", dof, true);
    file.texts("radiating_dof", "radiating_dof", dof, true);
    file.numbers("added_mass", {"omega", "influenced_dof", "radiating_dof"}, values, length);
    file.numbers("radiation_damping", {"omega", "influenced_dof", "radiating_dof"}, values, length);
    file.numbers("omega", {"omega"}, {1.0}, length);
    for (const char* name : {"rho", "g", "water_depth"}) file.numbers(name, {}, {10.0}, length);
  };
  const auto expect = [&](const char* rule) {
    EXPECT_THAT([&] { read(folder / "m.nc"); }, ThrowsMessage<InputError>(HasSubstr(rule)));
  };
  write({"Surge", "Sway", "Heave", "Roll", "Pitch"});
  expect("\"yaw\" is missing from influenced_dof");
  write({"Surge", "Sway", "Heave", "Roll", "Pitch", "Yaw", "bulge"});
  expect("\"bulge\" in influenced_dof is no rigid-body mode");
  write({"Surge", "Sway", "Heave", "Roll", "Pitch", "Yaw", "heave"});
  expect("twice");
  write({"a__Surge", "a__Sway", "a__Heave", "a__Roll", "a__Pitch", "a__Yaw", "b__Heave"});
  expect("\"b__surge\" is missing");
}

TEST(CapytaineReader, RefusesASweepOverAnotherParameter) {
  TemporaryFolder folder;
  {
    froude_test::NetcdfFile file(folder / "s.nc", NC_64BIT_OFFSET);
    const std::vector<std::string> dof{"Surge", "Sway", "Heave", "Roll", "Pitch", "Yaw"};
    const std::map<std::string, std::size_t> length{
        {"water_depth", 2}, {"omega", 1}, {"influenced_dof", 6}, {"radiating_dof", 6}};
    file.texts("influenced_dof", "influenced_dof", dof, true);
    file.texts("radiating_dof", "radiating_dof", dof, true);
    const std::vector<std::string> axes{"water_depth", "omega", "influenced_dof", "radiating_dof"};
    file.numbers("added_mass", axes, std::vector<double>(72, 1.0), length);
    file.numbers("radiation_damping", axes, std::vector<double>(72, 1.0), length);
    file.numbers("omega", {"omega"}, {1.0}, length);
    file.numbers("water_depth", {"water_depth"}, {10.0, 20.0}, length);
    file.numbers("rho", {}, {1000.0}, length);
    file.numbers("g", {}, {9.81}, length);
  }
  EXPECT_THAT([&] { read(folder / "s.nc"); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("water_depth"), HasSubstr("2 numbers"))));
}

TEST(CapytaineReader, RefusesAFileThatIsCutShortAnywhere) {
  for (const bool classic : {true, false}) {
    TemporaryFolder folder;
    CapytaineFile{.classic = classic, .version2 = false}.write(folder / "whole.nc");
    std::ifstream in(folder / "whole.nc", std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
    for (const double part : {0.02, 0.1, 0.3, 0.6, 0.9, 0.99}) {
      const auto cut = folder.write("cut.nc", bytes.substr(0, static_cast<std::size_t>(part * double(bytes.size()))));
      EXPECT_THAT([&] { read(cut); }, ThrowsMessage<InputError>(AllOf(HasSubstr("cut.nc"), HasSubstr("cut short"))))
          << (classic ? "classic" : "HDF5") << " cut at " << part;
    }
  }
}

TEST(CapytaineReader, RefusesADamagedHeader) {
  TemporaryFolder folder;
  folder.write("bad.nc", std::string("CDF\x01\0\0\0\0\0\0\0\x0a\x7f\xff\xff\xff", 16));
  EXPECT_THAT([&] { read(folder / "bad.nc"); }, ThrowsMessage<InputError>(HasSubstr("netCDF header")));
}

/// What HDF5 allocates while this lives is no leak of ours: of a file that it gives up it keeps a block of 56 bytes,
/// one of those that it has in stock, which are given back first.
struct NoLeakOfOurs {
#ifdef __SANITIZE_ADDRESS__
  NoLeakOfOurs() {
    H5garbage_collect();
    __lsan_disable();
  }
  ~NoLeakOfOurs() { __lsan_enable(); }
#else
  ~NoLeakOfOurs() {}  // not trivial: a variable of it is no unused one
#endif
};

/// A file whose axis "complex" was changed through HDF5, which knows nothing of what netCDF asks of axes.
std::filesystem::path with_axis(const TemporaryFolder& folder, const std::string& name,
                                const std::function<void(hid_t)>& change) {
  CapytaineFile{.classic = false}.write(folder / name);
  const hid_t file = H5Fopen((folder / name).c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  change(file);
  H5Fclose(file);
  return folder / name;
}

TEST(CapytaineReader, RefusesAxesThatNoLongerBelongToTheirVariables) {
  const NoLeakOfOurs meanwhile;
  TemporaryFolder folder;
  const auto numbered = [](int number) {
    return [number](hid_t file) { H5LTset_attribute_int(file, "complex", "_Netcdf4Dimid", &number, 1); };
  };
  const auto of_length = [](hsize_t length) {
    return [length](hid_t file) {
      int number = 0;
      H5LTget_attribute_int(file, "complex", "_Netcdf4Dimid", &number);
      H5Ldelete(file, "complex", H5P_DEFAULT);
      const std::vector<double> values(length);
      H5LTmake_dataset_double(file, "complex", 1, &length, values.data());
      H5LTset_attribute_int(file, "complex", "_Netcdf4Dimid", &number, 1);
      const hid_t axis = H5Dopen(file, "complex", H5P_DEFAULT);
      H5DSset_scale(axis, "complex");
      H5Dclose(axis);
    };
  };
  const std::pair<const char*, std::function<void(hid_t)>> changes[] = {
      {"number.nc", numbered(77)},
      {"shorter.nc", of_length(1)},
      {"longer.nc", of_length(3)},
      {"huge.nc", of_length(100000)},
      {"gone.nc", [](hid_t file) { H5Ldelete(file, "complex", H5P_DEFAULT); }}};
  for (const auto& [name, change] : changes) {
    const auto path = with_axis(folder, name, change);
    EXPECT_THAT([&] { read(path); }, ThrowsMessage<InputError>(HasSubstr(name))) << name;
  }
}

}  // namespace
}  // namespace capytaine_reader_test
