// The banded linear system of Newton's method: SUNDIALS' band matrix and LU decomposition with partial pivoting.
#pragma once

#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_band.h>
#include <sunmatrix/sunmatrix_band.h>

namespace exact_reference {

class BandSystem {
 public:
  BandSystem(long size, long upper, long lower)
      : x_(N_VNew_Serial(size, context_)),
        matrix_(SUNBandMatrix(size, upper, lower, context_)),
        solver_(SUNLinSol_Band(x_, matrix_, context_)) {}
  ~BandSystem() {
    SUNLinSolFree(solver_);
    SUNMatDestroy(matrix_);
    N_VDestroy(x_);
  }
  BandSystem(const BandSystem&) = delete;
  BandSystem& operator=(const BandSystem&) = delete;

  void set_zero() { SUNMatZero(matrix_); }
  double& entry(long row, long column) { return SM_ELEMENT_B(matrix_, row, column); }
  bool factorise() { return SUNLinSolSetup(solver_, matrix_) == 0; }  // false: singular

  // The right hand side is put here and the solution read here.
  double* vector() { return N_VGetArrayPointer(x_); }
  bool solve() { return SUNLinSolSolve(solver_, matrix_, x_, x_, 0) == 0; }

 private:
  sundials::Context context_;
  N_Vector x_;
  SUNMatrix matrix_;
  SUNLinearSolver solver_;
};

}  // namespace exact_reference
