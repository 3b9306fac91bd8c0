// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// What a face of the outer boundary conducts.
#pragma once

#include "model/mesh.h"

namespace wellknit {

/// Half-transmissibility, m3, between the centre of a boundary face's cell and the face: A · K d / d^2, with A the area
/// vector, K the cell's diagonal permeability (the lateral ones times net-to-gross) and d from the centre to the face's
/// centroid. 0 where that is not positive.
double boundary_conductance(const Mesh& mesh, FaceId face);

}  // namespace wellknit
