// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_TOOLS_CONSOLE_H
#define QUADRILLE_TOOLS_CONSOLE_H

#include <Quadrille/Progress_observer.h>

#include <string>

namespace Quadrille {

/// From now on Ctrl-C asks the running computation to stop; a second one ends the program at once.
void listen_to_interrupts();

/// What the program says: results on standard output, progress on standard error when that is a terminal.
class Console {
public:
  explicit Console(bool quiet);
  ~Console();
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;

  /// A line of the report, unless quiet.
  void print(const std::string& line);

  /// Shows progress and passes interrupts on. Valid as long as the console.
  const Progress_observer& observer() const { return m_observer; }

private:
  bool show(const std::string& stage, double fraction);
  void clear_progress();

  bool m_quiet;
  bool m_shows_progress;
  std::string m_shown;
  Progress_observer m_observer;
};

} // namespace Quadrille

#endif
