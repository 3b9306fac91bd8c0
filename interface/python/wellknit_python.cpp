// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The Python module `wellknit`: build, read, check and write meshes, with their arrays as NumPy's. What it offers
/// stands with its types in wellknit.pyi.

#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "interface/model_builder.h"
#include "model/errors.h"
#include "wellknit_version.h"

namespace py = pybind11;

namespace wellknit {

namespace {

/// A well as Python gives it: a file, or a name and points.
struct WellGiven {
  std::optional<std::string> file;
  std::string name;
  std::vector<Vec3> points;
  std::vector<double> measured_depth;
  WellOptions options;
};

using Points = py::array_t<double, py::array::c_style | py::array::forcecast>;

std::string path_of(const py::object& path) { return py::str(py::module_::import("os").attr("fspath")(path)); }

WellGiven make_well(const py::object& file, const std::string& name, const std::optional<Points>& points,
                    const std::optional<Points>& measured_depth, double radius, double bore_radius, int sectors,
                    int rings, std::optional<int> segments, const std::string& mode, double skin,
                    std::optional<double> growth) {
  WellGiven out;
  if (!file.is_none() && points) throw InvalidInput("Well: give either a file, or a name and points");
  if (!file.is_none()) {
    out.file = path_of(file);
  } else if (points) {
    out.name = name;
    if (points->ndim() != 2 || points->shape(1) != 3)
      throw InvalidInput("Well: points: expected an array of n rows x, y, depth");
    for (py::ssize_t i = 0; i < points->shape(0); ++i)
      out.points.emplace_back(points->at(i, 0), points->at(i, 1), points->at(i, 2));
    if (measured_depth) {
      if (measured_depth->ndim() != 1) throw InvalidInput("Well: measured_depth: expected one number a point");
      out.measured_depth.assign(measured_depth->data(), measured_depth->data() + measured_depth->size());
    }
  }
  out.options.radial.drainage_radius = radius;
  out.options.radial.bore_radius = bore_radius;
  out.options.radial.sectors = sectors;
  out.options.radial.rings = rings;
  out.options.radial.segments = segments;
  out.options.radial.mode = mesh_mode_named(mode);
  out.options.skin = skin;
  out.options.radial.growth = growth;
  return out;
}

std::shared_ptr<Model> build(const py::object& case_path, const py::list& wells, const std::string& deck_wells,
                             const std::optional<WellGiven>& deck_well_options, const py::kwargs& options) {
  ModelBuilder builder(path_of(case_path));
  for (const py::handle& given : wells) {
    if (!py::isinstance<WellGiven>(given)) {
      builder.add_file(path_of(py::reinterpret_borrow<py::object>(given)), {});
      continue;
    }
    const auto& well = given.cast<const WellGiven&>();
    if (well.file)
      builder.add_file(*well.file, well.options);
    else
      builder.add_path(well.name, well.points, well.measured_depth, well.options);
  }
  if (!deck_wells.empty())
    builder.add_deck_wells(deck_wells, deck_well_options ? deck_well_options->options : WellOptions{});
  for (const auto& [name, value] : options) {
    std::string option = py::str(name);
    for (char& c : option)
      if (c == '_') c = '-';
    builder.set(option, py::str(value));
  }
  const py::gil_scoped_release others_may_run;
  return builder.build();
}

py::array array_of(const std::shared_ptr<Model>& model, const std::string& name) {
  const auto found = model->views.all().find(name);
  if (found == model->views.all().end()) throw py::key_error(name);
  const ArrayView& view = found->second;
  const auto type = [&] {
    switch (view.type) {
      case ElementType::int64: return py::dtype::of<std::int64_t>();
      case ElementType::int32: return py::dtype::of<std::int32_t>();
      case ElementType::uint8: return py::dtype::of<std::uint8_t>();
      default: return py::dtype::of<double>();
    }
  }();
  std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(view.rows)};
  if (view.columns > 1) shape.push_back(static_cast<py::ssize_t>(view.columns));
  // The model stays as long as the array: it is the array's base.
  py::array out(type, shape, view.data, py::cast(model));
  out.attr("flags").attr("writeable") = false;
  return out;
}

std::vector<std::string> names_of(const Model& model) {
  std::vector<std::string> out;
  for (const auto& [name, view] : model.views.all()) out.push_back(name);
  return out;
}

/// One dictionary a well.
py::list wells_of(const Model& model) {
  py::list out;
  for (std::size_t w = 0; w < model.mesh.wells.size(); ++w) {
    const MeshWell& well = model.mesh.wells[WellId(w)];
    py::dict item;
    item["name"] = well.name;
    item["bore_radius"] = well.bore_radius;
    item["drainage_radius"] = well.drainage_radius;
    item["injector"] = well.type == WellType::injector;
    item["connections"] = well.connections.size();
    if (model.wells.size() == model.mesh.wells.size()) {
      const WellSummary& summary = model.wells[w];
      item["meshed"] = summary.meshed;
      item["mode"] = summary.mode;
      item["reason"] = summary.reason;
      item["length_in_rock"] = summary.length_in_rock;
      item["length_meshed"] = summary.length_meshed;
      item["notes"] = summary.notes;
    }
    out.append(item);
  }
  return out;
}

}  // namespace

}  // namespace wellknit

PYBIND11_MODULE(wellknit, module) {
  using namespace wellknit;
  module.doc() = "Knits radial well meshes into corner-point grids.";
  module.attr("__version__") = version;

  static py::exception<std::runtime_error> error(module, "Error");
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const ParseError& e) {
      error(e.what());
    } catch (const InvalidInput& e) {
      error(e.what());
    } catch (const WriteError& e) {
      error(e.what());
    }
  });

  const RadialOptions radial;
  py::class_<WellGiven>(module, "Well")
      .def(py::init(&make_well), py::arg("file") = py::none(), py::kw_only(), py::arg("name") = "",
           py::arg("points") = py::none(), py::arg("measured_depth") = py::none(),
           py::arg("radius") = radial.drainage_radius, py::arg("bore_radius") = radial.bore_radius,
           py::arg("sectors") = radial.sectors, py::arg("rings") = radial.rings, py::arg("segments") = py::none(),
           py::arg("mode") = "auto", py::arg("skin") = 0.0, py::arg("growth") = py::none());

  py::class_<Model, std::shared_ptr<Model>>(module, "Mesh")
      .def("__getitem__", &array_of, py::arg("name"))
      .def("__contains__", [](const Model& m, const std::string& name) { return m.views.all().contains(name); })
      .def("__iter__", [](const Model& m) { return py::iter(py::cast(names_of(m))); })
      .def("__len__", [](const Model& m) { return m.views.all().size(); })
      .def("keys", &names_of)
      .def_property_readonly("wells", &wells_of)
      .def_property_readonly("notes", [](const Model& m) { return m.notes; })
      .def("violations", &violations_of, py::call_guard<py::gil_scoped_release>())
      .def("quality", [](const Model& m) { return py::module_::import("json").attr("loads")(quality_json(m)); })
      .def(
          "write",
          [](const Model& m, const py::object& path, const std::string& format, bool overwrite) {
            return write_model(m, path_of(path), format, overwrite);
          },
          py::arg("path"), py::arg("format") = "", py::arg("overwrite") = false)
      .def("__repr__", [](const Model& m) {
        return fmt::format("<wellknit.Mesh of {} cells, {} connections, {} wells>", m.mesh.cells.size(),
                           m.mesh.connections.size(), m.mesh.wells.size());
      });

  module.def("build", &build, py::arg("case"), py::arg("wells") = py::list(), py::arg("deck_wells") = "",
             py::arg("deck_well_options") = py::none());
  module.def(
      "read", [](const py::object& path) { return std::shared_ptr<Model>(read_model(path_of(path))); },
      py::arg("path"));
}
