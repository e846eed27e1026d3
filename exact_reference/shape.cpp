#include "exact_reference/shape.h"

#include "exact_reference/stations.h"

namespace exact_reference {
namespace {

std::vector<PlacedState> node_states(const ScaledRod& rod, const Mesh& mesh, const NodeStates& y) {
  std::vector<PlacedState> states{{0, y[0]}};
  for (std::size_t i = 0; i < mesh.size(); ++i) {
    const double span_end = rod.spans[static_cast<std::size_t>(mesh[i].span)].end;
    states.push_back({mesh[i].ends_span ? span_end : mesh[i + 1].start, y[i + 1]});
  }
  return states;
}

// Each by a step of its own from the node before it, so that it is as accurate as the nodes.
std::vector<PlacedState> states_at(const std::vector<double>& places, const ScaledRod& rod, const Shooting& shooting,
                                   const NodeStates& y) {
  const Mesh& mesh = shooting.mesh();
  std::vector<PlacedState> states{{0, y[0]}};
  std::size_t i = 0;
  for (std::size_t k = 1; k < places.size(); ++k) {
    while (i + 1 < mesh.size() && places[k] > mesh[i + 1].start) ++i;
    State state = y[i + 1];
    if (!(mesh[i].ends_span && places[k] >= rod.spans[static_cast<std::size_t>(mesh[i].span)].end)) {
      state = runge_kutta_step(shooting.equations(i, 1), shooting.start_state(y, 1, i), places[k] - mesh[i].start);
    }
    states.push_back({places[k], state});
  }
  return states;
}

}  // namespace

void set_shape(scene::Equilibrium& result, const ScaledRod& rod, const Shooting& shooting, const NodeStates& y) {
  const std::vector<PlacedState> nodes = node_states(rod, shooting.mesh(), y);
  set_shape(result, rod, states_at(station_places(rod, turns_of(rod, nodes)), rod, shooting, y));
  result.tendon_shortening_mm = tendon_shortening_mm(rod, nodes);
}

std::vector<scene::Station> stations_at(const std::vector<scene::Station>& places, const ScaledRod& rod,
                                        const Shooting& shooting, const NodeStates& y) {
  std::vector<double> at;
  for (const scene::Station& station : places) at.push_back(station.s_mm / rod.length_mm);
  return stations_of(rod, states_at(at, rod, shooting, y));
}

bool tendon_has_collapsed(const ScaledRod& rod, const Shooting& shooting, const NodeStates& y, double load_factor) {
  constexpr double collapsed = 1e-4;
  for (std::size_t i = 0; i < shooting.mesh().size(); ++i) {
    const ScaledSpan& span = rod.spans[static_cast<std::size_t>(shooting.mesh()[i].span)];
    const RodEquations equations = shooting.equations(i, load_factor);
    for (const State& state : {shooting.start_state(y, load_factor, i), y[i + 1]}) {
      const Strains strains = equations.strains(state);
      for (const ScaledTendon& tendon : span.tendons) {
        if ((strains.stretch_S + strains.curvature_S.cross(tendon.arm_S)).norm() < collapsed) return true;
      }
    }
  }
  return false;
}

}  // namespace exact_reference
