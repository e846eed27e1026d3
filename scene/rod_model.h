// Which strains a rod has.
#pragma once

namespace scene {

enum class RodModel {
  automatic,  // FAM: Kirchhoff unless the scene stretches or shears visibly; the references: as reissner
  kirchhoff,  // bends and twists: no stretch and no shear, whatever the section says
  reissner    // stretches and shears, too, where the section says so
};

}  // namespace scene
