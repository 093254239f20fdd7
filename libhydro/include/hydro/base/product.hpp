#pragma once
/// \file  Products of dense matrices by the widest vectors of the processor.
///
/// The algorithm is Eigen's. It is compiled twice, as the rest of the program is (SSE2, which every x86-64 has) and for
/// AVX2 with FMA, and the better one that the processor has is taken at run time: its inner loop took half of the
/// time in fits of poles of order 160. The two differ by rounding: one rounds a product and a sum once, the other
/// twice. On one machine results are the same every time.
#include <Eigen/Core>

#include <complex>

namespace hydro {

/// AᵀB of shape (m, n), for A of shape (k, m) and B of shape (k, n). Columns may stand apart; rows are adjacent. Each
/// entry is off by at most k ε Σ|a||b| (Higham 2002, section 3.5), with ε = 1.1e-16.
Eigen::MatrixXd transposed_product(const Eigen::Ref<const Eigen::MatrixXd>& A,
                                   const Eigen::Ref<const Eigen::MatrixXd>& B);

/// Complex numbers whose rows are adjacent: many columns of which each row is one thing.
using RowMajorXcd = Eigen::Matrix<std::complex<double>, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// out += A B, for A of shape (m, k) with adjacent columns' entries, B (k, n) and out (m, n). `out` must not overlap A
/// or B. Each entry is off by at most 2k ε Σ|a||b|.
void add_product(const Eigen::Ref<const Eigen::MatrixXcd>& A, const Eigen::Ref<const RowMajorXcd>& B,
                 Eigen::Ref<RowMajorXcd> out);

}  // namespace hydro
