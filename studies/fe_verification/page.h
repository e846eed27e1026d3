// Tables, pictures and page of the finite element verification, as pure functions of what was solved.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace studies {

// Tip error over L of one mesh; negative where the solve did not converge.
struct FeConvergence {
  std::string rod;  // "thick" or "thin"
  int order;
  bool full_integration;
  int elements;
  double error_over_L;
};

// 50 quadratic elements on a scene of Study I. Errors over L.
struct FeOwnError {
  std::string scene;
  double error_over_L, estimate_over_L, kirchhoff_error_over_L;
  int load_steps, newton_iterations;
};

// Newton's work under a fixed transverse tip force, |F| L^2 / EI = load.
struct FeWork {
  std::string model;
  double load;
  std::string status;
  int load_steps, newton_iterations;
};

struct FeVerification {
  std::vector<FeConvergence> convergence;
  std::vector<FeOwnError> own_errors;
  std::vector<FeWork> work;
};

// File name to content.
std::map<std::string, std::string> fe_verification_files(const FeVerification& data);

}  // namespace studies
