#include "algebra/complex_sparse_lu.hpp"

namespace dynamics {

ComplexSparseLu::ComplexSparseLu(Matrix& A) : singular_(true) {
  constexpr double singular_from = 1e15;
  compute(A);
  if (info() != Eigen::Success) return;
  auto* values = reinterpret_cast<double*>(A.valuePtr());  // real and imaginary parts in turn
  singular_ = klu_z_condest(A.outerIndexPtr(), values, m_symbolic, m_numeric, &m_common) == 0 ||
              !(m_common.condest < singular_from);
}

}  // namespace dynamics
