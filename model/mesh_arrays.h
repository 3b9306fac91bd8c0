// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Every array of a mesh with its place in the mesh file: the one list that the writer, the reader and the tests
/// share, so that none of them can forget an array. Properties and wells, whose number varies, are not in it.
#pragma once

#include "model/mesh.h"

namespace wellknit {

/// Calls `visit(path, array)` for vertices, faces, cells and connections. MeshType is Mesh or const Mesh.
template <class MeshType, class Visitor>
void for_each_array(MeshType& mesh, Visitor&& visit) {
  visit("vertices", mesh.vertices.raw());
  visit("faces/vertex_start", mesh.faces.vertex_start);
  visit("faces/vertices", mesh.faces.vertices);
  visit("faces/cells", mesh.faces.cells.raw());
  visit("cells/kind", mesh.cells.kind.raw());
  visit("cells/center", mesh.cells.center.raw());
  visit("cells/centroid", mesh.cells.centroid.raw());
  visit("cells/volume", mesh.cells.volume.raw());
  visit("cells/depth", mesh.cells.depth.raw());
  visit("cells/source_cell", mesh.cells.source_cell.raw());
  visit("cells/well", mesh.cells.well.raw());
  visit("cells/radial_index", mesh.cells.radial_index.raw());
  visit("cells/pore_volume", mesh.cells.pore_volume.raw());
  visit("cells/porosity", mesh.cells.porosity.raw());
  visit("cells/net_to_gross", mesh.cells.net_to_gross.raw());
  visit("cells/permeability", mesh.cells.permeability.raw());
  visit("connections/cells", mesh.connections.cells.raw());
  visit("connections/face", mesh.connections.face.raw());
  visit("connections/transmissibility", mesh.connections.transmissibility.raw());
  visit("connections/area", mesh.connections.area.raw());
  visit("connections/normal", mesh.connections.normal.raw());
  visit("connections/half_distance", mesh.connections.half_distance.raw());
  visit("connections/non_orthogonality", mesh.connections.non_orthogonality.raw());
  visit("connections/k_non_orthogonality", mesh.connections.k_non_orthogonality.raw());
  visit("connections/planarity", mesh.connections.planarity.raw());
  visit("connections/kind", mesh.connections.kind.raw());
  visit("connections/multiplier", mesh.connections.multiplier.raw());
}

/// The same for the map from the source grid; it may be empty as a whole.
template <class MeshType, class Visitor>
void for_each_transfer_array(MeshType& mesh, Visitor&& visit) {
  visit("transfer/start", mesh.transfer.start);
  visit("transfer/cell", mesh.transfer.cell);
  visit("transfer/fraction", mesh.transfer.fraction);
}

/// The volumes of the source cells, which older files do not have.
template <class MeshType, class Visitor>
void for_each_source_volume(MeshType& mesh, Visitor&& visit) {
  visit("transfer/source_volume", mesh.source_volumes.bulk);
  visit("transfer/source_pore_volume", mesh.source_volumes.pores);
}

/// What later versions added to the connections; older files do not have it.
template <class MeshType, class Visitor>
void for_each_added_array(MeshType& mesh, Visitor&& visit) {
  visit("connections/linear_flux_error", mesh.connections.linear_flux_error.raw());
}

/// Of `mesh.stencils`, which a mesh built with --fluxes consistent has.
template <class StencilType, class Visitor>
void for_each_stencil_array(StencilType& stencils, Visitor&& visit) {
  visit("stencils/start", stencils.start);
  visit("stencils/cells", stencils.cells);
  visit("stencils/coefficients", stencils.coefficients);
  visit("stencils/boundary_face", stencils.boundary_face);
  visit("stencils/boundary_transmissibility", stencils.boundary_transmissibility);
  visit("stencils/boundary_start", stencils.boundary_start);
  visit("stencils/boundary_cells", stencils.boundary_cells);
  visit("stencils/boundary_coefficients", stencils.boundary_coefficients);
}

/// Of a solution (`mesh.flow`), which most files do not have.
template <class FlowType, class Visitor>
void for_each_flow_array(FlowType& flow, Visitor&& visit) {
  visit("flow/pressure", flow.pressure.raw());
  visit("flow/flux", flow.flux.raw());
  visit("flow/well_pressure", flow.well_pressure.raw());
  visit("flow/well_rate", flow.well_rate.raw());
  visit("flow/well_connection_rate", flow.well_connection_rate);
}

}  // namespace wellknit
