// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <exception>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <string>
#include <vector>

#include "interface/model_builder.h"
#include "interface/wellknit.h"
#include "model/errors.h"
#include "wellknit_version.h"

using wellknit::InvalidInput;

struct wellknit_request {
  wellknit::ModelBuilder builder;
};

struct wellknit_model {
  explicit wellknit_model(std::unique_ptr<wellknit::Model> its_model) : model(std::move(its_model)) {
    for (const auto& [name, view] : model->views.all()) names.push_back(name);
  }

  std::unique_ptr<wellknit::Model> model;
  std::vector<std::string> names;
  // Made when they are first asked for.
  mutable std::mutex mutex;
  mutable std::optional<std::string> violations;
  mutable std::int64_t violation_count = 0;
  mutable std::optional<std::string> quality;
};

namespace {

std::string& last_error() {
  thread_local std::string text;
  return text;
}

/// Runs it; an exception becomes `failed` and the text of the last error.
template <class Result, class Work>
Result guarded(Result failed, const Work& work) noexcept {
  try {
    last_error().clear();
    return work();
  } catch (const std::bad_alloc&) {
    last_error() = "not enough memory";
  } catch (const std::exception& error) {
    last_error() = error.what();
  }
  return failed;
}

template <class T>
const T& given(const T* pointer, const char* what) {
  if (pointer == nullptr) throw InvalidInput(std::string(what) + ": a null pointer");
  return *pointer;
}

template <class T>
T& given(T* pointer, const char* what) {
  if (pointer == nullptr) throw InvalidInput(std::string(what) + ": a null pointer");
  return *pointer;
}

std::string text_of(const char* text, const char* what) { return &given(text, what); }

wellknit::WellOptions options_of(const wellknit_well_options* given_options) {
  wellknit::WellOptions out;
  if (given_options == nullptr) return out;
  out.skin = given_options->skin;
  out.radial.drainage_radius = given_options->drainage_radius;
  out.radial.bore_radius = given_options->bore_radius;
  out.radial.sectors = given_options->sectors;
  out.radial.rings = given_options->rings;
  if (given_options->growth != 0.0) out.radial.growth = given_options->growth;
  if (given_options->segments != 0) out.radial.segments = given_options->segments;
  switch (given_options->mode) {
    case 0: out.radial.mode = wellknit::MeshMode::automatic; break;
    case 1: out.radial.mode = wellknit::MeshMode::layered; break;
    case 2: out.radial.mode = wellknit::MeshMode::swept; break;
    default: throw InvalidInput("mode: expected 0, 1 or 2, found " + std::to_string(given_options->mode));
  }
  return out;
}

wellknit_model* model_of(std::unique_ptr<wellknit::Model> model) {
  return std::make_unique<wellknit_model>(std::move(model)).release();
}

bool has_well(const wellknit_model& model, std::int64_t well) {
  return well >= 0 && well < static_cast<std::int64_t>(model.model->mesh.wells.size());
}

constexpr wellknit_model* no_model = nullptr;
constexpr const char* no_text = nullptr;

}  // namespace

extern "C" {

const char* wellknit_version(void) { return wellknit::version; }

const char* wellknit_last_error(void) { return last_error().c_str(); }

wellknit_well_options wellknit_well_defaults(void) {
  const wellknit::RadialOptions radial;
  return {radial.drainage_radius, radial.bore_radius, 0.0, 0.0, radial.sectors, radial.rings, 0, 0};
}

wellknit_request* wellknit_open_case(const char* path) {
  constexpr wellknit_request* none = nullptr;
  return guarded(none, [&] { return new wellknit_request{wellknit::ModelBuilder(text_of(path, "path"))}; });
}

int wellknit_add_trajectory(wellknit_request* request, const char* path, const wellknit_well_options* options) {
  return guarded<int>(WELLKNIT_FAILED, [&] {
    given(request, "request").builder.add_file(text_of(path, "path"), options_of(options));
    return WELLKNIT_OK;
  });
}

int wellknit_add_path(wellknit_request* request, const char* name, int64_t points, const double* xyz,
                      const double* measured_depth, const wellknit_well_options* options) {
  return guarded<int>(WELLKNIT_FAILED, [&] {
    constexpr int64_t most_points = 10'000'000;
    if (points < 0 || points > most_points)
      throw InvalidInput("points: expected 0 to 10000000, found " + std::to_string(points));
    given(xyz, "xyz");
    std::vector<wellknit::Vec3> path;
    for (int64_t i = 0; i < points; ++i) path.emplace_back(xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]);
    std::vector<double> depths;
    if (measured_depth != nullptr) depths.assign(measured_depth, measured_depth + points);
    given(request, "request").builder.add_path(text_of(name, "name"), path, depths, options_of(options));
    return WELLKNIT_OK;
  });
}

int wellknit_add_deck_wells(wellknit_request* request, const char* names, const wellknit_well_options* options) {
  return guarded<int>(WELLKNIT_FAILED, [&] {
    given(request, "request").builder.add_deck_wells(text_of(names, "names"), options_of(options));
    return WELLKNIT_OK;
  });
}

int wellknit_set(wellknit_request* request, const char* option, const char* value) {
  return guarded<int>(WELLKNIT_FAILED, [&] {
    given(request, "request").builder.set(text_of(option, "option"), text_of(value, "value"));
    return WELLKNIT_OK;
  });
}

wellknit_model* wellknit_build(const wellknit_request* request) {
  return guarded(no_model, [&] { return model_of(given(request, "request").builder.build()); });
}

wellknit_model* wellknit_read_mesh(const char* path) {
  return guarded(no_model, [&] { return model_of(wellknit::read_model(text_of(path, "path"))); });
}

int wellknit_write(const wellknit_model* model, const char* path, const char* format, int overwrite) {
  return guarded<int>(WELLKNIT_FAILED, [&] {
    wellknit::write_model(*given(model, "model").model, text_of(path, "path"), format == nullptr ? "" : format,
                          overwrite != 0);
    return WELLKNIT_OK;
  });
}

int wellknit_array(const wellknit_model* model, const char* name, wellknit_view* view) {
  return guarded<int>(WELLKNIT_FAILED, [&] {
    const wellknit::ArrayView& found = given(model, "model").model->views.named(text_of(name, "name"));
    given(view, "view") = {found.data, found.rows, found.columns, static_cast<int32_t>(found.type)};
    return WELLKNIT_OK;
  });
}

const char* wellknit_array_name(const wellknit_model* model, int64_t index) {
  return guarded(no_text, [&] {
    const auto& names = given(model, "model").names;
    const bool is_one = index >= 0 && index < static_cast<int64_t>(names.size());
    return is_one ? names[static_cast<std::size_t>(index)].c_str() : no_text;
  });
}

int64_t wellknit_well_count(const wellknit_model* model) {
  return guarded<int64_t>(-1, [&] { return static_cast<int64_t>(given(model, "model").model->mesh.wells.size()); });
}

const char* wellknit_well_name(const wellknit_model* model, int64_t well) {
  return guarded(no_text, [&] {
    if (!has_well(given(model, "model"), well)) return no_text;
    return model->model->mesh.wells[wellknit::WellId(well)].name.c_str();
  });
}

const char* wellknit_well_reason(const wellknit_model* model, int64_t well) {
  return guarded(no_text, [&] {
    const auto& wells = given(model, "model").model->wells;
    if (!has_well(*model, well) || wells.size() != model->model->mesh.wells.size()) return no_text;
    return wells[static_cast<std::size_t>(well)].reason.c_str();
  });
}

int64_t wellknit_check(const wellknit_model* model, const char** text) {
  return guarded<int64_t>(-1, [&] {
    const std::lock_guard lock(given(model, "model").mutex);
    if (!model->violations) {
      std::string lines;
      const auto found = wellknit::violations_of(*model->model);
      for (const std::string& line : found) lines += line + '\n';
      model->violation_count = static_cast<std::int64_t>(found.size());
      model->violations = std::move(lines);
    }
    if (text != nullptr) *text = model->violations->c_str();
    return model->violation_count;
  });
}

const char* wellknit_quality(const wellknit_model* model) {
  return guarded(no_text, [&] {
    const std::lock_guard lock(given(model, "model").mutex);
    if (!model->quality) model->quality = wellknit::quality_json(*model->model);
    return model->quality->c_str();
  });
}

void wellknit_free_request(wellknit_request* request) { delete request; }
void wellknit_free_model(wellknit_model* model) { delete model; }

}  // extern "C"
