#include "cvode.hpp"

#include <cvode/cvode.h>
#include <fmt/format.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include "hydro/base/error.hpp"

namespace dynamics::detail {
namespace {

/// Owns what a C library has made.
template <class T>
using Owned = std::unique_ptr<T, std::function<void(T*)>>;

Eigen::Map<Eigen::VectorXd> mapped(N_Vector v) { return {N_VGetArrayPointer(v), N_VGetLength(v)}; }

void require_success(int flag, const char* call) {
  if (flag < 0) throw hydro::NumericsError(fmt::format("SUNDIALS: {} failed with {}", call, flag));
}

}  // namespace

struct Cvode::Content {
  explicit Content(Eigen::Index size) {
    SUNContext made = nullptr;
    require_success(SUNContext_Create(nullptr, &made), "SUNContext_Create");
    context = {made, [](SUNContext c) { SUNContext_Free(&c); }};
    y = {N_VNew_Serial(size, made), N_VDestroy};
    allowed = {N_VNew_Serial(size, made), N_VDestroy};
    matrix = {SUNDenseMatrix(size, size, made), SUNMatDestroy};
    linear = {SUNLinSol_Dense(y.get(), matrix.get(), made), [](SUNLinearSolver s) { SUNLinSolFree(s); }};
    memory = {CVodeCreate(CV_BDF, made), [](void* m) { CVodeFree(&m); }};
    if (!y || !allowed || !matrix || !linear || !memory) throw hydro::NumericsError("SUNDIALS has no memory");
    mapped(y.get()).setZero();
    mapped(allowed.get()).setOnes();
    require_success(CVodeInit(memory.get(), Content::call, 0, y.get()), "CVodeInit");
    require_success(CVodeSVtolerances(memory.get(), 0, allowed.get()), "CVodeSVtolerances");
    require_success(CVodeSetLinearSolver(memory.get(), linear.get(), matrix.get()), "CVodeSetLinearSolver");
    require_success(CVodeSetUserData(memory.get(), this), "CVodeSetUserData");
    require_success(CVodeSetMaxNumSteps(memory.get(), 100'000), "CVodeSetMaxNumSteps");
    require_success(CVodeSetErrHandlerFn(memory.get(), Content::quiet, nullptr), "CVodeSetErrHandlerFn");
  }

  static int call(realtype t, N_Vector y, N_Vector dy, void* self) {
    return (*static_cast<Content*>(self)->rates)(t, mapped(y), mapped(dy)) ? 0 : 1;
  }
  static void quiet(int, const char*, const char*, char*, void*) {}

  const Rates* rates = nullptr;
  Owned<std::remove_pointer_t<SUNContext>> context;
  Owned<std::remove_pointer_t<N_Vector>> y, allowed;
  Owned<std::remove_pointer_t<SUNMatrix>> matrix;
  Owned<std::remove_pointer_t<SUNLinearSolver>> linear;
  Owned<void> memory;
};

Cvode::Cvode(Eigen::Index size) : content_(std::make_unique<Content>(size)) {}
Cvode::~Cvode() = default;

Cvode::Outcome Cvode::run(const Rates& rates, Eigen::VectorXd& y, const Eigen::VectorXd& allowed, double h) {
  Content& c = *content_;
  c.rates = &rates;
  mapped(c.y.get()) = y;
  mapped(c.allowed.get()) = allowed;
  require_success(CVodeReInit(c.memory.get(), 0, c.y.get()), "CVodeReInit");
  require_success(CVodeSVtolerances(c.memory.get(), 0, c.allowed.get()), "CVodeSVtolerances");
  require_success(CVodeSetStopTime(c.memory.get(), h), "CVodeSetStopTime");
  Outcome out{false, 0};
  out.good = CVode(c.memory.get(), h, c.y.get(), &out.reached, CV_NORMAL) >= 0;
  require_success(CVodeGetNumNonlinSolvIters(c.memory.get(), &out.iterations), "CVodeGetNumNonlinSolvIters");
  y = mapped(c.y.get());
  return out;
}

}  // namespace dynamics::detail
