// What the finite element verification solved, and what it writes of it.
#pragma once

#include <filesystem>
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

// 50 quadratic elements on a scene of Study I. Errors over L; negative where a solve did not converge.
struct FeOwnError {
  std::string scene;
  double error_over_L, estimate_over_L, kirchhoff_error_over_L;
  double length_mm;
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

constexpr double fe_floor_over_L = 1e-11;  // errors below are shown as this: round-off of solves of this condition
constexpr int fe_coarse = 16;              // elements, of the table

// Error of one mesh; negative where it did not converge.
double fe_error(const FeVerification& data, const std::string& rod, int order, bool full, int elements);

// log2 of the ratio of the errors of the two finest meshes that are both clear of round-off (ten times the floor).
double observed_order(const FeVerification& data, const std::string& rod, int order, bool full);

std::string fe_convergence_csv(const FeVerification& data);
std::string fe_own_error_csv(const FeVerification& data);
std::string fe_work_csv(const FeVerification& data);
std::string fe_order_table(const FeVerification& data);  // Markdown
std::string fe_work_table(const FeVerification& data);

std::string fe_convergence_picture(const FeVerification& data);
std::string fe_own_error_picture(const FeVerification& data);

// File name to content.
std::map<std::string, std::string> fe_verification_files(const FeVerification& data,
                                                         const std::filesystem::path& page_md);

}  // namespace studies
