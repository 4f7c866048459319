// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_PROGRESS_OBSERVER_H
#define QUADRILLE_PROGRESS_OBSERVER_H

#include <Quadrille/exceptions.h>

#include <functional>
#include <string>

namespace Quadrille {

/// Reports progress of long computations and lets the caller stop them.
///
/// The callback receives the stage's name and the fraction of that stage that is done, in [0, 1]; it returns `true` to
/// go on and `false` to cancel, which makes the running function throw `Cancelled_error`. It may be called from
/// several threads, never concurrently for one observer that was given to one computation with one thread.
class Progress_observer {
public:
  using Callback = std::function<bool(const std::string& stage, double fraction)>;

  Progress_observer() = default;
  explicit Progress_observer(Callback callback) : m_callback(std::move(callback)) {}

  /// Tells the caller where we are. \throws Cancelled_error when the caller wants to stop.
  void report(const std::string& stage, double fraction) const
  {
    if (m_callback && !m_callback(stage, fraction))
      throw Cancelled_error("cancelled during " + stage);
  }

private:
  Callback m_callback;
};

} // namespace Quadrille

#endif
