// The solving of the segmentation study: marches with given numbers of arcs, and searches over them.
#pragma once

#include "studies/segmentation/data.h"

#include "scene/scene.h"

namespace studies {

extern const std::vector<int> all_arcs;  // of P4, 1 to a million
extern const std::vector<int> few_arcs;  // of the other cases

// Rod and tip load of a uniform planar scene.
exact_reference::PlanarCantilever cantilever_of(const scene::Scene& scene);

// The sweep of one case, appended to points and references; `fixed`: the same load components, fixed in space.
void sweep_case(const std::string& load_case, const scene::Scene& scene, const scene::Scene& fixed,
                SegmentationData& data);

// Of the laws and of the automatic choice, for all arc_limits_mm.
void find_fewest_arcs(const std::string& load_case, const scene::Scene& scene, SegmentationData& data);

void find_budgets(const scene::Scene& p4, SegmentationData& data);
void draw_shapes(const scene::Scene& p4, SegmentationData& data);

}  // namespace studies
