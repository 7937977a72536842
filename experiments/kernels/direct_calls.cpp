#include "experiments/kernels/direct_calls.h"

#include <cvode/cvode.h>
#include <ida/ida.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "experiments/runs/peers/sundials.h"

namespace irk::direct {

void rates(double, const double* y, double* f) {
  f[0] = y[1];
  f[1] = ((1 - y[0] * y[0]) * y[1] - y[0]) / kEps;
}

void jacobian(double, const double* y, double* J) {
  J[0] = 0;
  J[1] = (-2 * y[0] * y[1] - 1) / kEps;
  J[2] = 1;
  J[3] = (1 - y[0] * y[0]) / kEps;
}

namespace {

constexpr long kMaxSteps = 1'000'000;

// Vectors, a dense matrix and its solver for two unknowns.
struct Objects {
  ::sundials::Context context;
  sundials::Owner<N_Vector, N_VDestroy> y{N_VNew_Serial(2, context)}, yp{N_VClone(y.get())}, atol{N_VClone(y.get())};
  sundials::Owner<SUNMatrix, SUNMatDestroy> matrix{SUNDenseMatrix(2, 2, context)};
  sundials::Owner<SUNLinearSolver, SUNLinSolFree> solver{SUNLinSol_Dense(y.get(), matrix.get(), context)};

  explicit Objects(double tol) {
    std::copy_n(kStart, 2, N_VGetArrayPointer(y.get()));
    rates(0, kStart, N_VGetArrayPointer(yp.get()));
    N_VConst(tol, atol.get());
  }
};

Result resultOf(N_Vector y, long steps, long evaluations) {
  const double* const values = N_VGetArrayPointer(y);
  return {{values[0], values[1]}, steps, evaluations};
}

int cvodeRates(double t, N_Vector y, N_Vector f, void*) {
  rates(t, N_VGetArrayPointer(y), N_VGetArrayPointer(f));
  return 0;
}
int cvodeJacobian(double t, N_Vector y, N_Vector, SUNMatrix J, void*, N_Vector, N_Vector, N_Vector) {
  jacobian(t, N_VGetArrayPointer(y), SUNDenseMatrix_Data(J));
  return 0;
}

// F = f(y) - y', as the scene has it.
int idaResidual(double t, N_Vector y, N_Vector yp, N_Vector r, void*) {
  double* const to = N_VGetArrayPointer(r);
  rates(t, N_VGetArrayPointer(y), to);
  to[0] -= N_VGetArrayPointer(yp)[0];
  to[1] -= N_VGetArrayPointer(yp)[1];
  return 0;
}
int idaJacobian(double t, double c, N_Vector y, N_Vector, N_Vector, SUNMatrix J, void*, N_Vector, N_Vector, N_Vector) {
  double* const to = SUNDenseMatrix_Data(J);
  jacobian(t, N_VGetArrayPointer(y), to);
  to[0] -= c;
  to[3] -= c;
  return 0;
}

}  // namespace

Result cvode(double t_end, double tol) {
  Objects objects(tol);
  void* memory = CVodeCreate(CV_BDF, objects.context);
  IRK_SUNDIALS(CVodeInit(memory, cvodeRates, 0, objects.y.get()));
  IRK_SUNDIALS(CVodeSVtolerances(memory, tol, objects.atol.get()));
  IRK_SUNDIALS(CVodeSetLinearSolver(memory, objects.solver.get(), objects.matrix.get()));
  IRK_SUNDIALS(CVodeSetJacFn(memory, cvodeJacobian));
  IRK_SUNDIALS(CVodeSetMaxNumSteps(memory, kMaxSteps));
  IRK_SUNDIALS(CVodeSetStopTime(memory, t_end));
  double t = 0;
  IRK_SUNDIALS(CVode(memory, t_end, objects.y.get(), &t, CV_NORMAL));
  long steps = 0, evaluations = 0;
  IRK_SUNDIALS(CVodeGetNumSteps(memory, &steps));
  IRK_SUNDIALS(CVodeGetNumRhsEvals(memory, &evaluations));
  CVodeFree(&memory);
  return resultOf(objects.y.get(), steps, evaluations);
}

Result ida(double t_end, double tol) {
  Objects objects(tol);
  void* memory = IDACreate(objects.context);
  IRK_SUNDIALS(IDAInit(memory, idaResidual, 0, objects.y.get(), objects.yp.get()));
  IRK_SUNDIALS(IDASVtolerances(memory, tol, objects.atol.get()));
  IRK_SUNDIALS(IDASetLinearSolver(memory, objects.solver.get(), objects.matrix.get()));
  IRK_SUNDIALS(IDASetJacFn(memory, idaJacobian));
  IRK_SUNDIALS(IDASetMaxNumSteps(memory, kMaxSteps));
  IRK_SUNDIALS(IDASetStopTime(memory, t_end));
  double t = 0;
  IRK_SUNDIALS(IDASolve(memory, t_end, &t, objects.y.get(), objects.yp.get(), IDA_NORMAL));
  long steps = 0, evaluations = 0;
  IRK_SUNDIALS(IDAGetNumSteps(memory, &steps));
  IRK_SUNDIALS(IDAGetNumResEvals(memory, &evaluations));
  IDAFree(&memory);
  return resultOf(objects.y.get(), steps, evaluations);
}

namespace {

extern "C" {
using Fcn = void(int* n, double* x, double* y, double* f, double* rpar, int* ipar);
using Jac = void(int* n, double* x, double* y, double* dfy, int* ldfy, double* rpar, int* ipar);
using Mas = void(int* n, double* am, int* lmas, double* rpar, int* ipar);
using Solout = void(int* nr, double* xold, double* x, double* y, double* cont, int* lrc, int* n, double* rpar,
                    int* ipar, int* irtrn);
using Radau = void(int* n, Fcn*, double* x, double* y, double* xend, double* h, double* rtol, double* atol, int* itol,
                   Jac*, int* ijac, int* mljac, int* mujac, Mas*, int* imas, int* mlmas, int* mumas, Solout*, int* iout,
                   double* work, int* lwork, int* iwork, int* liwork, double* rpar, int* ipar, int* idid);

void radauFcn(int*, double* x, double* y, double* f, double*, int*) { rates(*x, y, f); }
void radauJac(int*, double* x, double* y, double* dfy, int*, double*, int*) { jacobian(*x, y, dfy); }
void radauMas(int*, double*, int*, double*, int*) {}
void radauSolout(int*, double*, double*, double*, double*, int*, int*, double*, int*, int*) {}
}

}  // namespace

Result radau(void (*code)(), double t_end, double tol, double h, int max_steps) {
  // The places in WORK and IWORK are those in the comments at the head of RADAU and RADAU5.
  constexpr int kMaxStepsAt = 1, kEvaluationsAt = 13, kStepsAt = 16;
  Result result{{kStart[0], kStart[1]}};
  std::vector<double> work(500, 0);
  std::vector<int> iwork(100, 0);
  iwork[kMaxStepsAt] = max_steps;
  double x = 0, rtol[2] = {tol, tol}, atol[2] = {tol, tol}, rpar = 0;
  int n = 2, itol = 1, ijac = 1, mljac = 2, mujac = 0, imas = 0, mlmas = 2, mumas = 0, iout = 1, ipar = 0, idid = 0;
  int lwork = static_cast<int>(work.size()), liwork = static_cast<int>(iwork.size());
  reinterpret_cast<Radau*>(code)(&n, radauFcn, &x, result.y, &t_end, &h, rtol, atol, &itol, radauJac, &ijac, &mljac,
                                 &mujac, radauMas, &imas, &mlmas, &mumas, radauSolout, &iout, work.data(), &lwork,
                                 iwork.data(), &liwork, &rpar, &ipar, &idid);
  if (idid < 0) throw std::runtime_error("radau returned IDID = " + std::to_string(idid));
  result.evaluations = iwork[kEvaluationsAt];
  result.steps = iwork[kStepsAt];
  return result;
}

}  // namespace irk::direct
