// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_RUN_IN_CHILD_PROCESS_H
#define QUADRILLE_MESH_IO_INTERNAL_RUN_IN_CHILD_PROCESS_H

#include <Quadrille/Mesh_io/internal/Byte_archive.h>
#include <Quadrille/exceptions.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <string>
#include <vector>

#if defined(__unix__) || defined(__APPLE__)
#define QUADRILLE_HAS_CHILD_PROCESSES
#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif
#endif

namespace Quadrille {
namespace internal {

/// The child ended without a result: it crashed, or called exit().
class Abnormal_end_error : public Invalid_input_error {
public:
  using Invalid_input_error::Invalid_input_error;
};

#ifdef QUADRILLE_HAS_CHILD_PROCESSES

/// Writes all bytes; the parent may be gone, which is nobody's error.
inline void write_all(int file, const std::vector<char>& bytes)
{
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t n = ::write(file, bytes.data() + done, bytes.size() - done);
    if (n < 0 && errno != EINTR)
      return;
    done += n > 0 ? std::size_t(n) : 0;
  }
}

/// The child's life: compute, send, vanish without running the parent's exit handlers.
template <class Result, class Function> [[noreturn]] void run_child(int output, const Function& function)
{
#ifdef __linux__
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
  ::signal(SIGINT, SIG_DFL);
  ::signal(SIGTERM, SIG_DFL);
  ::signal(SIGPIPE, SIG_IGN);
  const int null_device = ::open("/dev/null", O_RDWR);
  if (null_device >= 0)
    for (int standard = 0; standard < 3; ++standard)
      ::dup2(null_device, standard);
  Byte_writer writer;
  try {
    Result result = function();
    writer('r');
    writer(result);
  } catch (const Error& error) {
    writer.bytes.clear();
    writer('e', std::string(error.what()));
  } catch (const std::exception& error) {
    writer.bytes.clear();
    writer('x', std::string(error.what()));
  }
  write_all(output, writer.bytes);
  ::_exit(0);
}

/// Reads until the other end closes. Returns false when the time is over.
inline bool read_all(int file, double time_limit_seconds, std::vector<char>& bytes)
{
  const auto start = std::chrono::steady_clock::now();
  char buffer[65536];
  for (;;) {
    const double left =
        time_limit_seconds - std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (left <= 0)
      return false;
    pollfd wait{file, POLLIN, 0};
    if (::poll(&wait, 1, int(std::min(left, 1e5) * 1000) + 1) <= 0)
      continue;
    const ssize_t n = ::read(file, buffer, sizeof buffer);
    if (n < 0 && errno == EINTR)
      continue;
    if (n <= 0)
      return true;
    bytes.insert(bytes.end(), buffer, buffer + n);
  }
}

/// Calls `function()` in a child process and returns its result (exchanged by `exchange(archive, result)`).
///
/// Whatever happens to the child (a crash, an endless loop, a call of exit()) comes back as `Invalid_input_error` (or
/// `Abnormal_end_error`) that starts with `subject` and blames `worker`; so do the errors that `function` throws,
/// unchanged.
template <class Result, class Function>
Result run_in_child_process(const Function& function, double time_limit_seconds, const std::string& subject,
                            const std::string& worker = "the geometry kernel")
{
  int ends[2];
  if (::pipe(ends) != 0)
    throw Error("cannot create a pipe to a child process");
  const pid_t child = ::fork();
  if (child < 0) {
    ::close(ends[0]);
    ::close(ends[1]);
    throw Error("cannot create a child process");
  }
  if (child == 0) {
    ::close(ends[0]);
    run_child<Result>(ends[1], function);
  }
  ::close(ends[1]);
  std::vector<char> bytes;
  const bool in_time = read_all(ends[0], time_limit_seconds, bytes);
  ::close(ends[0]);
  if (!in_time)
    ::kill(child, SIGKILL);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!in_time) {
    char seconds[40];
    std::snprintf(seconds, sizeof seconds, "%.3g", std::max(time_limit_seconds, 0.0));
    throw Invalid_input_error(subject + ": " + worker + " did not finish within " + seconds + " seconds");
  }
  if (bytes.empty())
    throw Abnormal_end_error(subject + ": " + worker + " ended abnormally (" +
                             (WIFSIGNALED(status) ? "signal " + std::to_string(WTERMSIG(status)) : "it called exit") +
                             ")");
  Byte_reader reader(bytes);
  char kind = 0;
  reader(kind);
  if (kind == 'r') {
    Result result;
    reader(result);
    return result;
  }
  std::string message;
  reader(message);
  throw Invalid_input_error(kind == 'e' ? message : subject + ": " + message);
}

#else

template <class Result, class Function>
Result run_in_child_process(const Function& function, double, const std::string&, const std::string& = {})
{
  return function();
}

#endif

} // namespace internal
} // namespace Quadrille

#endif
