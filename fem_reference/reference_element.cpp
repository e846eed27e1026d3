#include "fem_reference/reference_element.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>

#include <algorithm>
#include <numeric>
#include <vector>

namespace fem_reference {

ReferenceElement::Shape ReferenceElement::shape(double x) const {
  Shape shape{List<max_nodes>::Ones(nodes()), List<max_nodes>::Zero(nodes())};
  for (int i = 0; i < nodes(); ++i) {
    for (int j = 0; j < nodes(); ++j) {
      if (j == i) continue;
      const double factor = (x - node(j)) / (node(i) - node(j));
      shape.slope(i) = shape.slope(i) * factor + shape.value(i) / (node(i) - node(j));
      shape.value(i) *= factor;
    }
  }
  return shape;
}

ReferenceElement reference_element(int order, int points) {
  const dealii::FE_Q<1> shape(static_cast<unsigned int>(order));
  const dealii::QGauss<1> gauss(static_cast<unsigned int>(points));
  // FE_Q numbers the ends first; here the nodes go from end to end.
  const std::vector<dealii::Point<1>>& support = shape.get_unit_support_points();
  std::vector<unsigned int> along(support.size());
  std::iota(along.begin(), along.end(), 0U);
  std::sort(along.begin(), along.end(), [&](unsigned int a, unsigned int b) { return support[a][0] < support[b][0]; });

  ReferenceElement element;
  element.node.resize(order + 1);
  element.point.resize(points);
  element.weight.resize(points);
  element.value.resize(points, order + 1);
  element.slope.resize(points, order + 1);
  for (int i = 0; i <= order; ++i) {
    const unsigned int function = along[static_cast<unsigned int>(i)];
    element.node(i) = support[function][0];
    for (int g = 0; g < points; ++g) {
      const dealii::Point<1>& x = gauss.point(static_cast<unsigned int>(g));
      element.value(g, i) = shape.shape_value(function, x);
      element.slope(g, i) = shape.shape_grad(function, x)[0];
    }
  }
  for (int g = 0; g < points; ++g) {
    element.point(g) = gauss.point(static_cast<unsigned int>(g))[0];
    element.weight(g) = gauss.weight(static_cast<unsigned int>(g));
  }
  return element;
}

}  // namespace fem_reference
