// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// The angles and the skewness that OpenFOAM's checkMesh prints for the mesh as a polyMesh: between the cells'
/// centroids, as it computes them, over all faces.
///
/// Definitions: OpenFOAM's primitiveMeshTools and primitiveMeshFaceCentresAndAreas. A face's centre is that of its fan
/// of triangles weighted with the areas of these, a cell's that of its pyramids around the mean of its faces' centres.
#pragma once

#include "model/mesh.h"

namespace wellknit {

struct PolymeshQuality {
  double max_non_orthogonality = 0.0;   ///< degrees, over inner faces
  double mean_non_orthogonality = 0.0;  ///< degrees: the angle of the mean cosine
  double max_skewness = 0.0;            ///< over all faces, those of the outer boundary too
};

/// The mesh's structure must be right (check_structure()).
PolymeshQuality polymesh_quality(const Mesh& mesh);

}  // namespace wellknit
