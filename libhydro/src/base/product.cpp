#include "hydro/base/product.hpp"

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

Eigen::MatrixXd transposed_product(const Eigen::Ref<const Eigen::MatrixXd>& A,
                                   const Eigen::Ref<const Eigen::MatrixXd>& B) {
#ifdef FROUDE_WIDE_PRODUCT
  static const bool wide = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  if (wide) {
    Eigen::MatrixXd out(A.cols(), B.cols());
    detail::wide_transposed_product({A.data(), A.rows(), A.cols(), A.outerStride()},
                                    {B.data(), B.rows(), B.cols(), B.outerStride()}, out.data());
    return out;
  }
#endif
  return A.transpose() * B;
}

}  // namespace hydro
