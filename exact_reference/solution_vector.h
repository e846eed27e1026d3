// A solution of the continuation as one vector: the first ten components of all node states and, last, the parameter.
#pragma once

#include "exact_reference/shooting.h"

namespace exact_reference {

NodeStates node_states_of(const Eigen::VectorXd& x);
Eigen::VectorXd solution_of(const NodeStates& y, double parameter);

// Values at one mesh's nodes as values at another's, linear between them; the last number stays.
Eigen::VectorXd interpolated(const Eigen::VectorXd& a, const std::vector<double>& from, const std::vector<double>& to);

// How it changes as it is turned about the base frame's x axis, each section against that.
Eigen::VectorXd turned_about_axis(const Eigen::VectorXd& x);

// No direction of it is known beforehand: neither symmetric nor antisymmetric to anything.
Eigen::VectorXd any_vector(long size, double seed);

}  // namespace exact_reference
