// Rods for ParaView, read back by VTK's own reader: tests/python/test_vtk.py.
#include "commands.h"

#include <gtest/gtest.h>

namespace {

TEST(Vtk, ReadBack) {
  const std::string tests = std::string(PROJECT_FOLDER) + "/tests/python/test_vtk.py";
  setenv("FAM_COMMAND", FAM_COMMAND, 1);
  setenv("PYTHONDONTWRITEBYTECODE", "1", 1);
  const commands::Outcome outcome = commands::run(PYTHON, "-m pytest -q -p no:cacheprovider " + tests);
  EXPECT_EQ(outcome.exit_status, 0) << outcome.out << outcome.err;
  EXPECT_NE(outcome.out.find(" passed"), std::string::npos) << outcome.out;
  EXPECT_EQ(outcome.out.find("skipped"), std::string::npos) << outcome.out;
}

}  // namespace
