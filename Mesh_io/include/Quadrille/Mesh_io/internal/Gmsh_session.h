// Copyright (c) 2026 The Quadrille authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef QUADRILLE_MESH_IO_INTERNAL_GMSH_SESSION_H
#define QUADRILLE_MESH_IO_INTERNAL_GMSH_SESSION_H

#include <Quadrille/Labelled_mesh.h>
#include <Quadrille/exceptions.h>

#include <gmsh.h>

#include <cstdlib>
#include <map>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace Quadrille {
namespace internal {

/// Gmsh from initialize to finalize: quiet, one thread, default options, errors collected instead of printed.
///
/// Gmsh has one global state, so only one session can exist at a time, and none while the caller uses Gmsh itself.
class Gmsh_session {
public:
  Gmsh_session()
  {
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::option::setNumber("General.AbortOnError", 0);
    gmsh::option::setNumber("General.NumThreads", 1);
    gmsh::logger::start();
  }
  ~Gmsh_session()
  {
    gmsh::logger::stop();
    gmsh::finalize();
  }
  Gmsh_session(const Gmsh_session&) = delete;
  Gmsh_session& operator=(const Gmsh_session&) = delete;

  /// The first error that Gmsh has logged, or an empty string.
  std::string first_error() const
  {
    std::vector<std::string> log;
    gmsh::logger::get(log);
    for (const std::string& line : log)
      if (line.rfind("Error: ", 0) == 0 && !is_about_size_fields(line))
        return line.substr(7);
    return {};
  }

  /// Files for newer versions of Gmsh define mesh-size fields that this one does not know; they do not matter here.
  static bool is_about_size_fields(const std::string& line)
  {
    return line.find("Unknown field type") != std::string::npos ||
           (line.find("Unknown option") != std::string::npos && line.find(" in field ") != std::string::npos);
  }

  /// Gmsh's calls throw strings or numbers in some versions, standard exceptions in others.
  template <class Function> static void call(const std::string& subject, const Function& function)
  {
    try {
      function();
    } catch (const Error&) {
      throw;
    } catch (const std::bad_alloc&) {
      throw Invalid_input_error(subject + ": Gmsh asks for more memory than there is; the file may be damaged");
    } catch (const std::length_error&) {
      throw Invalid_input_error(subject + ": Gmsh asks for more memory than there is; the file may be damaged");
    } catch (const std::exception& error) {
      throw Invalid_input_error(subject + ": " + error.what());
    } catch (const std::string& error) {
      throw Invalid_input_error(subject + ": " + error);
    } catch (int) {
      throw Invalid_input_error(subject + ": Gmsh failed");
    }
  }
};

/// The physical groups of the current model and, per entity (dimension, tag), the names of its groups.
struct Gmsh_groups {
  std::vector<Physical_group> groups;
  std::map<std::pair<int, int>, std::vector<std::string>> names;

  Gmsh_groups()
  {
    gmsh::vectorpair found;
    gmsh::model::getPhysicalGroups(found);
    for (const auto& [dimension, tag] : found) {
      if (dimension != 1 && dimension != 2)
        continue;
      std::string name;
      gmsh::model::getPhysicalName(dimension, tag, name);
      if (name.empty())
        name = std::to_string(tag);
      groups.push_back({dimension, tag, name});
      std::vector<int> entities;
      gmsh::model::getEntitiesForPhysicalGroup(dimension, tag, entities);
      for (const int entity : entities)
        names[{dimension, std::abs(entity)}].push_back(name);
    }
  }
};

} // namespace internal
} // namespace Quadrille

#endif
