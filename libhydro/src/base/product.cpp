#include "hydro/base/product.hpp"

#include "hydro/base/error.hpp"
#include "hydro/base/machine.hpp"
#ifdef FROUDE_WIDE_PRODUCT
#include "wide_product.hpp"
#endif

namespace hydro {

const char* instructions_of_loops() {
#ifdef FROUDE_HAS_CLONES
  __builtin_cpu_init();
  if (__builtin_cpu_supports("x86-64-v3")) return "x86-64-v3, AVX2 and fused products";
#endif
  return "those that the program was compiled for";
}

namespace {

#ifdef FROUDE_WIDE_PRODUCT
bool is_wide() {
  static const bool wide = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  return wide;
}
#endif

}  // namespace

Eigen::MatrixXd transposed_product(const Eigen::Ref<const Eigen::MatrixXd>& A,
                                   const Eigen::Ref<const Eigen::MatrixXd>& B) {
#ifdef FROUDE_WIDE_PRODUCT
  if (is_wide()) {
    Eigen::MatrixXd out(A.cols(), B.cols());
    detail::wide_transposed_product({A.data(), A.rows(), A.cols(), A.outerStride()},
                                    {B.data(), B.rows(), B.cols(), B.outerStride()}, out.data());
    return out;
  }
#endif
  return A.transpose() * B;
}

void add_product(const Eigen::Ref<const Eigen::MatrixXcd>& A, const Eigen::Ref<const RowMajorXcd>& B,
                 Eigen::Ref<RowMajorXcd> out) {
  ensure(A.cols() == B.rows() && out.rows() == A.rows() && out.cols() == B.cols(), "shapes of a product agree");
#ifdef FROUDE_WIDE_PRODUCT
  if (is_wide()) {
    detail::wide_add_product({A.data(), A.rows(), A.cols(), A.outerStride()},
                             {B.data(), B.rows(), B.cols(), B.outerStride()}, {out.data(), out.outerStride()});
    return;
  }
#endif
  out.noalias() += A * B;
}

}  // namespace hydro
