// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "interface/mesh_views.h"

#include <fmt/format.h>

#include "model/errors.h"
#include "model/mesh_arrays.h"

namespace wellknit {

namespace {

struct Element {
  ElementType type;
  std::int64_t columns;
};

Element element(const double*) { return {ElementType::float64, 1}; }
Element element(const Vec3*) { return {ElementType::float64, 3}; }
Element element(const std::array<double, 2>*) { return {ElementType::float64, 2}; }
Element element(const std::array<double, 4>*) { return {ElementType::float64, 4}; }
Element element(const std::int64_t*) { return {ElementType::int64, 1}; }
Element element(const std::int32_t*) { return {ElementType::int32, 1}; }
Element element(const RadialIndex*) { return {ElementType::int32, 3}; }
Element element(const CellKind*) { return {ElementType::uint8, 1}; }
Element element(const ConnectionKind*) { return {ElementType::uint8, 1}; }
template <class Tag>
Element element(const Id<Tag>*) {
  return {ElementType::int32, 1};
}
template <class Tag>
Element element(const std::array<Id<Tag>, 2>*) {
  return {ElementType::int32, 2};
}

template <class Array>
ArrayView view_of(const Array& values) {
  const Element layout = element(values.data());
  return {values.data(), static_cast<std::int64_t>(values.size()), layout.columns, layout.type};
}

}  // namespace

MeshViews::MeshViews(const Mesh& mesh) {
  const auto add = [&](const char* name, const auto& values) { views_[name] = view_of(values); };
  for_each_array(mesh, add);
  if (!mesh.connections.linear_flux_error.empty()) for_each_added_array(mesh, add);
  if (!mesh.transfer.start.empty()) for_each_transfer_array(mesh, add);
  if (!mesh.source_volumes.bulk.empty()) for_each_source_volume(mesh, add);
  if (mesh.stencils) for_each_stencil_array(*mesh.stencils, add);
  if (mesh.flow) for_each_flow_array(*mesh.flow, add);
  for (const auto& [keyword, property] : mesh.cells.properties)
    std::visit([&, &key = keyword](const auto& values) { views_["cells/properties/" + key] = view_of(values); },
               property);
  wells_.resize(mesh.wells.size());  // never again: views point into it
  for (std::size_t w = 0; w < mesh.wells.size(); ++w) add_well(mesh.wells[WellId(w)], wells_[w]);
}

void MeshViews::add_well(const MeshWell& well, WellArrays& arrays) {
  const Trajectory& path = well.trajectory;
  for (std::size_t i = 0; i < path.points.size(); ++i)
    arrays.trajectory.push_back({path.measured_depth[i], path.points[i].x(), path.points[i].y(), path.points[i].z()});
  for (const WellConnection& connection : well.connections) {
    arrays.cell.push_back(connection.cell);
    arrays.well_index.push_back(connection.well_index);
    arrays.measured_depth.push_back({connection.measured_depth.from, connection.measured_depth.to});
  }
  const std::string group = "wells/" + well.name;
  views_[group + "/trajectory"] = view_of(arrays.trajectory);
  views_[group + "/connections/cell"] = view_of(arrays.cell);
  views_[group + "/connections/well_index"] = view_of(arrays.well_index);
  views_[group + "/connections/md"] = view_of(arrays.measured_depth);
}

const ArrayView& MeshViews::named(const std::string& name) const {
  const auto found = views_.find(name);
  if (found == views_.end())
    throw InvalidInput(
        fmt::format("the mesh has no array {}; docs/formats/hdf5.md names those that there can be", name));
  return found->second;
}

}  // namespace wellknit
