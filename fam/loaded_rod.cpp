#include "fam/loaded_rod.h"

namespace fam {

template <int D>
LoadedRod<D>::LoadedRod(std::span<const scene::Span> spans, std::span<const int> arcs_per_span, Law law, RodModel model)
    : spans_(spans.begin(), spans.end()),
      arcs_per_span_(arcs_per_span.begin(), arcs_per_span.end()),
      law_(law),
      model_(model) {
  int first_arc = 0;
  span_arcs_.reserve(spans_.size());
  for (std::size_t i = 0; i < spans_.size(); ++i) {
    span_arcs_.emplace_back(spans_[i], model, first_arc, arcs_per_span_[i]);
    first_arc += arcs_per_span_[i];
  }
}

template <int D>
void LoadedRod<D>::set_load(double factor) {
  load_factor_ = factor;
  for (std::size_t i = 0; i < spans_.size(); ++i) span_arcs_[i].set_load(spans_[i], model_, factor);
}

template class LoadedRod<2>;
template class LoadedRod<3>;

}  // namespace fam
