#include "fem_reference/condensed_element.h"

#include <cmath>
#include <utility>

namespace fem_reference {

namespace {

void append(std::vector<int>& places, int first, const std::vector<int>& components) {
  for (const int component : components) places.push_back(first + component);
}

// Displacements of nodes 1.. and forces.
std::vector<int> followers(const ReferenceElement& reference, const std::vector<int>& translations) {
  std::vector<int> places;
  for (int i = 1; i < reference.nodes(); ++i) append(places, 6 * i, translations);
  for (int g = 0; g < reference.points(); ++g) append(places, 6 * reference.nodes() + 3 * g, translations);
  return places;
}

}  // namespace

ElementParting parting(const ReferenceElement& reference, const Motions& motions) {
  const int last = reference.order(), translations = static_cast<int>(motions.translations.size());
  ElementParting result;
  result.nodes = reference.nodes();
  result.inner = followers(reference, motions.translations);
  for (int i = 1; i < last; ++i) append(result.inner, 6 * i + 3, motions.rotations);
  for (const int node : {0, last}) append(result.rotations, 6 * node + 3, motions.rotations);
  append(result.forces, 0, motions.translations);
  for (int c = 0; c < translations; ++c) result.end_forces.push_back(translations * (last - 1) + c);
  return result;
}

ElementParting rotations_apart(const ReferenceElement& reference) {
  const Motions all;
  ElementParting result;
  result.nodes = reference.nodes();
  result.inner = followers(reference, all.translations);
  for (int i = 0; i < reference.nodes(); ++i) append(result.rotations, 6 * i + 3, all.rotations);
  return result;
}

bool CondensedElement::condense(const ElementParting& parting, const ElementSystem& system) {
  gather(parting, system);
  return eliminate();
}

void CondensedElement::gather(const ElementParting& parting, const ElementSystem& system) {
  inner_ = static_cast<int>(parting.inner.size());
  const int rotations = static_cast<int>(parting.rotations.size()), forces = static_cast<int>(parting.forces.size());
  const int size = inner_ + rotations + forces;
  table_.resize(size, size + 1);
  const auto fill_columns = [&](int row, const auto& entry) {
    double* cells = &table_(row, 0);
    for (const int column : parting.inner) *cells++ = entry(column);
    for (const int column : parting.rotations) *cells++ = entry(column);
    for (int c = 0; c < forces; ++c) *cells++ = 0;
  };
  const auto fill_row = [&](int row, int from) {
    fill_columns(row, [&](int column) { return system.tangent(from, column); });
  };
  int row = 0;
  for (const int from : parting.inner) fill_row(row++, from);
  for (const int from : parting.rotations) fill_row(row++, from);
  for (int c = 0; c < forces; ++c) {
    table_(parting.end_forces[static_cast<std::size_t>(c)], inner_ + rotations + c) = 1;
    // Internal forces cancel in the sum: loads that turn with the rod are left.
    const int first = parting.forces[static_cast<std::size_t>(c)];
    fill_columns(row++, [&](int column) {
      const bool is_rotation = column < 6 * parting.nodes && column % 6 >= 3;
      double entry = 0;
      for (int i = 0; is_rotation && i < parting.nodes; ++i) entry += system.tangent(first + 6 * i, column);
      return entry;
    });
  }
  gather_residual(parting, system.residual);
}

void CondensedElement::gather_residual(const ElementParting& parting, const ElementResidual& residual) {
  const Eigen::Index column = table_.rows();
  Eigen::Index row = 0;
  for (const int from : parting.inner) table_(row++, column) = -residual[from];
  for (const int from : parting.rotations) table_(row++, column) = -residual[from];
  for (const int first : parting.forces) {
    double sum = 0;
    for (int i = 0; i < parting.nodes; ++i) sum -= residual[first + 6 * i];
    table_(row++, column) = sum;
  }
}

void CondensedElement::set_residual(const ElementParting& parting, const ElementResidual& residual) {
  gather_residual(parting, residual);
  auto right_side = table_.col(table_.rows());
  for (int k = 0; k < inner_; ++k) std::swap(right_side[k], right_side[pivot_rows_[static_cast<std::size_t>(k)]]);
  for (int k = 0; k < inner_; ++k) {
    const Eigen::Index below = table_.rows() - k - 1;
    right_side.tail(below) -= right_side[k] * table_.col(k).tail(below);
  }
}

// Gauss' elimination of the inner unknowns, the pivots sought in their own rows.
bool CondensedElement::eliminate() {
  const int rows = static_cast<int>(table_.rows()), columns = rows + 1;
  for (int k = 0; k < inner_; ++k) {
    int pivot_row = k;
    for (int i = k + 1; i < inner_; ++i) {
      if (std::abs(table_(i, k)) > std::abs(table_(pivot_row, k))) pivot_row = i;
    }
    pivot_rows_[static_cast<std::size_t>(k)] = pivot_row;
    if (pivot_row != k) table_.row(k).swap(table_.row(pivot_row));
    const double* top = &table_(k, 0);
    if (!(std::abs(top[k]) > 0)) return false;
    const double inverse = 1 / top[k];
    for (int i = k + 1; i < rows; ++i) {
      double* below = &table_(i, 0);
      const double factor = below[k] *= inverse;
      if (factor == 0) continue;
      for (int j = k + 1; j < columns; ++j) below[j] -= factor * top[j];
    }
  }
  return true;
}

scene::Determinant CondensedElement::inner_determinant() const {
  scene::Determinant result;
  for (int k = 0; k < inner_; ++k) {
    result.negative ^= (table_(k, k) < 0) ^ (pivot_rows_[static_cast<std::size_t>(k)] != k);
    result.log_size += std::log(std::abs(table_(k, k)));
  }
  return result;
}

void CondensedElement::recover(Eigen::Ref<Eigen::VectorXd> increments) const {
  const Eigen::Index size = table_.rows();
  for (Eigen::Index k = inner_ - 1; k >= 0; --k) {
    const Eigen::Index known = size - k - 1;
    increments[k] = (table_(k, size) - table_.row(k).segment(k + 1, known).dot(increments.tail(known))) / table_(k, k);
  }
}

}  // namespace fem_reference
