// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

// Random polygons with holes and sizes from file to mesh by the program: each gives a mesh that `quadrille check`
// finds valid, or an error that says which stage failed.

#include "random_polygons.h"
#include "temporary_files.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <sys/wait.h>
#include <thread>
#include <vector>

namespace {

struct Outcome {
  int code = -1, check = -1;
  std::string message;
};

class Random_polygons : public Temporary_files {
protected:
  std::string path(unsigned seed, const std::string& ending) const
  {
    return (m_folder / (std::to_string(seed) + ending)).string();
  }

  static int run(const std::string& arguments, const std::string& messages)
  {
    const std::string command = "\"" QUADRILLE_PROGRAM "\" " + arguments + " --quiet 2>\"" + messages + "\"";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  Outcome outcome(unsigned seed) const
  {
    const Quadrille::test::Random_polygon polygon(seed);
    const std::string in = path(seed, ".geo"), mesh = path(seed, ".msh"), messages = path(seed, ".txt");
    std::ofstream(in) << polygon.geo();
    double low[2] = {polygon.rings()[0][0].x(), polygon.rings()[0][0].y()}, high[2] = {low[0], low[1]};
    for (const auto& p : polygon.rings()[0])
      for (int k = 0; k < 2; ++k) {
        low[k] = std::min(low[k], p[k]);
        high[k] = std::max(high[k], p[k]);
      }
    std::ostringstream arguments; // coarse, to save time
    arguments << "quad \"" << in << "\" -o \"" << mesh << "\" --starts 1 --threads 1 --triangle-size "
              << std::hypot(high[0] - low[0], high[1] - low[1]) / 16;
    Outcome result;
    result.code = run(arguments.str(), messages);
    if (result.code == 0)
      result.check = run("check \"" + mesh + "\" --against \"" + in + "\"", messages);
    std::ostringstream text;
    text << std::ifstream(messages).rdbuf();
    result.message = text.str();
    return result;
  }
};

TEST_F(Random_polygons, give_valid_meshes_or_errors_that_name_the_stage)
{
  constexpr unsigned n = 50;
  std::vector<Outcome> outcomes(n);
  const auto work = [&](unsigned first) {
    for (unsigned i = first; i < n; i += 2)
      outcomes[i] = outcome(i + 1);
  };
  std::thread other(work, 1);
  work(0);
  other.join();
  int n_meshed = 0;
  for (unsigned i = 0; i < n; ++i) {
    const Outcome& o = outcomes[i];
    if (o.code == 0) {
      ++n_meshed;
      EXPECT_EQ(o.check, 0) << "seed " << i + 1 << ": " << o.message;
    } else {
      EXPECT_EQ(o.code, 4) << "seed " << i + 1 << ": " << o.message;
      EXPECT_EQ(o.message.rfind("quadrille: error: ", 0), 0u) << "seed " << i + 1 << ": " << o.message;
    }
  }
  EXPECT_GE(n_meshed, 46); // as coarse as this; all of them with the program's defaults
}

} // namespace
