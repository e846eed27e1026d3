// Lagrange shape functions of one element on 0 <= x <= 1 and the quadrature they are integrated with.
#pragma once

#include <Eigen/Core>

namespace fem_reference {

constexpr int max_order = 3;
constexpr int max_nodes = max_order + 1;   // nodes of an element
constexpr int max_points = max_order + 1;  // quadrature points of an element

struct ReferenceElement {
  template <int size>
  using List = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, size, 1>;
  using Table = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, max_points, max_nodes>;

  List<max_nodes> node;     // coordinates, from end to end: node(0) = 0, the last is 1
  List<max_points> point;   // Gauss points
  List<max_points> weight;  // Gauss weights, sum 1
  Table value;              // shape functions at the points: value(point, node)
  Table slope;              // their derivatives by x

  // The shape functions of all nodes and their derivatives at any x.
  struct Shape {
    List<max_nodes> value;
    List<max_nodes> slope;
  };
  Shape shape(double x) const;

  int nodes() const { return static_cast<int>(node.rows()); }
  int points() const { return static_cast<int>(point.rows()); }
  int order() const { return nodes() - 1; }
};

// Shape functions FE_Q (Gauss-Lobatto nodes) of the given order (1 to 3), integrated with the given number of Gauss
// points: `order` of them is reduced, `order + 1` full integration.
ReferenceElement reference_element(int order, int points);

}  // namespace fem_reference
