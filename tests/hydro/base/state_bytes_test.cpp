// States as bytes and back.
#include "hydro/base/state_bytes.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace state_bytes_test {
namespace {

using hydro::StateBytes;

struct Part {
  double a = 0;
  std::vector<int> b;
  void keep_state(StateBytes& bytes) { bytes.pass(a, b); }
};

struct Whole {
  bool yes = false;
  std::size_t count = 0;
  double last = 0;
  std::string name;
  std::vector<double> numbers;
  std::vector<Part> parts;
  std::optional<double> there, absent = 3;
  Eigen::MatrixXd matrix;
  Eigen::Vector3d vector = Eigen::Vector3d::Zero();
  void keep_state(StateBytes& bytes) {
    bytes.pass(yes, count, last, name, numbers, parts, there, absent, matrix, vector);
  }
};

Whole some() {
  Whole out;
  out.yes = true;
  out.count = 7;
  out.last = -std::numeric_limits<double>::infinity();
  out.name = "a b\n";
  out.numbers = {0.1, -0.0, std::numeric_limits<double>::denorm_min()};
  out.parts = {{1, {2, 3}}, {4, {}}};
  out.there = 1.0 / 3;
  out.absent.reset();
  out.matrix = (Eigen::MatrixXd(2, 3) << 1, 2, 3, 4, 5, 6).finished() / 7;
  out.vector = {1, 2, 3};
  return out;
}

std::string bytes_of(Whole one) {
  StateBytes bytes;
  bytes.pass(one);
  return bytes.bytes();
}

TEST(StateBytes, GivesBackWhatItTookToTheBit) {
  const std::string bytes = bytes_of(some());
  StateBytes back(bytes);
  Whole out;
  back.pass(out);
  EXPECT_TRUE(back.at_end());
  EXPECT_FALSE(out.absent);
  EXPECT_EQ(out.matrix, some().matrix);
  EXPECT_EQ(out.parts.at(0).b, some().parts.at(0).b);
  EXPECT_EQ(bytes_of(out), bytes);
}

TEST(StateBytes, EndsWithAnErrorWhereBytesAreCut) {
  const std::string bytes = bytes_of(some());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    StateBytes back(bytes.substr(0, size));
    Whole out;
    EXPECT_THROW(back.pass(out), std::length_error) << size;
  }
}

// A size is one that the bytes left can hold, or refused before memory is asked for.
TEST(StateBytes, AsksForNoMemoryThatBytesCannotFill) {
  StateBytes bytes;
  std::size_t size = std::size_t{1} << 60U;
  bytes.pass(size, size);
  StateBytes numbers(bytes.bytes()), text(bytes.bytes()), matrix(bytes.bytes());
  std::vector<double> many;
  EXPECT_THROW(numbers.pass(many), std::length_error);
  std::string name;
  EXPECT_THROW(text.pass(name), std::length_error);
  Eigen::MatrixXd large;
  EXPECT_THROW(matrix.pass(large), std::length_error);
}

}  // namespace
}  // namespace state_bytes_test
