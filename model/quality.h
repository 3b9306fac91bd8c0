// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// Finite-volume quality of a mesh: the figures that `wellknit check` and the summary of `build` print.
///
/// Where OpenFOAM's checkMesh has a measure, its definition and its limit are taken, with the points that carry the
/// pressure
/// (`Cells::center`) in the place of the cells' centroids, since it is they that the fluxes are computed between.
/// What each figure means: docs/commands/check.md.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "model/conservation.h"
#include "model/linear_flux.h"
#include "model/mesh.h"
#include "model/polymesh_quality.h"

namespace wellknit {

/// Limits above (or below) which faces and cells are counted; those of checkMesh.
namespace quality_limit {
inline constexpr double severe_non_orthogonality = 70.0;  ///< degrees
inline constexpr double reversed_face = 90.0;             ///< degrees: the flux would run backwards
inline constexpr double skewness = 4.0;
inline constexpr double interpolation_weight = 0.05;
inline constexpr double openness = 1e-6;
inline constexpr double aspect_ratio = 1000.0;
}  // namespace quality_limit

/// Faces between two cells, by the kinds of the two. Refined cells count as host.
enum class FacePair : std::uint8_t { transition, transition_host, transition_radial, radial, host, radial_host };
inline constexpr std::size_t face_pair_count = 6;
std::string_view name_of(FacePair pair);
FacePair face_pair(CellKind a, CellKind b);

struct Distribution {
  double mean = 0.0;
  double area_mean = 0.0;           ///< weighted with the faces' areas
  std::optional<double> flow_mean;  ///< weighted with the flux through them; unset where nothing flows, or is known to
  double p99 = 0.0;                 ///< 99th percentile, linear between order statistics
  double max = 0.0;
  /// Share of the area, and of the flow, in each class of the measure (classes_of()); empty without faces, or flow.
  std::vector<double> area_share;
  std::vector<double> flow_share;
};

/// What is measured at a face: the finite-volume conditions.
enum class FaceMeasure : std::uint8_t { non_orthogonality, k_non_orthogonality, planarity, skewness };
inline constexpr std::size_t face_measure_count = 4;
/// "nonorth", "knonorth", "planarity", "skewness": the first part of the figures' names.
std::string_view name_of(FaceMeasure measure);
/// Lower ends of the classes of a measure's distribution, the first 0; the last class is open.
std::span<const double> classes_of(FaceMeasure measure);

/// Inner faces of one pair of kinds. Faces below 1e-9 of the median face area are left out: their angles are rounding.
struct PairQuality {
  std::int64_t faces = 0;
  double area = 0.0;                 ///< m2, of these faces
  Distribution non_orthogonality;    ///< degrees between the face normal and the line of centres
  Distribution k_non_orthogonality;  ///< degrees, as the connections store it
  Distribution planarity;  ///< largest distance of a vertex from the mean plane over the square root of the area
  Distribution skewness;   ///< how far off the face's centroid the line of centres crosses it, as checkMesh measures it

  [[nodiscard]] const Distribution& of(FaceMeasure measure) const;
};

struct QualityReport {
  std::array<std::int64_t, 4> cells_of_kind{};  ///< by CellKind
  std::int64_t faces = 0;
  std::int64_t vertices = 0;
  std::int64_t connections = 0;
  std::array<PairQuality, face_pair_count> pairs;  ///< by FacePair
  std::optional<Conservation> conservation;        ///< unset: the mesh file does not know its source's volumes
  std::optional<LinearFluxErrors> linear_flux;     ///< unset: the mesh file does not have them, or nothing was made

  double min_volume = 0.0;  ///< m3
  double max_volume = 0.0;
  double min_edge = 0.0;       ///< m
  double min_face_area = 0.0;  ///< m2
  double max_skewness = 0.0;   ///< inner faces
  double max_boundary_skewness = 0.0;
  PolymeshQuality polymesh;               ///< what checkMesh itself prints, from centroids
  double min_interpolation_weight = 0.5;  ///< 0.5 is the best
  double min_volume_ratio = 1.0;          ///< of two neighbours, the smaller over the larger
  double min_flatness = 1.0;              ///< |area vector| over the sum of the fan's areas
  double max_openness = 0.0;
  double max_aspect_ratio = 0.0;

  std::int64_t negative_transmissibilities = 0;
  std::int64_t zero_transmissibilities = 0;
  std::int64_t faces_above_70_degrees = 0;
  std::int64_t made_faces_beyond_90_degrees = 0;  ///< with a transition or radial cell on a side
  std::int64_t faces_above_skewness_4 = 0;
  std::int64_t faces_below_weight_005 = 0;
  std::int64_t cells_above_aspect_ratio_1000 = 0;
  std::int64_t cells_above_openness_1e6 = 0;
  std::int64_t made_cells_not_seen_from_centre = 0;
  std::int64_t host_cells_not_seen_from_centre = 0;

  [[nodiscard]] std::string to_text() const;
  /// An object of figures() by name.
  [[nodiscard]] std::string to_json() const;
};

/// The mesh's structure must be right (check_structure()).
QualityReport quality(const Mesh& mesh);

/// Over the faces with a transition or radial cell on a side, all pairs together; unset without such faces.
struct MadeFaces {
  double max = 0.0;
  double area_mean = 0.0;
};
std::optional<MadeFaces> made_faces(const QualityReport& report, FaceMeasure measure);

/// A figure of a report by its name; the names are those of limits files and of JSON.
struct Figure {
  std::string name;
  double value = 0.0;
};
std::vector<Figure> figures(const QualityReport& report);

/// A line of a limits file: `name = value`. A name that begins with "min_" bounds from below, others from above.
struct Limit {
  std::string name;
  double value = 0.0;
};
/// A limit that is passed.
struct PassedLimit {
  Limit limit;
  double value = 0.0;  ///< of the mesh
};

/// Reads a TOML file of `name = number` lines. Throws ParseError: no such file, not TOML, a value that is not a number,
/// or a name that no figure has.
std::vector<Limit> read_limits(const std::string& path);
std::vector<PassedLimit> passed_limits(const QualityReport& report, const std::vector<Limit>& limits);

/// Per cell, for pictures. Cells without a connection keep the values of the initialisers.
struct CellQuality {
  IdVector<CellId, double> max_non_orthogonality;    ///< degrees, over the cell's connections; 0
  IdVector<CellId, double> max_k_non_orthogonality;  ///< degrees; 0
  IdVector<CellId, double> max_planarity;            ///< 0
  IdVector<CellId, double> max_skewness;             ///< over the cell's inner faces; 0
  IdVector<CellId, double> min_transmissibility;     ///< m3; 0
  /// Smallest distance of the centre from a face over the cube root of the volume; negative: outside of a face. 0.5 in
  /// a cube.
  IdVector<CellId, double> centring;
};
CellQuality cell_quality(const Mesh& mesh);
/// The same with no max_skewness, in a third of the time and without an array of all faces.
CellQuality cell_quality_without_skewness(const Mesh& mesh);

/// Degrees between a face's area vector and the line from the first cell's centre to the second's.
double non_orthogonality(const Vec3& area_vector, const Vec3& line);

/// Median of the faces' areas, m2; 0 without faces. Even counts: the mean of the two in the middle.
double median_face_area(const IdVector<FaceId, PolygonGeometry>& faces);

}  // namespace wellknit
