// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "model/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace wellknit {

namespace {

/// A condition at faces: which of its figures decides, and from where on.
struct Condition {
  FaceMeasure measure;
  bool is_mean;  ///< the mean over the area decides, else the worst face
  const char* title;
  const char* unit;
  double watch;
  double poor;
  const char* meaning;
  const char* advice;
};

constexpr std::array conditions{
    // 70 degrees is checkMesh's severe non-orthogonality; from 90 on the flux runs backwards.
    Condition{
        FaceMeasure::non_orthogonality, false, "Non-orthogonality, worst face", "°",
        quality_limit::severe_non_orthogonality, quality_limit::reversed_face,
        "Angle between a face's normal and the line between the two cells' centres.",
        "Give the wells that own the worst cells a smaller --radius or more --sectors, or split the host finer with "
        "--refine. In OpenFOAM use corrected schemes with non-orthogonal correctors."},
    // From 45 degrees on more of K.n runs along the line's side than along it; 70 as for the plain angle.
    Condition{
        FaceMeasure::k_non_orthogonality, true, "K-orthogonality, mean over the area", "°", 45.0, 70.0,
        "Angle between K·n and the line from a cell's centre to its face: what a two-point flux leaves out.",
        "This comes from anisotropic permeability on slanted faces, and refining does not remove it. Compare with "
        "the host's own figure below; where it is much larger, use a multi-point scheme near the wells."},
    // A tenth of the face's size off its plane changes its area by about a hundredth, a third by a tenth.
    Condition{FaceMeasure::planarity, false, "Planarity, worst face", "", 0.1, 0.3,
              "Largest distance of a vertex from its face's mean plane, over the square root of the face's area.",
              "The grid is twisted there: a smaller --radius keeps the tube in fewer columns. Faces of host cells have "
              "the source grid's own twist."},
    // Above 1 the line misses the face; 4 is checkMesh's limit.
    Condition{
        FaceMeasure::skewness, false, "Centring, worst face", "", 1.0, quality_limit::skewness,
        "How far from a face's centroid the line of centres crosses it, over the face's extent (checkMesh's "
        "skewness).",
        "Neighbouring cells differ much in size or lie aside of each other: a smaller --growth, more --rings or a "
        "larger --radius grade the sizes better."}};

constexpr const char* pore_volume = "pore_volume_error";

std::optional<double> value_of(const std::vector<Figure>& figures, const std::string& name) {
  const auto found = std::ranges::find(figures, name, &Figure::name);
  return found == figures.end() ? std::nullopt : std::optional(found->value);
}

void grade(KeyFigure& figure, const std::vector<Limit>& limits, const std::string& advice) {
  const auto limit = std::ranges::find(limits, figure.figure, &Limit::name);
  if (limit != limits.end()) figure.poor = limit->value;
  figure.watch = std::min(figure.watch, figure.poor);
  if (!(figure.value <= figure.poor))  // what is not a number is not good
    figure.grade = Grade::poor;
  else if (figure.value > figure.watch)
    figure.grade = Grade::watch;
  if (figure.grade != Grade::good) figure.advice = advice;
}

/// How far beyond: 0 to 1 towards `watch`, 1 to 2 towards `poor`, and on from there.
double severity(const KeyFigure& figure) {
  if (!std::isfinite(figure.value)) return std::numeric_limits<double>::infinity();
  if (figure.value <= figure.watch) return figure.watch > 0.0 ? figure.value / figure.watch : 0.0;
  if (figure.value <= figure.poor) return 1.0 + (figure.value - figure.watch) / (figure.poor - figure.watch);
  return 1.0 + (figure.poor > 0.0 ? figure.value / figure.poor : 2.0);
}

}  // namespace

std::string_view name_of(Grade grade) {
  constexpr std::array<std::string_view, 3> names{"good", "watch", "poor"};
  return names[static_cast<std::size_t>(grade)];
}

std::vector<KeyFigure> key_figures(const QualityReport& report, const std::vector<Limit>& limits) {
  const std::vector<Figure> all = figures(report);
  std::vector<KeyFigure> out;
  for (const Condition& condition : conditions) {
    const bool made = made_faces(report, condition.measure).has_value();
    const bool in_degrees = condition.unit[0] != '\0';
    KeyFigure figure{fmt::format("{}_{}_{}{}", name_of(condition.measure), made ? "made" : "host",
                                 condition.is_mean ? "area_mean" : "max", in_degrees ? "_deg" : ""),
                     condition.title,
                     condition.unit,
                     0.0,
                     condition.watch,
                     condition.poor,
                     Grade::good,
                     condition.meaning,
                     ""};
    const std::optional<double> value = value_of(all, figure.figure);
    if (!value) continue;  // a mesh of one cell has no inner face
    figure.value = *value;
    grade(figure, limits, condition.advice);
    out.push_back(std::move(figure));
  }
  if (const std::optional<double> error = value_of(all, pore_volume)) {
    // Sums of some million terms round by 1e-10; a lost cell is far above 1e-6 in any grid that is meshed.
    KeyFigure figure{
        pore_volume, "Pore volume lost or gained",
        "",          *error,
        1e-9,        1e-6,
        Grade::good, "Relative difference between the pore volume of the mesh and of its source's active cells.",
        ""};
    grade(figure, limits, "The mesh does not hold what its source held: build it anew, and report it as a fault.");
    out.push_back(std::move(figure));
  }
  return out;
}

const KeyFigure* worst_of(const std::vector<KeyFigure>& figures) {
  const KeyFigure* worst = nullptr;
  for (const KeyFigure& figure : figures) {
    if (figure.grade == Grade::good) continue;
    if (worst == nullptr || severity(figure) > severity(*worst)) worst = &figure;
  }
  return worst;
}

}  // namespace wellknit
