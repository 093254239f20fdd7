#include "dynamics/state/block_matrix.hpp"

#include <gtest/gtest.h>

#include "hydro/base/random.hpp"

namespace block_matrix_test {
namespace {

using namespace dynamics;

BlockPattern chain(int bodies) {
  BlockPattern p(bodies);
  for (int i = 0; i + 1 < bodies; ++i) p.couple(i, i + 1);
  p.freeze();
  return p;
}

void fill(BlockMatrix& m) {
  const hydro::RandomStream random(3, 0);
  std::uint64_t n = 0;
  for (int i = 0; i < m.pattern().bodies(); ++i)
    for (const int j : m.pattern().columns(i)) {
      m.block(i, j) = Matrix6::NullaryExpr([&] { return random.normal(n++); });
      if (i == j) m.block(i, j).diagonal().array() += 10;  // well away from singular
    }
}

TEST(BlockSolver, SolvesFewBodiesDenselyAndManySparsely) {
  for (const int bodies : {1, 3, 40}) {
    const BlockPattern pattern = chain(bodies);
    BlockMatrix m(pattern);
    fill(m);
    BlockSolver solver(pattern);
    EXPECT_EQ(solver.is_sparse(), bodies == 40);
    ASSERT_TRUE(solver.factorise(m));
    const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(6 * bodies, -1, 2);
    EXPECT_LT((solver.solve(m * x) - x).norm(), 1e-11 * x.norm()) << bodies;  // condition below 1e3
    EXPECT_LT((m.dense() * x - m * x).norm(), 1e-12 * x.norm());
  }
}

TEST(BlockSolver, SaysSingularAndNotFinite) {
  for (const int bodies : {2, 40}) {
    const BlockPattern pattern = chain(bodies);
    BlockMatrix m(pattern);
    fill(m);
    BlockSolver solver(pattern);
    m.block(1, 1)(2, 2) = std::nan("");
    EXPECT_FALSE(solver.factorise(m)) << bodies;
    m.set_zero();
    EXPECT_FALSE(solver.factorise(m)) << bodies;
  }
}

/// Each body's own block with small numbers where the pivots of fill() stand, and large ones beside them.
void turn_pivots(BlockMatrix& m) {
  fill(m);
  for (int i = 0; i < m.pattern().bodies(); ++i) {
    Matrix6& own = m.block(i, i);
    own.diagonal().setConstant(1e-9);
    for (int k = 0; k < 6; ++k) own(k, (k + 1) % 6) += 10;
  }
}

// Sparse factors keep their pivots from matrix to matrix, but not where these serve badly: kept here they lose nine
// digits.
TEST(BlockSolver, SolvesOneMatrixAfterAnother) {
  for (const int bodies : {3, 40}) {
    const BlockPattern pattern = chain(bodies);
    BlockMatrix m(pattern);
    BlockSolver solver(pattern);
    const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(6 * bodies, -1, 2);
    const auto expect_solved = [&] {
      ASSERT_TRUE(solver.factorise(m));
      EXPECT_LT((solver.solve(m * x) - x).norm(), 1e-11 * x.norm()) << bodies;
    };
    fill(m);
    expect_solved();
    m.block(1, 1) *= 2;
    expect_solved();
    turn_pivots(m);
    expect_solved();
    m.set_zero();
    EXPECT_FALSE(solver.factorise(m)) << bodies;
    fill(m);
    expect_solved();
  }
}

// Rows that differ by less than rounding leave a pivot that is not quite zero.
TEST(BlockSolver, TellsWhatIsSingularToWorkingPrecision) {
  const BlockPattern pattern = chain(3);
  BlockMatrix m(pattern);
  BlockSolver solver(pattern);
  for (const double apart : {1e-9, 1e-17}) {
    fill(m);
    for (const int j : {0, 1}) m.block(0, j).row(4) = m.block(0, j).row(2) / 3;
    m.block(0, 0)(4, 4) += apart;
    EXPECT_EQ(solver.factorise(m), apart == 1e-9);
  }
}

}  // namespace
}  // namespace block_matrix_test
