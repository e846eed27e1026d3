#include "fam/batch.h"

#include "fam/batch_rows.h"

#include "scene/load_visitor.h"
#include "scene/text.h"

#include <atomic>
#include <future>
#include <limits>
#include <thread>

namespace fam {
namespace {

using scene::Load;
using scene::SceneError;
using scene::text;

[[noreturn]] void refuse(const std::string& path, const std::string& value, const std::string& rule) {
  throw SceneError(path + " = " + value + ": " + rule);
}

void check(std::vector<Load>& loads, std::span<const BatchColumn> columns) {
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const auto [load, component] = columns[i];
    const std::string path = "columns[" + std::to_string(i) + "]";
    if (load >= loads.size()) {
      refuse(path + ".load", std::to_string(load),
             "must name one of the scene's " + std::to_string(loads.size()) + " loads, counted from 0");
    }
    const std::size_t components = scene::numbers_of(loads[load]).size();
    if (component < 0 || static_cast<std::size_t>(component) >= components) {
      refuse(path + ".component", std::to_string(component),
             components == 1 ? "must be 0, the tension of a tendon" : "must be 0, 1 or 2");
    }
    for (std::size_t before = 0; before < i; ++before) {
      if (columns[before].load == load && columns[before].component == component)
        refuse(path, "{" + std::to_string(load) + ", " + std::to_string(component) + "}", "the column is given twice");
    }
  }
}

void check(const std::vector<Load>& loads, std::span<const BatchColumn> columns,
           const Eigen::Ref<const RowMajorMatrix>& values) {
  if (static_cast<std::size_t>(values.cols()) != columns.size()) {
    refuse("values", std::to_string(values.cols()) + " columns",
           "must have " + std::to_string(columns.size()) + ", one for each of columns");
  }
  constexpr double most = std::numeric_limits<double>::max();
  Eigen::RowVectorXd least = Eigen::RowVectorXd::Constant(values.cols(), -most);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (scene::tendon_of(loads[columns[i].load])) least[static_cast<Eigen::Index>(i)] = 0;
  }
  for (Eigen::Index row = 0; row < values.rows(); ++row) {
    for (Eigen::Index column = 0; column < values.cols(); ++column) {
      const double value = values(row, column);
      if (value >= least[column] && value <= most) continue;  // NaN is neither
      refuse("values[" + std::to_string(row) + "][" + std::to_string(column) + "]", text(value),
             least[column] == 0 ? "must be >= 0" : "must be finite");
    }
  }
}

// Rows that a thread takes at a time.
constexpr Eigen::Index block = 512;

}  // namespace

BatchResult solve_batch(const scene::Scene& scene, std::span<const BatchColumn> columns,
                        Eigen::Ref<const RowMajorMatrix> values, const Options& options) {
  scene::validate(scene);
  validate(options);
  std::vector<Load> loads = scene.loads;
  check(loads, columns);
  check(loads, columns, values);
  BatchResult result = room_for(values.rows());
  std::atomic<Eigen::Index> next{0};
  const auto work = [&] {
    BatchRows rows(scene, columns, values, options, result);
    for (Eigen::Index begin; (begin = next.fetch_add(block)) < values.rows();) {
      rows.solve(begin, std::min(begin + block, values.rows()));
    }
  };
  const auto wanted =
      options.threads > 0 ? static_cast<unsigned>(options.threads) : std::thread::hardware_concurrency();
  const auto blocks = static_cast<std::size_t>((values.rows() + block - 1) / block);
  std::vector<std::future<void>> others;
  for (std::size_t k = 1; k < std::min<std::size_t>(wanted, blocks); ++k)
    others.push_back(std::async(std::launch::async, work));
  work();
  for (std::future<void>& other : others) other.get();
  return result;
}

}  // namespace fam
