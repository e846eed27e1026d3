#include "fem_reference/band_system.h"

#include <algorithm>
#include <cmath>

extern "C" {
void dgbtrf_(const int* rows, const int* columns, const int* lower, const int* upper, double* band, const int* stride,
             int* exchanged, int* info);
void dgbtrs_(const char* transposed, const int* size, const int* lower, const int* upper, const int* columns,
             const double* band, const int* stride, const int* exchanged, double* right_hand_side, const int* stride_b,
             int* info, std::size_t length_of_transposed);
}

namespace fem_reference {

BandSystem::BandSystem(int size, int lower, int upper)
    : size_(size),
      lower_(lower),
      upper_(upper),
      rows_(2 * lower + upper + 1),
      band_(static_cast<std::size_t>(rows_ * size)),
      exchanged_(static_cast<std::size_t>(size)) {}

void BandSystem::set_zero() {
  std::fill(band_.begin(), band_.end(), 0.0);
}

void BandSystem::fix(int unknown) {
  const int last = std::min(size_ - 1, unknown + upper_);
  for (int column = std::max(0, unknown - lower_); column <= last; ++column) entry(unknown, column) = 0;
  entry(unknown, unknown) = 1;
}

bool BandSystem::factorise() {
  int info = 0;
  dgbtrf_(&size_, &size_, &lower_, &upper_, band_.data(), &rows_, exchanged_.data(), &info);
  return info == 0;
}

scene::Determinant BandSystem::determinant() const {
  scene::Determinant result;
  for (int k = 0; k < size_; ++k) {
    const double pivot = band_[static_cast<std::size_t>(k * rows_ + lower_ + upper_)];
    result.negative ^= (pivot < 0) ^ (exchanged_[static_cast<std::size_t>(k)] != k + 1);  // LAPACK counts from one
    result.log_size += std::log(std::abs(pivot));
  }
  return result;
}

void BandSystem::solve(std::vector<double>& right_hand_side) const {
  const int one = 1;
  int info = 0;
  dgbtrs_("N", &size_, &lower_, &upper_, &one, band_.data(), &rows_, exchanged_.data(), right_hand_side.data(), &size_,
          &info, 1);
}

}  // namespace fem_reference
