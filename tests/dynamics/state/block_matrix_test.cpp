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

}  // namespace
}  // namespace block_matrix_test
