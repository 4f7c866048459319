// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Quad_run.h"

#include <Quadrille/exceptions.h>
#include <Quadrille/write_file.h>

#include <thread>

namespace Quadrille {

void Quad_run::run()
{
  prepare();
  try {
    compute();
  } catch (const Error& error) {
    write_what_there_is();
    const auto* no_result = dynamic_cast<const No_result_error*>(&error);
    Json failed = summary();
    failed["error"] = {{"stage", no_result ? no_result->stage() : "run"}, {"message", error.what()}};
    write_summary(std::move(failed));
    throw;
  }
  write();
  write_summary(summary());
  report();
}

double Quad_run::seconds() const
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - m_start).count();
}

void Quad_run::print_notes(const std::vector<std::string>& notes)
{
  for (const std::string& note : notes)
    m_console.print(note);
}

void Quad_run::write_summary(Json summary) const
{
  if (m_arguments.json.empty())
    return;
  summary["seconds"] = seconds();
  summary["threads"] = m_arguments.threads > 0 ? m_arguments.threads : int(std::thread::hardware_concurrency());
  summary["seed"] = m_arguments.seed;
  summary["version"] = QUADRILLE_VERSION;
  write_file(m_arguments.json, summary.dump(2) + "\n");
}

} // namespace Quadrille
