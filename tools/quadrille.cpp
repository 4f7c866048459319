// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Console.h"
#include "check_command.h"
#include "command_line.h"
#include "cross_command.h"
#include "quad_command.h"

#include <Quadrille/exceptions.h>

#include <iostream>
#include <new>

namespace {

enum Exit_code { done = 0, unusable_arguments = 2, unusable_input = 3, no_result = 4, interrupted = 130 };

int fail(Exit_code code, const std::string& message)
{
  std::cerr << "quadrille: error: " << message << std::endl;
  return code;
}

int run(const std::vector<std::string>& arguments)
{
  const Quadrille::Command_line command_line = Quadrille::parse_command_line(arguments);
  Quadrille::listen_to_interrupts();
  if (command_line.quad)
    Quadrille::run_quad_command(*command_line.quad);
  else if (command_line.cross)
    Quadrille::run_cross_command(*command_line.cross);
  else if (command_line.check)
    Quadrille::run_check_command(*command_line.check);
  else
    std::cout << command_line.text;
  return done;
}

} // namespace

int main(int argc, char** argv)
{
  try {
    return run(std::vector<std::string>(argv + 1, argv + argc));
  } catch (const Quadrille::Invalid_argument_error& error) {
    return fail(unusable_arguments, error.what());
  } catch (const Quadrille::Output_error& error) {
    return fail(unusable_arguments, error.what());
  } catch (const Quadrille::Invalid_input_error& error) {
    return fail(unusable_input, error.what());
  } catch (const Quadrille::Cancelled_error& error) {
    return fail(interrupted, error.what());
  } catch (const std::bad_alloc&) {
    return fail(no_result, "out of memory");
  } catch (const std::exception& error) {
    return fail(no_result, error.what());
  }
}
