#include "exact_reference/runge_kutta.h"

#include <array>

namespace exact_reference {
namespace {

constexpr int stages = 12;

struct Weight {
  int stage;
  double value;
};

// The nonzero weights, stage by stage; the last row holds those of the result.
constexpr std::array<int, stages + 2> row_start{0, 0, 1, 3, 5, 8, 11, 15, 20, 26, 33, 41, 50, 58};
constexpr std::array<Weight, 58> weights{{
    {0, 0.05260015195876773},   {0, 0.0197250569845379},   {1, 0.0591751709536137},    {0, 0.02958758547680685},
    {2, 0.08876275643042054},   {0, 0.2413651341592667},   {2, -0.8845494793282861},   {3, 0.924834003261792},
    {0, 0.037037037037037035},  {3, 0.17082860872947386},  {4, 0.12546768756682242},   {0, 0.037109375},
    {3, 0.17025221101954405},   {4, 0.06021653898045596},  {5, -0.017578125},          {0, 0.03709200011850479},
    {3, 0.17038392571223998},   {4, 0.10726203044637328},  {5, -0.015319437748624402}, {6, 0.008273789163814023},
    {0, 0.6241109587160757},    {3, -3.3608926294469414},  {4, -0.868219346841726},    {5, 27.59209969944671},
    {6, 20.154067550477894},    {7, -43.48988418106996},   {0, 0.47766253643826434},   {3, -2.4881146199716677},
    {4, -0.590290826836843},    {5, 21.230051448181193},   {6, 15.279233632882423},    {7, -33.28821096898486},
    {8, -0.020331201708508627}, {0, -0.9371424300859873},  {3, 5.186372428844064},     {4, 1.0914373489967295},
    {5, -8.149787010746927},    {6, -18.52006565999696},   {7, 22.739487099350505},    {8, 2.4936055526796523},
    {9, -3.0467644718982196},   {0, 2.273310147516538},    {3, -10.53449546673725},    {4, -2.0008720582248625},
    {5, -17.9589318631188},     {6, 27.94888452941996},    {7, -2.8589982771350235},   {8, -8.87285693353063},
    {9, 12.360567175794303},    {10, 0.6433927460157636},  {0, 0.054293734116568765},  {5, 4.450312892752409},
    {6, 1.8915178993145003},    {7, -5.801203960010585},   {8, 0.3111643669578199},    {9, -0.1521609496625161},
    {10, 0.20136540080403034},  {11, 0.04471061572777259},
}};

// Weighted sum of earlier stages in row i.
template <class Value>
Value combined(const std::array<Value, stages>& slopes, int row) {
  Value sum = weights[row_start[row]].value * slopes[weights[row_start[row]].stage];
  for (int k = row_start[row] + 1; k < row_start[row + 1]; ++k) sum += weights[k].value * slopes[weights[k].stage];
  return sum;
}

}  // namespace

State runge_kutta_step(const RodEquations& equations, const State& y, double h) {
  std::array<State, stages> slopes;
  slopes[0] = equations.derivative(y);
  for (int i = 1; i < stages; ++i) slopes[i] = equations.derivative(y + h * combined(slopes, i));
  return y + h * combined(slopes, stages);
}

State runge_kutta_step(const RodEquations& equations, const State& y, double h, CoreMatrix& sensitivity) {
  std::array<State, stages> slopes;
  std::array<CoreMatrix, stages> slope_sensitivities;
  CoreMatrix jacobian;
  slopes[0] = equations.derivative(y, slope_sensitivities[0]);
  for (int i = 1; i < stages; ++i) {
    const State stage = y + h * combined(slopes, i);
    CoreMatrix stage_sensitivity = h * combined(slope_sensitivities, i);
    stage_sensitivity.diagonal().array() += 1;
    slopes[i] = equations.derivative(stage, jacobian);
    slope_sensitivities[i] = jacobian.lazyProduct(stage_sensitivity);
  }
  sensitivity = h * combined(slope_sensitivities, stages);
  sensitivity.diagonal().array() += 1;
  return y + h * combined(slopes, stages);
}

}  // namespace exact_reference
