#include "fam/loaded_rod.h"

namespace fam {

std::size_t most_tendons(std::span<const scene::Span> spans) {
  std::size_t most = 0;
  for (const scene::Span& span : spans) most = std::max(most, span.tendons.size());
  return most;
}

template <int D>
void LoadedRod<D>::set(const LoadWay& way, std::span<const int> arcs_per_span, Law law, RodModel model) {
  way_ = way;
  arcs_per_span_.assign(arcs_per_span.begin(), arcs_per_span.end());
  law_ = law;
  model_ = model;
  load_factor_ = 1;
  int first_arc = 0;
  span_arcs_.resize(way.to.size());
  for (std::size_t i = 0; i < way.to.size(); ++i) {
    span_arcs_[i].set(way.span(i, 1), model, first_arc, arcs_per_span[i]);
    first_arc += arcs_per_span[i];
  }
}

template <int D>
void LoadedRod<D>::reserve(const Room& room) {
  arcs_per_span_.reserve(room.spans);
  span_arcs_.reserve(room.spans, [&](SpanArcs<D>& span) { span.reserve(room.tendons); });
}

template <int D>
void LoadedRod<D>::set_load(double factor) {
  load_factor_ = factor;
  for (std::size_t i = 0; i < span_arcs_.size(); ++i) span_arcs_[i].set_way(way_.span(i, factor), model_);
}

template class LoadedRod<2>;
template class LoadedRod<3>;

}  // namespace fam
