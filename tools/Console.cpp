// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Console.h"

#include <csignal>
#include <iostream>
#include <mutex>

#include <unistd.h>

namespace Quadrille {

namespace {

volatile std::sig_atomic_t interrupted = 0;

extern "C" void handle_interrupt(int)
{
  interrupted = 1;
  std::signal(SIGINT, SIG_DFL);
}

std::mutex show_mutex;

} // namespace

void listen_to_interrupts() { std::signal(SIGINT, handle_interrupt); }

Console::Console(bool quiet)
    : m_quiet(quiet), m_shows_progress(!quiet && ::isatty(STDERR_FILENO) == 1),
      m_observer([this](const std::string& stage, double fraction) { return show(stage, fraction); })
{
}

Console::~Console() { clear_progress(); }

void Console::print(const std::string& line)
{
  clear_progress();
  if (!m_quiet)
    std::cout << line << std::endl;
}

bool Console::show(const std::string& stage, double fraction)
{
  if (interrupted)
    return false;
  if (m_shows_progress) {
    const std::lock_guard<std::mutex> lock(show_mutex);
    const std::string text = stage + " " + std::to_string(int(100 * fraction)) + " %";
    if (text != m_shown)
      std::cerr << "\r\033[K" << text << std::flush;
    m_shown = text;
  }
  return true;
}

void Console::clear_progress()
{
  if (!m_shown.empty())
    std::cerr << "\r\033[K" << std::flush;
  m_shown.clear();
}

} // namespace Quadrille
