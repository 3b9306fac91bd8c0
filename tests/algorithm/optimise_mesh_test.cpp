// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/optimise_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "algorithm/build_mesh.h"
#include "algorithm/quasi_newton.h"
#include "model/mesh_check.h"
#include "tests/support/near_well.h"
#include "tests/support/rounds.h"

namespace wellknit {
namespace {

using near_well::Path;

/// Rosenbrock's valley in pairs of unknowns: its least value is 0, at 1 everywhere.
TEST(QuasiNewton, FindsTheEndOfABentValley) {
  Eigen::VectorXd x = Eigen::VectorXd::Constant(8, -1.2);
  int calls = 0;
  const SmoothFunction valley = [&](const Eigen::VectorXd& at, Eigen::VectorXd& gradient) {
    ++calls;
    double sum = 0.0;
    for (Eigen::Index i = 0; i < at.size(); i += 2) {
      const double a = 1.0 - at[i];
      const double b = at[i + 1] - at[i] * at[i];
      sum += a * a + 100.0 * b * b;
      gradient[i] = -2.0 * a - 400.0 * at[i] * b;
      gradient[i + 1] = 200.0 * b;
    }
    return sum;
  };
  const QuasiNewtonResult result = minimise(valley, x, {500, 8, 1.0, 1e-14});
  EXPECT_LT(result.after, 1e-12);
  EXPECT_LT((x - Eigen::VectorXd::Ones(8)).cwiseAbs().maxCoeff(), 1e-5);
  EXPECT_EQ(result.evaluations, calls);
  EXPECT_LT(result.iterations, 200);
}

TEST(QuasiNewton, NeverClimbs) {
  Eigen::VectorXd x = Eigen::VectorXd::Constant(1, 3.0);
  // A gradient that points the wrong way: no step helps, and none is taken.
  const auto wrong = [](const Eigen::VectorXd& at, Eigen::VectorXd& gradient) {
    gradient[0] = -2.0 * at[0];
    return at[0] * at[0];
  };
  const QuasiNewtonResult result = minimise(wrong, x, {});
  EXPECT_EQ(x[0], 3.0);
  EXPECT_EQ(result.iterations, 0);
  EXPECT_EQ(result.after, 9.0);
}

BuildResult built(double deformation, Path path, Optimisation optimise, int threads = 0) {
  BuildOptions options;
  options.optimise = optimise;
  options.threads = threads;
  return build_mesh(near_well::deformed(deformation), {near_well::well(path, 12.0)}, options);
}

TEST(OptimiseMesh, TurnsFacesTowardsTheLinesOfTheCentres) {
  for (const Path path : {Path::vertical, Path::deviated, Path::curved, Path::horizontal}) {
    if (has_few_rounds && path != Path::curved) continue;
    const BuildResult result = built(1.0, path, Optimisation::vertices);
    ASSERT_TRUE(result.summary.optimisation);
    const MeshOptimisation& o = *result.summary.optimisation;
    EXPECT_GT(o.cells, 0);
    // By a third in most, by an eighth in the vertical well.
    EXPECT_LT(o.inner_after.mean, 0.88 * o.inner_before.mean);
    EXPECT_LT(o.inner_after.p99, 1.02 * o.inner_before.p99);
    EXPECT_LT(o.joint_after.mean, o.joint_before.mean);
    EXPECT_LT(o.joint_after.p99, 1.05 * o.joint_before.p99);
    EXPECT_LT(o.inner_after.largest, 90.0);
    EXPECT_TRUE(check_mesh(result.mesh).empty());
  }
}

/// A well's indices hold for the cells that its path goes through beyond its tube's ends as the mapping made them.
TEST(OptimiseMesh, KeepsCellsThatAWellIsConnectedToByIndex) {
  // A swept tube through the top and the base stops short of both.
  Well well = near_well::well(Path::vertical, 12.0);
  well.radial.mode = MeshMode::swept;
  const auto mesh = [&](Optimisation optimise) {
    BuildOptions options;
    options.optimise = optimise;
    return build_mesh(near_well::deformed(1.0), {well}, options).mesh;
  };
  const Mesh before = mesh(Optimisation::off);
  const Mesh after = mesh(Optimisation::on);
  std::size_t count = 0;
  for (const WellConnection& c : before.wells[WellId(0)].connections) {
    if (before.cells.kind[c.cell] != CellKind::transition) continue;
    ++count;
    EXPECT_EQ(before.cells.center[c.cell], after.cells.center[c.cell]);
    EXPECT_NEAR(before.cells.volume[c.cell] / after.cells.volume[c.cell], 1.0, 1e-12);
  }
  EXPECT_GT(count, 0U);
  const auto& one = before.wells[WellId(0)].connections;
  const auto& other = after.wells[WellId(0)].connections;
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t n = 0; n < one.size(); ++n)
    if (before.cells.kind[one[n].cell] != CellKind::radial) {
      EXPECT_NEAR(one[n].well_index / other[n].well_index, 1.0, 1e-9);
    }
}

/// What is not the transition mesh's own stays to the last bit: vertices of other cells, their centres and volumes, and
/// the whole volume.
TEST(OptimiseMesh, MovesNothingElse) {
  const Mesh before = built(1.0, Path::curved, Optimisation::off).mesh;
  const Mesh after = built(1.0, Path::curved, Optimisation::vertices).mesh;
  ASSERT_EQ(before.vertices.size(), after.vertices.size());
  ASSERT_EQ(before.faces.vertices, after.faces.vertices);
  std::set<VertexId> fixed;
  for (std::size_t f = 0; f < before.faces.size(); ++f) {
    const auto [a, b] = before.faces.cells[FaceId(f)];
    const auto is_made = [&](CellId c) { return c.is_valid() && before.cells.kind[c] == CellKind::transition; };
    if (is_made(a) && is_made(b)) continue;
    for (const VertexId v : before.faces.loop(FaceId(f))) fixed.insert(v);
  }
  std::size_t moved = 0;
  for (std::size_t v = 0; v < before.vertices.size(); ++v) {
    const bool is_same = before.vertices[VertexId(v)] == after.vertices[VertexId(v)];
    moved += is_same ? 0 : 1;
    EXPECT_TRUE(is_same || !fixed.contains(VertexId(v)));
  }
  EXPECT_GT(moved, 100U);
  double volume = 0.0;
  double change = 0.0;
  for (std::size_t c = 0; c < before.cells.size(); ++c) {
    const CellId cell(c);
    if (before.cells.kind[cell] != CellKind::transition) {
      EXPECT_EQ(before.cells.center[cell], after.cells.center[cell]);
      EXPECT_EQ(before.cells.volume[cell], after.cells.volume[cell]);
      continue;
    }
    volume += before.cells.volume[cell];
    change += after.cells.volume[cell] - before.cells.volume[cell];
  }
  EXPECT_LT(std::abs(change), 1e-12 * volume);
}

/// A path that ends where its tube ends has no cells beyond it: all vertices that belong to transition cells alone
/// move.
TEST(OptimiseMesh, KeepsNoCellsAtTheEndsOfATubeThatThePathEndsWith) {
  const BuildResult result = built(1.0, Path::curved, Optimisation::vertices);
  const Mesh& mesh = result.mesh;
  for (const WellConnection& c : mesh.wells[WellId(0)].connections)
    ASSERT_EQ(mesh.cells.kind[c.cell], CellKind::radial);
  std::set<VertexId> own;
  std::set<VertexId> shared;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto [a, b] = mesh.faces.cells[FaceId(f)];
    const auto is_made = [&](CellId c) { return c.is_valid() && mesh.cells.kind[c] == CellKind::transition; };
    for (const VertexId v : mesh.faces.loop(FaceId(f))) (is_made(a) && is_made(b) ? own : shared).insert(v);
  }
  for (const VertexId v : shared) own.erase(v);
  EXPECT_EQ(result.summary.optimisation->vertices, static_cast<std::int64_t>(own.size()));
}

TEST(OptimiseMesh, LeavesARegularMeshAlone) {
  const Mesh before = built(0.0, Path::curved, Optimisation::off).mesh;
  const Mesh after = built(0.0, Path::curved, Optimisation::vertices).mesh;
  EXPECT_EQ(before.vertices.raw(), after.vertices.raw());
  EXPECT_EQ(before.cells.center.raw(), after.cells.center.raw());
}

TEST(OptimiseMesh, DoesNotDependOnThreads) {
  const Mesh one = built(1.0, Path::curved, Optimisation::on, 1).mesh;
  const Mesh two = built(1.0, Path::curved, Optimisation::on, 2).mesh;
  EXPECT_EQ(one.vertices.raw(), two.vertices.raw());
  EXPECT_EQ(one.cells.center.raw(), two.cells.center.raw());
}

/// The same mesh from a worse start: with weights that forbid nothing cells may not be lost all the same.
TEST(OptimiseMesh, PutsBackCellsThatItWouldSpoil) {
  Mesh mesh = built(1.5, Path::curved, Optimisation::off).mesh;
  OptimisationWeights reckless;
  reckless.barrier = 0.0;
  reckless.planarity = 0.0;
  reckless.keep_inner = reckless.keep_joint = 0.0;
  const MeshOptimisation o = optimise_mesh(mesh, {}, reckless);
  EXPECT_GT(o.restored, 0);
  EXPECT_LE(o.inner_after.mean, o.inner_before.mean);
  // The connections are those of the mesh as it was built.
  for (const Violation& violation : check_mesh(mesh))
    EXPECT_NE(violation.check, not_seen_from_centre) << violation.entity;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) EXPECT_GT(mesh.cells.volume[CellId(c)], 0.0);
}

}  // namespace
}  // namespace wellknit
