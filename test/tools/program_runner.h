// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_TEST_TOOLS_PROGRAM_RUNNER_H
#define QUADRILLE_TEST_TOOLS_PROGRAM_RUNNER_H

#include "temporary_files.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;

namespace Quadrille_test {

/// Runs the program in a folder of its own for every test.
class Program_runner : public Temporary_files {
protected:
  Program_runner() { std::filesystem::create_directory(path("out")); }
  ~Program_runner() override { std::filesystem::permissions(path("out"), std::filesystem::perms::owner_all); }

  /// Starts the program; its outputs go to the files "stdout" and "stderr".
  pid_t start(std::vector<std::string> arguments)
  {
    arguments.insert(arguments.begin(), QUADRILLE_PROGRAM);
    std::vector<char*> argv;
    for (std::string& argument : arguments)
      argv.push_back(argument.data());
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    const std::string out = path("stdout"), err = path("stderr");
    posix_spawn_file_actions_addopen(&actions, 1, out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    posix_spawn_file_actions_addopen(&actions, 2, err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    pid_t child = 0;
    EXPECT_EQ(::posix_spawn(&child, QUADRILLE_PROGRAM, &actions, nullptr, argv.data(), environ), 0);
    posix_spawn_file_actions_destroy(&actions);
    return child;
  }

  static int wait_for(pid_t child)
  {
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
  }

  int run(const std::vector<std::string>& arguments)
  {
    const int code = wait_for(start(arguments));
    m_error = content(path("stderr"));
    m_output = content(path("stdout"));
    return code;
  }

  std::string m_output, m_error;
};

} // namespace Quadrille_test

#endif
