// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_EXCEPTIONS_H
#define QUADRILLE_EXCEPTIONS_H

#include <stdexcept>
#include <string>
#include <utility>

namespace Quadrille {

/// Base of everything that the packages throw. `what()` is a complete sentence for the user: what is wrong, where,
/// and what can be done about it.
class Error : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/// An option or argument is out of its documented range, or names something that does not exist.
class Invalid_argument_error : public Error {
public:
  using Error::Error;
};

/// The input (a file or a mesh) cannot be used: unreadable, not a planar domain, not manifold, degenerate, ...
class Invalid_input_error : public Error {
public:
  using Error::Error;
};

/// A file could not be written. Nothing is left at its place.
class Output_error : public Error {
public:
  using Error::Error;
};

/// The input is fine but a stage did not reach a valid result.
class No_result_error : public Error {
public:
  No_result_error(std::string stage, const std::string& reason)
      : Error(stage + ": " + reason), m_stage(std::move(stage))
  {
  }

  /// The stage that gave up: "field", "map", "layout", "quantization" or "mesh".
  const std::string& stage() const { return m_stage; }

private:
  std::string m_stage;
};

/// The user's progress observer asked to stop.
class Cancelled_error : public Error {
public:
  using Error::Error;
};

} // namespace Quadrille

#endif
