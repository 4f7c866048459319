// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_TOOLS_QUAD_RUN_H
#define QUADRILLE_TOOLS_QUAD_RUN_H

#include "Console.h"
#include "command_line.h"

#include <nlohmann/json.hpp>

#include <chrono>
#include <string>
#include <vector>

namespace Quadrille {

/// One run of `quadrille quad`, on a planar domain or on a surface: what both have in common.
class Quad_run {
public:
  Quad_run(const Quad_arguments& arguments, std::chrono::steady_clock::time_point start)
      : m_arguments(arguments), m_console(arguments.quiet), m_start(start)
  {
  }
  virtual ~Quad_run() = default;
  Quad_run(const Quad_run&) = delete;
  Quad_run& operator=(const Quad_run&) = delete;

  /// A run that fails leaves its JSON summary, with the reason.
  void run();

protected:
  using Json = nlohmann::ordered_json;

  /// Everything that may be wrong with the options.
  virtual void prepare() = 0;
  virtual void compute() = 0;
  virtual void write() = 0;
  /// What is of use where `compute()` failed.
  virtual void write_what_there_is() {}
  /// Of the JSON summary, "input" and what the stages have to say, as far as the run got.
  virtual Json summary() const = 0;
  virtual void report() = 0;

  double seconds() const;
  void print_notes(const std::vector<std::string>& notes);

  const Quad_arguments& m_arguments;
  Console m_console;

private:
  void write_summary(Json summary) const;

  std::chrono::steady_clock::time_point m_start;
};

} // namespace Quadrille

#endif
