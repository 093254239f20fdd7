#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numeric>
#include <thread>

#include "hydro/base/error.hpp"
#include "hydro/base/random.hpp"
#include "hydro/io/atomic_file.hpp"
#include "hydro/io/hdf5.hpp"
#include "support/scratch.hpp"

namespace files_test {
namespace {

namespace fs = std::filesystem;
using namespace hydro::io;
using hydro::InputError;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// A folder of its own that goes with the test.
class Files : public testing::Test {
 protected:
  void SetUp() override {
    folder = support::scratch_folder() /
             (std::string("froude_") + testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder);
    fs::create_directory(folder);
  }
  void TearDown() override { fs::remove_all(folder); }
  std::size_t entries() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
  }
  fs::path folder;
};

TEST_F(Files, AreReplacedWholeAndLeaveNothingBeside) {
  write_atomically(folder / "a.txt", "first");
  write_atomically(folder / "a.txt", "second, longer");
  EXPECT_EQ(read_text(folder / "a.txt"), "second, longer");
  EXPECT_EQ(entries(), 1u);
}

TEST_F(Files, AreRefusedWithTheReasonAndLeaveNothing) {
  EXPECT_THAT([&] { write_atomically(folder / "none" / "a.txt", "x"); },
              ThrowsMessage<InputError>(HasSubstr("No such file or directory")));
  EXPECT_THAT([&] { write_atomically(folder, "x"); }, ThrowsMessage<InputError>(HasSubstr("Is a directory")));
  EXPECT_THAT([&] { read_text(folder / "none.txt"); }, ThrowsMessage<InputError>(HasSubstr("cannot read")));
  require_writable(folder / "new.txt");
  EXPECT_EQ(entries(), 0u);
}

TEST_F(Files, ThatALinkPointsToAreReplacedAndTheLinkStays) {
  fs::create_directory(folder / "elsewhere");
  write_atomically(folder / "elsewhere" / "a.txt", "old");
  fs::create_symlink("elsewhere/a.txt", folder / "link");
  fs::create_symlink("link", folder / "link_to_link");
  fs::create_symlink("elsewhere/new.txt", folder / "dangling");
  write_atomically(folder / "link_to_link", "new");
  write_atomically(folder / "dangling", "made");
  EXPECT_TRUE(fs::is_symlink(folder / "link_to_link"));
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
  EXPECT_TRUE(fs::is_symlink(folder / "dangling"));
  EXPECT_EQ(read_text(folder / "elsewhere" / "a.txt"), "new");
  EXPECT_EQ(read_text(folder / "elsewhere" / "new.txt"), "made");
  fs::create_symlink("circle", folder / "circle");
  EXPECT_THROW(write_atomically(folder / "circle", "x"), InputError);
}

TEST_F(Files, ThatAreDevicesOrFifosAreWrittenInto) {
  ASSERT_EQ(::mkfifo((folder / "fifo").c_str(), 0600), 0);
  require_writable(folder / "fifo");  // returns at once, though nobody reads
  std::string read;
  std::thread reader([&] { read = read_text(folder / "fifo"); });
  write_atomically(folder / "fifo", "through the pipe");
  reader.join();
  EXPECT_EQ(read, "through the pipe");
  EXPECT_TRUE(fs::is_fifo(folder / "fifo"));
  fs::create_symlink("/dev/null", folder / "null");
  write_atomically(folder / "null", "x");
  EXPECT_TRUE(fs::is_symlink(folder / "null"));
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

/// What was written before and what comes later both stay: the descriptor is shared, the file is not opened anew.
TEST_F(Files, ThatAreOpenAlreadyAreWrittenOnWhereTheyStand) {
  std::FILE* file = std::fopen((folder / "a.txt").c_str(), "w");
  ASSERT_NE(file, nullptr);
  std::fputs("before, ", file);
  std::fflush(file);
  write_atomically("/dev/fd/" + std::to_string(::fileno(file)), "between, ");
  std::fputs("after", file);
  std::fclose(file);
  EXPECT_EQ(read_text(folder / "a.txt"), "before, between, after");
}

TEST_F(Files, AreTheSameByLinkByHardLinkAndByAnotherSpelling) {
  write_atomically(folder / "a.txt", "x");
  write_atomically(folder / "b.txt", "x");
  fs::create_symlink("a.txt", folder / "soft");
  fs::create_hard_link(folder / "a.txt", folder / "hard");
  fs::create_symlink("none.txt", folder / "dangling");
  EXPECT_TRUE(same_file(folder / "a.txt", folder / "." / "soft"));
  EXPECT_TRUE(same_file(folder / "hard", folder / "soft"));
  EXPECT_TRUE(same_file(folder / "none.txt", folder / "dangling"));
  EXPECT_FALSE(same_file(folder / "a.txt", folder / "b.txt"));
  EXPECT_FALSE(same_file(folder / "a.txt", folder / "none.txt"));
  EXPECT_FALSE(same_file("/dev/null", "/dev/null"));
  EXPECT_FALSE(same_file(folder, folder));
}

TEST_F(Files, OfHdf5ComeBackToTheLastBit) {
  std::vector<double> large(70000);
  std::iota(large.begin(), large.end(), 0.1);
  {
    Hdf5Writer file;
    file.write("/group/deep/table", std::vector<double>{1, 2, 3, 4, 5, 6}, {2, 3});
    file.write("/large", large, {700, 100});  // chunked and compressed
    file.write_scalar("/one", std::numeric_limits<double>::denorm_min());
    file.write_text("/words", "ζ is a wave");
    file.attribute("/one", "units", "m");
    file.attribute("/one", "scale", 0.1);
    file.save(folder / "a.h5");
  }
  const Hdf5Reader read(folder / "a.h5");
  const Array table = read.numbers("/group/deep/table");
  EXPECT_THAT(table.shape, testing::ElementsAre(2, 3));
  EXPECT_THAT(table.values, testing::ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_EQ(read.numbers("/large").values, large);
  EXPECT_EQ(read.scalar("/one"), std::numeric_limits<double>::denorm_min());
  EXPECT_EQ(read.text("/words"), "ζ is a wave");
  EXPECT_EQ(read.text_attribute("/one", "units"), "m");
  EXPECT_EQ(read.number_attribute("/one", "scale"), 0.1);
  EXPECT_TRUE(read.has("/group/deep"));
  EXPECT_FALSE(read.has("/group/shallow/table"));
  EXPECT_TRUE(read.is_text("/words"));
  EXPECT_THAT(read.children("/group"), testing::ElementsAre("deep"));
}

// Digits like noise stand as they are, and take no time to pack; constants, also as real and imaginary parts, and what
// is nothing most of the time, take next to no room.
TEST_F(Files, OfHdf5ArePackedWhereThatPays) {
  constexpr std::size_t count = 20000, bytes = count * sizeof(double);
  const hydro::RandomStream random(1, 0);
  std::vector<double> noise, parts, seldom(count, 0.0);
  for (std::size_t i = 0; i < count; ++i) {
    noise.push_back(random.normal(i));
    parts.push_back(i % 2 == 0 ? 1.0 : 0.0);
    if (i % 50 == 0) seldom[i] = noise.back();
  }
  const auto size_of = [&](const std::vector<double>& values) {
    Hdf5Writer file;
    file.write("/x", values, {values.size() / 2, 2});
    file.save(folder / "a.h5");
    EXPECT_EQ(Hdf5Reader(folder / "a.h5").numbers("/x").values, values);
    return fs::file_size(folder / "a.h5");
  };
  EXPECT_GE(size_of(noise), bytes);
  EXPECT_LT(size_of(parts), bytes / 10);   // a file of its own has some 5 kB
  EXPECT_LT(size_of(seldom), bytes / 10);  // a 50th of the numbers, and where they are
}

TEST_F(Files, OfHdf5SayWhatIsMissingOrCut) {
  {
    Hdf5Writer file;
    file.write("/x", std::vector<double>(5000, 1.0), {5000});
    file.save(folder / "a.h5");
  }
  EXPECT_THAT([&] { Hdf5Reader(folder / "a.h5").numbers("/y"); },
              ThrowsMessage<InputError>(HasSubstr("/y: there is no such dataset")));
  EXPECT_THAT([&] { Hdf5Reader(folder / "a.h5").scalar("/x"); },
              ThrowsMessage<InputError>(HasSubstr("one number is needed")));
  fs::resize_file(folder / "a.h5", fs::file_size(folder / "a.h5") / 2);
  EXPECT_THAT([&] { Hdf5Reader(folder / "a.h5"); }, ThrowsMessage<InputError>(HasSubstr("cut short")));
  std::ofstream(folder / "b.h5") << "not HDF5";
  EXPECT_THAT([&] { Hdf5Reader(folder / "b.h5"); }, ThrowsMessage<InputError>(HasSubstr("not an HDF5 file")));
}

}  // namespace
}  // namespace files_test
