// Fits of radiation memory that outlive the program: the same to the bit, or made anew.
#include "compile/fit_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <string>
#include <thread>
#include <tuple>
#include <vector>

#include "froude/kept_fits.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/atomic_file.hpp"
#include "support/kept_folder.hpp"
#include "support/scratch.hpp"
#include "support/two_pole_body.hpp"

namespace fit_folder_test {
namespace {

namespace fs = std::filesystem;
using namespace froude;
using compile::FitFolder;
using compile::SymmetricData;
using hydro::radiation::RationalFit;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// A body of one mode, whose damping is `times` that of the two poles.
SymmetricData data_of(double times = 1) {
  const support::TwoPoleBody body;
  hydro::potential::Coefficients c;
  for (int i = 1; i <= 20; ++i) {
    const double omega = 0.2 * i;
    c.omega.push_back(omega);
    c.B.emplace_back(Eigen::MatrixXd::Constant(1, 1, times * body.B(omega)));
    c.A.emplace_back(Eigen::MatrixXd::Constant(1, 1, 7 + times * body.A_minus_A_inf(omega)));
  }
  c.A_inf = Eigen::MatrixXd::Constant(1, 1, 7);
  return {c, {0}};
}

constexpr double tolerance = 1e-3;

RationalFit fit_of(const SymmetricData& data) {
  return hydro::radiation::fit(data.damping, data.A, data.A_inf, {.tolerance = tolerance});
}

/// All that a fit has, number for number.
void expect_same(const RationalFit& a, const RationalFit& b) {
  ASSERT_EQ(a.model.poles.size(), b.model.poles.size());
  for (std::size_t k = 0; k < a.model.poles.size(); ++k) {
    EXPECT_EQ(a.model.poles[k].decay, b.model.poles[k].decay);
    EXPECT_EQ(a.model.poles[k].omega, b.model.poles[k].omega);
  }
  EXPECT_EQ(a.model.C, b.model.C);
  EXPECT_EQ(a.model.S, b.model.S);
  EXPECT_EQ(a.A_inf, b.A_inf);
  const auto &x = a.report, &y = b.report;
  EXPECT_EQ(x.error_per_pair, y.error_per_pair);
  EXPECT_EQ(std::tie(x.order, x.error, x.error_before, x.passive, x.margin, x.most_negative, x.lift, x.shift,
                     x.negative_share, x.why),
            std::tie(y.order, y.error, y.error_before, y.passive, y.margin, y.most_negative, y.lift, y.shift,
                     y.negative_share, y.why));
}

/// A folder of the test that is named, empty.
fs::path fresh_folder() {
  const fs::path out =
      support::scratch_folder() / testing::UnitTest::GetInstance()->current_test_info()->name() / "fits";
  fs::remove_all(out);
  return out;
}

std::vector<fs::path> entries(const fs::path& folder) {
  std::vector<fs::path> out;
  for (const auto& entry : fs::directory_iterator(folder)) out.push_back(entry.path());
  return out;
}

void write(const fs::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary).write(bytes.data(), std::ssize(bytes));
}

TEST(FitFolder, GivesBackWhatItKeptToTheBitAndNothingElse) {
  const FitFolder folder(fresh_folder());
  const SymmetricData data = data_of(), other = data_of(1 + 1e-15);
  ASSERT_NE(data.damping.B, other.damping.B);
  EXPECT_FALSE(folder.find(data, tolerance)) << "there is no folder yet";
  const RationalFit fit = fit_of(data);
  folder.keep(data, tolerance, fit);
  const auto kept = folder.find(data, tolerance);
  ASSERT_TRUE(kept);
  expect_same(*kept, fit);
  EXPECT_FALSE(folder.find(other, tolerance)) << "one bit of the data differs";
  EXPECT_FALSE(folder.find(data, std::nextafter(tolerance, 1)));
  SymmetricData without = data;
  without.A_inf.reset();
  EXPECT_FALSE(folder.find(without, tolerance));
}

TEST(FitFolder, TakesNoEntryThatIsSpoiltAndReplacesIt) {
  const FitFolder folder(fresh_folder());
  const SymmetricData data = data_of();
  const RationalFit fit = fit_of(data);
  folder.keep(data, tolerance, fit);
  const fs::path file = entries(folder.path()).at(0);
  const std::string sound = hydro::io::read_text(file);
  for (std::size_t at = 0; at < sound.size(); ++at) {
    std::string spoilt = sound;
    spoilt[at] = static_cast<char>(spoilt[at] ^ 0x10);
    write(file, spoilt);
    ASSERT_FALSE(folder.find(data, tolerance)) << "byte " << at << " is another";
  }
  for (std::size_t size = 0; size < sound.size(); size += 7) {
    write(file, sound.substr(0, size));
    ASSERT_FALSE(folder.find(data, tolerance)) << "cut short at " << size;
  }
  folder.keep(data, tolerance, fit);
  EXPECT_TRUE(folder.find(data, tolerance));
  EXPECT_EQ(entries(folder.path()).size(), 1u);
}

// An entry whose data are others' is what a clash of two names would be.
TEST(FitFolder, ComparesAllDataAndNotTheirDigestAlone) {
  const FitFolder folder(fresh_folder());
  const SymmetricData data = data_of(), other = data_of(2);
  folder.keep(data, tolerance, fit_of(data));
  const fs::path of_data = entries(folder.path()).at(0);
  folder.keep(other, tolerance, fit_of(other));
  for (const fs::path& file : entries(folder.path()))
    if (file != of_data) fs::copy_file(of_data, file, fs::copy_options::overwrite_existing);
  EXPECT_TRUE(folder.find(data, tolerance));
  EXPECT_FALSE(folder.find(other, tolerance));
}

TEST(FitFolder, IsBoundedAndLetsTheLongestUnusedGo) {
  const fs::path path = fresh_folder();
  const SymmetricData first = data_of(), second = data_of(2), third = data_of(3), last = data_of(4), more = data_of(5);
  const RationalFit fit = fit_of(first);
  FitFolder(path).keep(first, tolerance, fit);
  const std::uintmax_t size = fs::file_size(entries(path).at(0));
  const FitFolder folder(path, 4 * size);
  const auto hour = std::chrono::hours(1);
  const auto age = [&](int hours) {
    for (const auto& file : entries(path)) fs::last_write_time(file, fs::last_write_time(file) - hours * hour);
  };
  for (const SymmetricData* data : {&second, &third, &last}) {
    age(1);
    folder.keep(*data, tolerance, fit);
  }
  ASSERT_EQ(entries(path).size(), 4u);
  age(1);
  EXPECT_TRUE(folder.find(first, tolerance)) << "and is now the newest";
  folder.keep(more, tolerance, fit);
  EXPECT_EQ(entries(path).size(), 4u);
  EXPECT_TRUE(folder.find(first, tolerance));
  EXPECT_FALSE(folder.find(second, tolerance));
  EXPECT_TRUE(folder.find(third, tolerance));
  EXPECT_TRUE(folder.find(more, tolerance));
  write(path / "of_somebody_else.txt", std::string(10 * size, 'x'));
  folder.keep(more, tolerance, fit);
  EXPECT_TRUE(fs::exists(path / "of_somebody_else.txt"));
}

TEST(FitFolder, ThatCannotBeIsNoError) {
  const fs::path path = fresh_folder();
  fs::create_directories(path.parent_path());
  write(path, "a file where the folder should be");
  const FitFolder folder(path);
  const SymmetricData data = data_of();
  EXPECT_NO_THROW(folder.keep(data, tolerance, fit_of(data)));
  EXPECT_FALSE(folder.find(data, tolerance));
  EXPECT_EQ(hydro::io::read_text(path), "a file where the folder should be");
}

TEST(FitFolder, ServesSeveralAtOnce) {
  const FitFolder folder(fresh_folder(), 20000);
  const std::vector<SymmetricData> data{data_of(), data_of(2), data_of(3)};
  std::vector<RationalFit> fits;
  for (const auto& d : data) fits.push_back(fit_of(d));
  const auto use = [&](std::size_t first) {
    for (std::size_t i = 0; i < 60; ++i) {
      const std::size_t k = (first + i) % data.size();
      if (const auto kept = folder.find(data[k], tolerance))
        expect_same(*kept, fits[k]);
      else
        folder.keep(data[k], tolerance, fits[k]);
    }
  };
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < 4; ++t) threads.emplace_back(use, t);
  for (auto& t : threads) t.join();
  for (const auto& file : entries(folder.path())) EXPECT_EQ(file.extension(), ".fit") << "what was begun is left";
}

TEST(RadiationFits, OfALaterProcessAreThoseOfAnEarlierOne) {
  const SymmetricData data = data_of();
  compile::RadiationFits alone;
  EXPECT_FALSE(alone.of(data, tolerance).kept_in) << "a library keeps nothing unless it is told to";
  const support::KeptFolder folder(fresh_folder());
  compile::RadiationFits earlier, later;
  EXPECT_FALSE(earlier.of(data, tolerance).kept_in);
  const auto& known = later.of(data, tolerance);
  EXPECT_EQ(known.kept_in, fresh_folder().parent_path() / "fits");
  expect_same(known.fit, alone.of(data, tolerance).fit);
}

/// The environment as a test wants it, and as it was.
class Environment {
 public:
  void set(const std::string& name, const std::string& value) {
    if (const char* was = std::getenv(name.c_str()); was && !before_.contains(name)) before_[name] = was;
    set_.push_back(name);
    ::setenv(name.c_str(), value.c_str(), 1);
  }
  Environment() = default;
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;
  ~Environment() {
    for (const auto& name : set_) ::unsetenv(name.c_str());
    for (const auto& [name, value] : before_) ::setenv(name.c_str(), value.c_str(), 1);
  }

 private:
  std::map<std::string, std::string> before_;
  std::vector<std::string> set_;
};

TEST(UsersFolderOfFits, IsWhereTheEnvironmentSays) {
  Environment environment;
  environment.set("FROUDE_CACHE", "on");
  environment.set("HOME", "/home/a");
  environment.set("XDG_CACHE_HOME", "/cache");
  EXPECT_EQ(users_folder_of_fits(), "/cache/froude");
  environment.set("XDG_CACHE_HOME", "not/absolute");
  EXPECT_EQ(users_folder_of_fits(), "/home/a/.cache/froude");
  environment.set("HOME", "");
  EXPECT_EQ(users_folder_of_fits(), std::nullopt);
  environment.set("HOME", "/home/a");
  environment.set("FROUDE_CACHE", "off");
  EXPECT_EQ(users_folder_of_fits(), std::nullopt);
  environment.set("FROUDE_CACHE", "no");
  EXPECT_THAT([] { users_folder_of_fits(); }, ThrowsMessage<hydro::InputError>(HasSubstr("FROUDE_CACHE=no")));
}

}  // namespace
}  // namespace fit_folder_test
