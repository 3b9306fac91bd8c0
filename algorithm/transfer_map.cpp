// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithm/transfer_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "model/errors.h"

namespace wellknit {

namespace {

void check_map(const Mesh& mesh) {
  if (mesh.transfer.start.empty())
    throw InvalidInput("the mesh file has no map from the source grid; build it anew with `wellknit build`");
}

void check_count(std::size_t count, std::size_t cells, const char* of) {
  if (count != cells) throw InvalidInput(fmt::format("{} values for {} cells of the {}", count, cells, of));
}

std::size_t source_count(const Mesh& mesh) { return mesh.transfer.start.size() - 1; }

/// Calls visit(source cell, mesh cell, place in the map) for each part, by source cells.
template <class Visitor>
void for_each_part(const Mesh& mesh, Visitor&& visit) {
  const Transfer& t = mesh.transfer;
  for (std::size_t s = 0; s < source_count(mesh); ++s)
    for (auto at = static_cast<std::size_t>(t.start[s]); at < static_cast<std::size_t>(t.start[s + 1]); ++at)
      visit(s, t.cell[at].index(), at);
}

/// One weight a part, m3.
std::vector<double> part_weights(const Mesh& mesh, PartWeight weight) {
  const Transfer& t = mesh.transfer;
  const std::vector<double>& bulk = mesh.source_volumes.bulk;
  const std::vector<double>& pores_of_source = mesh.source_volumes.pores;
  if (bulk.size() != source_count(mesh) || pores_of_source.size() != source_count(mesh))
    throw InvalidInput(
        "the mesh file does not have the volumes of the source cells (older versions did not write them); "
        "build it anew with `wellknit build`");
  std::vector<double> volume(t.cell.size());
  for_each_part(mesh,
                [&](std::size_t s, std::size_t, std::size_t at) { volume[at] = t.fraction[at] * std::abs(bulk[s]); });
  if (weight == PartWeight::volume) return volume;
  std::vector<double> pores(mesh.cells.size(), 0.0);
  for_each_part(mesh,
                [&](std::size_t s, std::size_t c, std::size_t at) { pores[c] += t.fraction[at] * pores_of_source[s]; });
  for_each_part(mesh, [&](std::size_t s, std::size_t c, std::size_t at) {
    if (pores[c] > 0.0) volume[at] = t.fraction[at] * pores_of_source[s];
  });
  return volume;
}

struct Mean {
  double weight = 0.0;
  double sum = 0.0;
  void add(double w, double value) {
    if (std::isnan(value) || !(w > 0.0)) return;
    weight += w;
    sum += w * value;
  }
};

std::vector<double> values_of(const std::vector<Mean>& means, double unset) {
  std::vector<double> out;
  out.reserve(means.size());
  for (const Mean& mean : means) out.push_back(mean.weight > 0.0 ? mean.sum / mean.weight : unset);
  return out;
}

/// The value that has the most weight; of equal ones the smallest.
std::int32_t heaviest(const std::map<std::int32_t, double>& weights, std::int32_t unset) {
  double most = 0.0;
  std::int32_t best = unset;
  for (const auto& [value, weight] : weights) {
    if (weight <= most) continue;
    most = weight;
    best = value;
  }
  return best;
}

/// Amounts and whether anything was added.
struct Amounts {
  explicit Amounts(std::size_t count) : values(count, 0.0), is_set(count, 0) {}
  void add(std::size_t cell, double amount) {
    if (std::isnan(amount)) return;
    values[cell] += amount;
    is_set[cell] = 1;
  }
  [[nodiscard]] std::vector<double> take(double unset) {
    for (std::size_t c = 0; c < values.size(); ++c)
      if (is_set[c] == 0) values[c] = unset;
    return std::move(values);
  }
  std::vector<double> values;
  std::vector<std::uint8_t> is_set;
};

}  // namespace

std::vector<double> mean_forward(const Mesh& mesh, const std::vector<double>& values, PartWeight weight, double unset) {
  check_map(mesh);
  check_count(values.size(), source_count(mesh), "source grid");
  const std::vector<double> weights = part_weights(mesh, weight);
  std::vector<Mean> means(mesh.cells.size());
  for_each_part(mesh, [&](std::size_t s, std::size_t c, std::size_t at) { means[c].add(weights[at], values[s]); });
  return values_of(means, unset);
}

std::vector<double> sum_forward(const Mesh& mesh, const std::vector<double>& values, double unset) {
  check_map(mesh);
  check_count(values.size(), source_count(mesh), "source grid");
  Amounts out(mesh.cells.size());
  for_each_part(
      mesh, [&](std::size_t s, std::size_t c, std::size_t at) { out.add(c, mesh.transfer.fraction[at] * values[s]); });
  return out.take(unset);
}

std::vector<std::int32_t> largest_forward(const Mesh& mesh, const std::vector<std::int32_t>& values, PartWeight weight,
                                          std::int32_t unset) {
  check_map(mesh);
  check_count(values.size(), source_count(mesh), "source grid");
  const std::vector<double> weights = part_weights(mesh, weight);
  std::vector<std::map<std::int32_t, double>> shares(mesh.cells.size());
  for_each_part(mesh, [&](std::size_t s, std::size_t c, std::size_t at) { shares[c][values[s]] += weights[at]; });
  std::vector<std::int32_t> out;
  out.reserve(shares.size());
  for (const auto& share : shares) out.push_back(heaviest(share, unset));
  return out;
}

std::vector<double> mean_back(const Mesh& mesh, const std::vector<double>& values, double unset) {
  check_map(mesh);
  check_count(values.size(), mesh.cells.size(), "mesh");
  std::vector<Mean> means(source_count(mesh));
  for_each_part(
      mesh, [&](std::size_t s, std::size_t c, std::size_t at) { means[s].add(mesh.transfer.fraction[at], values[c]); });
  return values_of(means, unset);
}

std::vector<double> sum_back(const Mesh& mesh, const std::vector<double>& values, PartWeight weight, double unset) {
  check_map(mesh);
  check_count(values.size(), mesh.cells.size(), "mesh");
  const std::vector<double> weights = part_weights(mesh, weight);
  std::vector<double> total(mesh.cells.size(), 0.0);
  for_each_part(mesh, [&](std::size_t, std::size_t c, std::size_t at) { total[c] += weights[at]; });
  Amounts out(source_count(mesh));
  for_each_part(mesh, [&](std::size_t s, std::size_t c, std::size_t at) {
    if (total[c] > 0.0) out.add(s, weights[at] / total[c] * values[c]);
  });
  return out.take(unset);
}

std::vector<std::int32_t> largest_back(const Mesh& mesh, const std::vector<std::int32_t>& values, std::int32_t unset) {
  check_map(mesh);
  check_count(values.size(), mesh.cells.size(), "mesh");
  std::vector<std::map<std::int32_t, double>> shares(source_count(mesh));
  for_each_part(
      mesh, [&](std::size_t s, std::size_t c, std::size_t at) { shares[s][values[c]] += mesh.transfer.fraction[at]; });
  std::vector<std::int32_t> out;
  out.reserve(shares.size());
  for (const auto& share : shares) out.push_back(heaviest(share, unset));
  return out;
}

}  // namespace wellknit
