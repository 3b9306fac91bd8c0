// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <fmt/format.h>

#include <toml++/toml.h>
#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "model/errors.h"
#include "model/quality.h"

namespace wellknit {

namespace {

constexpr std::array<std::string_view, 4> kind_names{"host", "refined", "transition", "radial"};

void add_distribution(std::vector<Figure>& out, const std::string& name, const std::string& unit,
                      const Distribution& values) {
  out.push_back({name + "_mean" + unit, values.mean});
  out.push_back({name + "_area_mean" + unit, values.area_mean});
  if (values.flow_mean) out.push_back({name + "_flow_mean" + unit, *values.flow_mean});
  out.push_back({name + "_p99" + unit, values.p99});
  out.push_back({name + "_max" + unit, values.max});
}

bool bounds_from_below(std::string_view name) { return name.starts_with("min_"); }

[[noreturn]] void bad_limit(const std::string& path, const toml::source_region& where, const std::string& name,
                            ParseError::What what) {
  throw ParseError({path, static_cast<std::int64_t>(where.begin.line), name}, std::move(what));
}

toml::table parse_limits(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    throw ParseError({path, 0, ""}, {"a file of limits", "no such file", "check the name"});
  try {
    return toml::parse_file(path);
  } catch (const toml::parse_error& e) {
    bad_limit(path, e.source(), "", {"lines of the form name = number", std::string(e.description()), ""});
  }
}

}  // namespace

std::vector<Figure> figures(const QualityReport& report) {
  std::vector<Figure> out;
  const auto count = [&](std::string name, std::int64_t value) {
    out.push_back({std::move(name), static_cast<double>(value)});
  };
  const auto figure = [&](std::string name, double value) { out.push_back({std::move(name), value}); };
  std::int64_t cells = 0;
  for (const std::int64_t n : report.cells_of_kind) cells += n;
  count("cells", cells);
  for (std::size_t kind = 0; kind < kind_names.size(); ++kind)
    count(fmt::format("cells_{}", kind_names[kind]), report.cells_of_kind[kind]);
  count("faces", report.faces);
  count("vertices", report.vertices);
  count("connections", report.connections);
  figure("min_volume", report.min_volume);
  figure("max_volume", report.max_volume);
  figure("min_edge", report.min_edge);
  figure("min_face_area", report.min_face_area);
  for (std::size_t p = 0; p < face_pair_count; ++p) {
    const PairQuality& pair = report.pairs[p];
    if (pair.faces == 0) continue;
    const std::string name(name_of(FacePair(p)));
    count("faces_" + name, pair.faces);
    add_distribution(out, "nonorth_" + name, "_deg", pair.non_orthogonality);
    add_distribution(out, "knonorth_" + name, "_deg", pair.k_non_orthogonality);
    add_distribution(out, "planarity_" + name, "", pair.planarity);
    add_distribution(out, "skewness_" + name, "", pair.skewness);
  }
  double worst_angle = 0.0;
  for (const PairQuality& pair : report.pairs) worst_angle = std::max(worst_angle, pair.non_orthogonality.max);
  figure("max_nonorth_deg", worst_angle);
  for (std::size_t m = 0; m < face_measure_count; ++m) {
    const auto measure = static_cast<FaceMeasure>(m);
    const auto made = made_faces(report, measure);
    if (!made) continue;
    const char* unit = measure <= FaceMeasure::k_non_orthogonality ? "_deg" : "";
    figure(fmt::format("{}_made_area_mean{}", name_of(measure), unit), made->area_mean);
    figure(fmt::format("{}_made_max{}", name_of(measure), unit), made->max);
  }
  if (report.linear_flux)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const char* name = std::array{"x", "y", "depth"}[axis];
      figure(fmt::format("linear_flux_error_area_mean_{}", name), report.linear_flux->area_mean[axis]);
      figure(fmt::format("linear_flux_error_max_{}", name), report.linear_flux->max[axis]);
    }
  if (report.conservation) {
    figure("bulk_volume_error", report.conservation->bulk_error());
    figure("pore_volume_error", report.conservation->pore_error());
  }
  count("faces_above_70_deg", report.faces_above_70_degrees);
  count("made_faces_beyond_90_deg", report.made_faces_beyond_90_degrees);
  figure("max_skewness", report.max_skewness);
  figure("max_boundary_skewness", report.max_boundary_skewness);
  count("faces_above_skewness_4", report.faces_above_skewness_4);
  figure("checkmesh_nonorth_max_deg", report.polymesh.max_non_orthogonality);
  figure("checkmesh_nonorth_mean_deg", report.polymesh.mean_non_orthogonality);
  figure("checkmesh_skewness_max", report.polymesh.max_skewness);
  figure("min_interpolation_weight", report.min_interpolation_weight);
  count("faces_below_weight_5_percent", report.faces_below_weight_005);
  figure("min_volume_ratio", report.min_volume_ratio);
  figure("min_flatness", report.min_flatness);
  figure("max_openness", report.max_openness);
  count("cells_above_openness_1e-6", report.cells_above_openness_1e6);
  figure("max_aspect_ratio", report.max_aspect_ratio);
  count("cells_above_aspect_ratio_1000", report.cells_above_aspect_ratio_1000);
  count("negative_transmissibilities", report.negative_transmissibilities);
  count("zero_transmissibilities", report.zero_transmissibilities);
  count("made_cells_not_seen_from_centre", report.made_cells_not_seen_from_centre);
  count("host_cells_not_seen_from_centre", report.host_cells_not_seen_from_centre);
  return out;
}

std::string QualityReport::to_json() const {
  nlohmann::ordered_json object = nlohmann::ordered_json::object();
  for (const Figure& figure : figures(*this)) object[figure.name] = figure.value;
  return object.dump(1);
}

std::string QualityReport::to_text() const {
  std::string out =
      fmt::format("cells {} (host {}, refined {}, transition {}, radial {}), faces {}, vertices {}, connections {}\n",
                  cells_of_kind[0] + cells_of_kind[1] + cells_of_kind[2] + cells_of_kind[3], cells_of_kind[0],
                  cells_of_kind[1], cells_of_kind[2], cells_of_kind[3], faces, vertices, connections);
  out += fmt::format("volumes {:.4g} to {:.4g} m3, smallest edge {:.3g} m, smallest face {:.3g} m2\n\n", min_volume,
                     max_volume, min_edge, min_face_area);
  out += fmt::format("{:<18} {:>9}  {:>35}  {:>11}  {:>17}\n", "inner faces", "count", "non-orthogonality, degrees",
                     "K, degrees", "planarity");
  out += fmt::format("{:<18} {:>9}  {:>8} {:>8} {:>8} {:>8}  {:>5} {:>5}  {:>8} {:>8}\n", "", "", "mean", "by area",
                     "p99", "max", "mean", "max", "mean", "max");
  for (std::size_t p = 0; p < face_pair_count; ++p) {
    const PairQuality& pair = pairs[p];
    if (pair.faces == 0) continue;
    const Distribution& angle = pair.non_orthogonality;
    out += fmt::format("{:<18} {:>9}  {:>8.3f} {:>8.3f} {:>8.3f} {:>8.3f}  {:>5.1f} {:>5.1f}  {:>8.2g} {:>8.2g}\n",
                       name_of(FacePair(p)), pair.faces, angle.mean, angle.area_mean, angle.p99, angle.max,
                       pair.k_non_orthogonality.mean, pair.k_non_orthogonality.max, pair.planarity.mean,
                       pair.planarity.max);
  }
  out += fmt::format("\nfaces above {:g} degrees {}, made faces beyond {:g} degrees {}\n",
                     quality_limit::severe_non_orthogonality, faces_above_70_degrees, quality_limit::reversed_face,
                     made_faces_beyond_90_degrees);
  out += fmt::format("skewness at most {:.3g} (boundary {:.3g}), above {:g}: {}\n", max_skewness, max_boundary_skewness,
                     quality_limit::skewness, faces_above_skewness_4);
  if (linear_flux) {
    const auto& [faces_of_it, mean, most] = *linear_flux;
    out += fmt::format(
        "flux of a linear pressure, {} refined and transition faces: error by area {:.3g}, {:.3g}, {:.3g}, "
        "at most {:.3g}, {:.3g}, {:.3g} (x, y, depth)\n",
        faces_of_it, mean[0], mean[1], mean[2], most[0], most[1], most[2]);
  }
  out += fmt::format("interpolation weight at least {:.3g}, below {:g}: {}\n", min_interpolation_weight,
                     quality_limit::interpolation_weight, faces_below_weight_005);
  out += fmt::format("volume ratio at least {:.3g}, flatness at least {:.3g}\n", min_volume_ratio, min_flatness);
  out += fmt::format("openness at most {:.2g}, above {:g}: {}\n", max_openness, quality_limit::openness,
                     cells_above_openness_1e6);
  out += fmt::format("aspect ratio at most {:.3g}, above {:g}: {}\n", max_aspect_ratio, quality_limit::aspect_ratio,
                     cells_above_aspect_ratio_1000);
  out += fmt::format("transmissibilities negative {}, zero {}\n", negative_transmissibilities, zero_transmissibilities);
  out += fmt::format("not seen from their centre: made cells {}, host cells {}\n", made_cells_not_seen_from_centre,
                     host_cells_not_seen_from_centre);
  return out;
}

std::vector<Limit> read_limits(const std::string& path) {
  const toml::table table = parse_limits(path);
  // Figures that a mesh need not have, of a pair of kinds or of its flow, are known names too.
  QualityReport every_pair;
  for (PairQuality& pair : every_pair.pairs) {
    pair.faces = 1;
    pair.area = 1.0;
    for (Distribution* values : {&pair.non_orthogonality, &pair.k_non_orthogonality, &pair.planarity, &pair.skewness})
      values->flow_mean = 0.0;
  }
  every_pair.conservation.emplace();
  every_pair.linear_flux.emplace();
  const std::vector<Figure> known = figures(every_pair);

  std::vector<Limit> out;
  for (const auto& [key, node] : table) {
    const std::string name(key.str());
    const auto is_name = [&](const Figure& figure) { return figure.name == name; };
    if (std::none_of(known.begin(), known.end(), is_name))
      bad_limit(path, node.source(), name,
                {"the name of a quality figure", "an unknown name", "docs/commands/check.md lists the names"});
    const std::optional<double> value = node.value<double>();
    if (!value) bad_limit(path, node.source(), name, {"a number", "something else", ""});
    out.push_back({name, *value});
  }
  return out;
}

std::vector<PassedLimit> passed_limits(const QualityReport& report, const std::vector<Limit>& limits) {
  const std::vector<Figure> all = figures(report);
  std::vector<PassedLimit> out;
  for (const Limit& limit : limits) {
    const auto figure = std::find_if(all.begin(), all.end(), [&](const Figure& f) { return f.name == limit.name; });
    if (figure == all.end()) continue;  // no such faces in this mesh
    const bool holds = bounds_from_below(limit.name) ? figure->value >= limit.value : figure->value <= limit.value;
    if (!holds) out.push_back({limit, figure->value});
  }
  return out;
}

}  // namespace wellknit
