// The banded linear system of Newton's method: SUNDIALS' band matrix and LU decomposition with partial pivoting.
#pragma once

#include "exact_reference/shooting.h"

#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_band.h>
#include <sunmatrix/sunmatrix_band.h>

#include <cmath>

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
  long size() const { return SM_COLUMNS_B(matrix_); }
  long upper() const { return SM_UBAND_B(matrix_); }
  long lower() const { return SM_LBAND_B(matrix_); }
  bool factorise() { return SUNLinSolSetup(solver_, matrix_) == 0; }  // false: singular

  // The determinant of the matrix last factorised: its sign, of the pivots and of the row exchanges, and the logarithm
  // of its size.
  scene::Determinant determinant() const {
    const sunindextype* exchanged = static_cast<SUNLinearSolverContent_Band>(solver_->content)->pivots;
    scene::Determinant result;
    for (long k = 0; k < SM_COLUMNS_B(matrix_); ++k) {
      const double pivot = SM_ELEMENT_B(matrix_, k, k);
      result.negative ^= (pivot < 0) ^ (exchanged[k] != k);
      result.log_size += std::log(std::abs(pivot));
    }
    return result;
  }

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
