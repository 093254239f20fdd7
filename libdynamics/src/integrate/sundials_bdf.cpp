#include "dynamics/integrate/sundials_bdf.hpp"

#include <cvode/cvode.h>
#include <fmt/format.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <functional>

#include "explicit_step.hpp"
#include "hydro/base/error.hpp"

namespace dynamics {

namespace {

/// Owns what a C library has made.
template <class T>
using Owned = std::unique_ptr<T, std::function<void(T*)>>;

Eigen::Map<Eigen::VectorXd> mapped(N_Vector v) { return {N_VGetArrayPointer(v), N_VGetLength(v)}; }

void require_success(int flag, const char* call) {
  if (flag < 0) throw hydro::NumericsError(fmt::format("SUNDIALS: {} failed with {}", call, flag));
}

}  // namespace

/// CVODE for vectors of displacements, then changes of velocity, since the start of the step.
struct SundialsBdf::Solver {
  explicit Solver(Eigen::Index size) {
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
    require_success(CVodeInit(memory.get(), Solver::rates, 0, y.get()), "CVodeInit");
    require_success(CVodeSVtolerances(memory.get(), 0, allowed.get()), "CVodeSVtolerances");
    require_success(CVodeSetLinearSolver(memory.get(), linear.get(), matrix.get()), "CVodeSetLinearSolver");
    require_success(CVodeSetUserData(memory.get(), this), "CVodeSetUserData");
    require_success(CVodeSetMaxNumSteps(memory.get(), 100'000), "CVodeSetMaxNumSteps");
    require_success(CVodeSetErrHandlerFn(memory.get(), Solver::quiet, nullptr), "CVodeSetErrHandlerFn");
  }

  static int rates(realtype t, N_Vector y, N_Vector dy, void* self) {
    const bool found = static_cast<Solver*>(self)->derive(t, mapped(y), mapped(dy));
    return found ? 0 : 1;  // CVODE tries a shorter step
  }
  static void quiet(int, const char*, const char*, char*, void*) {}

  std::function<bool(double, Eigen::Map<Eigen::VectorXd>, Eigen::Map<Eigen::VectorXd>)> derive;
  Owned<std::remove_pointer_t<SUNContext>> context;
  Owned<std::remove_pointer_t<N_Vector>> y, allowed;
  Owned<std::remove_pointer_t<SUNMatrix>> matrix;
  Owned<std::remove_pointer_t<SUNLinearSolver>> linear;
  Owned<void> memory;
};

SundialsBdf::SundialsBdf(const Model& model, const Settings& settings)
    : Integrator(model),
      settings_(settings),
      solver_(std::make_unique<Solver>(12 * static_cast<Eigen::Index>(model.bodies().size()))) {
  hydro::require(settings.tolerance > 0, "the tolerance of a step must be positive, got {}", settings.tolerance);
  refuse_contacts(active());
}

SundialsBdf::~SundialsBdf() = default;

bool SundialsBdf::try_step(Workspace& workspace, double h, StepReport& report) {
  const State start = workspace.state;
  const Eigen::Index n = start.velocity.size();
  Solver& s = *solver_;
  s.derive = [&](double t, Eigen::Map<Eigen::VectorXd> y, Eigen::Map<Eigen::VectorXd> dy) {
    workspace.state = displaced(start, y.head(n), start.velocity + y.tail(n), t);
    const auto there = active().balance(workspace);
    if (!there || !there->acceleration.allFinite()) return false;
    dy << displacement_rate(y.head(n), workspace.state.velocity), there->acceleration;
    return true;
  };
  const auto size = [&](const Eigen::VectorXd& x) { return x.cwiseProduct(active().scale()).norm(); };
  const double error = settings_.tolerance * (size(start.velocity) + h * size(workspace.acceleration) + 1e-300);
  mapped(s.allowed.get()) << h * error * active().scale().cwiseInverse(), error * active().scale().cwiseInverse();
  mapped(s.y.get()).setZero();
  require_success(CVodeReInit(s.memory.get(), 0, s.y.get()), "CVodeReInit");
  require_success(CVodeSVtolerances(s.memory.get(), 0, s.allowed.get()), "CVodeSVtolerances");
  require_success(CVodeSetStopTime(s.memory.get(), h), "CVodeSetStopTime");
  double reached = 0;
  const int flag = CVode(s.memory.get(), h, s.y.get(), &reached, CV_NORMAL);
  workspace.state = start;
  long iterations = 0;
  if (CVodeGetNumNonlinSolvIters(s.memory.get(), &iterations) == CV_SUCCESS)
    report.newton_iterations += static_cast<int>(iterations);
  const auto y = mapped(s.y.get());
  if (flag < 0 || !arrive(model(), active(), displaced(start, y.head(n), start.velocity + y.tail(n), h), workspace))
    return fail(fmt::format("CVODE gives up with {} after {:.3g} s of the step", flag, reached));
  return true;
}

}  // namespace dynamics
