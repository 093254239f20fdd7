#pragma once
/// \file  Private: the routines of LAPACK that dense.cpp calls, as Fortran's compilers name them. Arguments are those
/// of
///        the LAPACK Users' Guide (Anderson et al. 1999). The length of each string follows after the last argument.
#include <complex>
#include <cstddef>

namespace hydro::lapack {

using Length = std::size_t;
using Complex = std::complex<double>;

extern "C" {
void dgeqp3_(const int* m, const int* n, double* a, const int* lda, int* order, double* tau, double* work,
             const int* lwork, int* info);
void zgeqp3_(const int* m, const int* n, Complex* a, const int* lda, int* order, Complex* tau, Complex* work,
             const int* lwork, double* rwork, int* info);
void dgeqrf_(const int* m, const int* n, double* a, const int* lda, double* tau, double* work, const int* lwork,
             int* info);
void dorgqr_(const int* m, const int* n, const int* k, double* a, const int* lda, const double* tau, double* work,
             const int* lwork, int* info);
void zungqr_(const int* m, const int* n, const int* k, Complex* a, const int* lda, const Complex* tau, Complex* work,
             const int* lwork, int* info);
void dormqr_(const char* side, const char* trans, const int* m, const int* n, const int* k, const double* a,
             const int* lda, const double* tau, double* c, const int* ldc, double* work, const int* lwork, int* info,
             Length, Length);
void dtzrzf_(const int* m, const int* n, double* a, const int* lda, double* tau, double* work, const int* lwork,
             int* info);
void dormrz_(const char* side, const char* trans, const int* m, const int* n, const int* k, const int* l,
             const double* a, const int* lda, const double* tau, double* c, const int* ldc, double* work,
             const int* lwork, int* info, Length, Length);
void dtrtrs_(const char* uplo, const char* trans, const char* diag, const int* n, const int* columns, const double* a,
             const int* lda, double* b, const int* ldb, int* info, Length, Length, Length);

void zgetrf_(const int* m, const int* n, Complex* a, const int* lda, int* pivots, int* info);
void zgetrs_(const char* trans, const int* n, const int* columns, const Complex* a, const int* lda, const int* pivots,
             Complex* b, const int* ldb, int* info, Length);
void zgecon_(const char* norm, const int* n, const Complex* a, const int* lda, const double* norm_of_a, double* rcond,
             Complex* work, double* rwork, int* info, Length);

void dpotrf_(const char* uplo, const int* n, double* a, const int* lda, int* info, Length);
void dpotrs_(const char* uplo, const int* n, const int* columns, const double* a, const int* lda, double* b,
             const int* ldb, int* info, Length);

void dsyev_(const char* vectors, const char* uplo, const int* n, double* a, const int* lda, double* values,
            double* work, const int* lwork, int* info, Length, Length);
void dgeev_(const char* left, const char* right, const int* n, double* a, const int* lda, double* real, double* imag,
            double* left_vectors, const int* ldvl, double* right_vectors, const int* ldvr, double* work,
            const int* lwork, int* info, Length, Length);
void dgesvd_(const char* left, const char* right, const int* m, const int* n, double* a, const int* lda, double* values,
             double* u, const int* ldu, double* vt, const int* ldvt, double* work, const int* lwork, int* info, Length,
             Length);
}

}  // namespace hydro::lapack
