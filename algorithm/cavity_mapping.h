// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The mapping phi between E_ref and the real space: Delaunay tetrahedra of the cavity's vertices in E_ref, each with
/// its real position, untangled until no tetrahedron is inverted (method.md §7).
///
/// Source: T. Mouton, C. Bennis, H. Borouchaki (key Mouton).
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "algorithm/build_mesh.h"
#include "algorithm/cavity.h"

namespace wellknit {

struct MappingReport {
  std::int64_t inverted_first = 0;  ///< tetrahedra, before correction
  std::int64_t inverted_last = 0;   ///< after it; not 0: the mapping is not usable
  std::int64_t loops = 0;
  std::int64_t points_inserted = 0;
  std::int64_t tetrahedra = 0;
  std::int64_t plane_nodes_left_out = 0;    ///< of the grid's outside: their real positions contradict the tubes' there
  double smallest_ratio = 0.0;              ///< of real to reference volume
  std::vector<std::size_t> tubes_at_fault;  ///< places in the cavity's tubes: those at inverted tetrahedra
  std::vector<TubePlace> places_at_fault;   ///< nearest to the inverted tetrahedra when there were fewest
  std::string failure;                      ///< why the mapping is not usable; empty when it is
};

class CavityMapping {
 public:
  CavityMapping(const Cavity& cavity, MappingMethod method);
  ~CavityMapping();
  CavityMapping(const CavityMapping&) = delete;
  CavityMapping& operator=(const CavityMapping&) = delete;

  [[nodiscard]] const MappingReport& report() const;
  /// Real position of a point of the cavity in E_ref, by barycentric coordinates.
  [[nodiscard]] Vec3 to_real(const Vec3& reference) const;
  /// The same for many points, in their order: neighbours are looked up one after the other.
  [[nodiscard]] std::vector<Vec3> to_real(std::span<const Vec3> reference) const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace wellknit
