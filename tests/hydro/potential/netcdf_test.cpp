#include "hydro/io/netcdf.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netcdf.h>

#include "hydro/base/error.hpp"
#include "smooth_body.hpp"

namespace netcdf_test {
namespace {

using froude_test::TemporaryFolder;
using hydro::InputError;
using hydro::io::classic_netcdf_size;
using hydro::io::NetcdfReader;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

/// `variables` record variables of three short integers along an unlimited axis of `records`, and one fixed variable.
std::filesystem::path write_records(const TemporaryFolder& folder, int mode, int variables, std::size_t records) {
  const auto path = folder / "records.nc";
  int file = 0, dimension[2] = {}, fixed = 0;
  nc_create(path.c_str(), NC_CLOBBER | mode, &file);
  nc_def_dim(file, "time", NC_UNLIMITED, &dimension[0]);
  nc_def_dim(file, "three", 3, &dimension[1]);
  nc_put_att_text(file, NC_GLOBAL, "history", 7, "written");
  nc_def_var(file, "fixed", NC_DOUBLE, 1, &dimension[1], &fixed);
  std::vector<int> ids(static_cast<std::size_t>(variables));
  for (std::size_t v = 0; v < ids.size(); ++v)
    nc_def_var(file, ("v" + std::to_string(v)).c_str(), NC_SHORT, 2, dimension, &ids[v]);
  nc_enddef(file);
  const double numbers[3] = {1, 2, 3};
  nc_put_var_double(file, fixed, numbers);
  const std::vector<double> values(3 * records, 5.0);
  for (const int id : ids) {
    const std::size_t start[2] = {0, 0}, count[2] = {records, 3};
    nc_put_vara_double(file, id, start, count, values.data());
  }
  nc_close(file);
  return path;
}

TEST(ClassicNetcdf, PromisesTheSizeThatTheLibraryWrites) {
  TemporaryFolder folder;
  for (const int mode : {0, NC_64BIT_OFFSET, NC_64BIT_DATA})
    for (const int variables : {0, 1, 2})
      for (const std::size_t records : {1u, 4u}) {
        const auto path = write_records(folder, mode, variables, records);
        const auto size = std::filesystem::file_size(path), promised = classic_netcdf_size(path);
        EXPECT_LE(promised, size);
        EXPECT_LT(size - promised, 4u) << "no more than padding to four bytes";
      }
}

TEST(NetcdfReader, RefusesToFillWhatIsMissingWithZeros) {
  TemporaryFolder folder;
  const auto path = write_records(folder, NC_64BIT_OFFSET, 2, 4);
  std::filesystem::resize_file(path, classic_netcdf_size(path) - 1);
  EXPECT_THAT([&] { NetcdfReader{path}; }, ThrowsMessage<InputError>(HasSubstr("its header promises")));
}

TEST(NetcdfReader, ArrangesAxesByName) {
  TemporaryFolder folder;
  const NetcdfReader file(write_records(folder, 0, 1, 2));
  EXPECT_THAT(file.axes("v0"), ElementsAre("time", "three"));
  EXPECT_THAT(file.arranged("fixed", {{"three", 3}}), ElementsAre(1, 2, 3));
  EXPECT_THAT(file.arranged("fixed", {{"absent", 1}, {"three", 3}}), ElementsAre(1, 2, 3));
  EXPECT_EQ(file.text_attribute("history"), "written");
  EXPECT_EQ(file.text_attribute("nothing"), "");
  EXPECT_THAT(
      [&] {
        file.arranged("v0", {{"three", 3}});
      },
      ThrowsMessage<InputError>(HasSubstr("2 values of \"time\"")));
  EXPECT_THAT([&] { file.arranged("fixed", {{"three", 4}}); }, ThrowsMessage<InputError>(HasSubstr("4 are needed")));
  EXPECT_THAT([&] { file.numbers("nothing"); }, ThrowsMessage<InputError>(HasSubstr("\"nothing\" is missing")));
  EXPECT_THAT([&] { file.scalar("fixed"); }, ThrowsMessage<InputError>(HasSubstr("3 numbers")));
  EXPECT_THAT([&] { file.texts("fixed"); }, ThrowsMessage<InputError>(HasSubstr("text is needed")));
}

}  // namespace
}  // namespace netcdf_test
