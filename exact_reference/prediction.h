// Where the equilibria of a growing load go next: the path's tangent and, to second order, how it has changed over the
// last step, if the mesh is still that one and the change was small: beside a bifurcation it is not.
//
// Sections turn about the base's axes and take their moments along, forces stay in the base frame; so a rod that winds
// up by whole turns in a step is predicted as well as one that hardly moves.
#pragma once

#include "exact_reference/shooting.h"

#include <vector>

namespace exact_reference {

class Prediction {
 public:
  // The next step starts from these states; tangent: d(states)/d(load) there.
  void start_at(const NodeStates& y, double load, const std::vector<Core>& tangent);
  // The states, a step of the load ahead of those.
  NodeStates ahead(const NodeStates& y, double step) const;

 private:
  // Of a node, by the load: turn about the base's axes, force in the base frame, moment in the section frame.
  using Rates = Eigen::Matrix<double, 9, 1>;
  static Rates rates_of(const State& y, const Core& tangent);
  bool is_smooth() const;

  std::vector<Rates> rates_, last_rates_;
  double load_ = 0, last_step_ = 0;
};

}  // namespace exact_reference
