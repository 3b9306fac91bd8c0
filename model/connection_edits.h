// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

/// What a deck says about connections and pore volumes beyond geometry and rock: faults, multipliers, non-neighbour
/// connections, pinch-outs, thresholds, and edits of computed arrays. In SI, cells counted from 0; nothing here is
/// applied to anything yet. Where simulators differ or a rule is not obvious, the member says what OPM Flow does.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/ids.h"
#include "model/units.h"

namespace wellknit {

/// Cells from first to last along i, j, k, both inside, 0-based.
struct CellBox {
  std::array<std::int64_t, 3> first{};
  std::array<std::int64_t, 3> last{};

  [[nodiscard]] std::int64_t cell_count() const {
    return (last[0] - first[0] + 1) * (last[1] - first[1] + 1) * (last[2] - first[2] + 1);
  }
  bool operator==(const CellBox&) const = default;
};

/// A face of a cell by the side it looks to; k_plus is the base.
enum class FaceDirection : std::uint8_t { i_minus, i_plus, j_minus, j_plus, k_minus, k_plus };

/// One face of each cell in a box: a record of FAULTS.
struct FaultFaces {
  CellBox cells;
  FaceDirection face = FaceDirection::i_plus;
};

struct Fault {
  std::string name;  ///< as the deck writes it first
  std::vector<FaultFaces> faces;
  /// MULTFLT: the last one of GRID, times the last one of EDIT. It multiplies what MULTX … say of the same face.
  double multiplier = 1.0;

  [[nodiscard]] std::int64_t face_count() const;
};

/// The array whose numbers name regions: MULTNUM, FLUXNUM or OPERNUM of the grid's properties. A grid without MULTNUM
/// has region 1 in every cell; the other two must be there.
enum class RegionSet : std::uint8_t { multnum, fluxnum, opernum };

/// Which connections a record of MULTREGT concerns.
enum class RegionConnections : std::uint8_t {
  all,
  only_non_neighbours,        ///< NNC
  only_neighbours,            ///< NONNC
  not_aquifer_non_neighbours  ///< NOAQUNNC
};

/// A record of MULTREGT, in the deck's order, GRID before EDIT. For one pair of regions, in whichever order, the last
/// record counts, of any region set; records of different sets for one connection multiply. from = to means the
/// connections inside the region and from it to all others.
struct RegionMultiplier {
  std::optional<std::int32_t> from;  ///< unset: every region
  std::optional<std::int32_t> to;    ///< unset: every region
  double multiplier = 1.0;
  std::array<bool, 3> directions{true, true, true};  ///< faces across i, j, k; no matter for NNCs
  RegionConnections connections = RegionConnections::all;
  RegionSet regions = RegionSet::multnum;
};

/// A record of MULTREGP, in the deck's order: multiplies the pore volume of a region. For one region number the last
/// record counts, whatever its set; a number below 1 has no effect.
struct RegionPoreVolume {
  std::int32_t region = 0;
  double multiplier = 1.0;
  RegionSet regions = RegionSet::multnum;
};

/// Two different cells and a number: of NNC and EDITNNCR a transmissibility in m3, of EDITNNC a multiplier. In the
/// deck's order. EDITNNC of one pair multiply each other; of EDITNNCR the last one counts and replaces the
/// transmissibility.
struct CellPairValue {
  HostCellId first;
  HostCellId second;
  double value = 0.0;
};

/// Where the transmissibility across a pinched-out stretch comes from.
enum class PinchTransmissibility : std::uint8_t { top_and_bottom /*TOPBOT*/, all_layers /*ALL*/ };
/// Which MULTZ counts across a pinched-out stretch: that of the active cell above it, or the least of all.
enum class PinchMultiplier : std::uint8_t { top, all };

struct PinchOptions {
  double threshold = 0.001;  ///< m: cells thinner than this pinch out (0.001 of the deck's unit by default)
  bool across_gaps = true;   ///< GAP: cells that MINPV deactivates are bridged whatever their thickness
  double largest_gap = 0.0;  ///< m, between cells that are to connect (10^20 of the deck's unit by default)
  PinchTransmissibility transmissibility = PinchTransmissibility::top_and_bottom;
  PinchMultiplier multiplier = PinchMultiplier::top;
};

/// How the deck asks transmissibilities to be computed. by_geometry: as for corner points, as OPM Flow has it for DX,
/// DY, DZ too. oldtran and oldtranr are refused.
enum class TransmissibilityMethod : std::uint8_t { by_geometry, newtran, oldtran, oldtranr };

/// An array that a simulator computes from the grid and the EDIT section then changes.
enum class ComputedArray : std::uint8_t {
  transmissibility_x,
  transmissibility_y,
  transmissibility_z,
  pore_volume,
  depth
};

enum class ArrayOperation : std::uint8_t { set, add, multiply, at_least /*MINVALUE*/, at_most /*MAXVALUE*/, copy };

/// One step of the EDIT section on a computed array. The steps apply in their order to the computed values, after
/// multipliers.
struct ArrayEdit {
  ComputedArray array = ComputedArray::transmissibility_x;
  ArrayOperation operation = ArrayOperation::set;
  CellBox cells;
  /// set, add, at_least, at_most: in m3 (transmissibility and pore volume) or m (depth); multiply: a factor.
  double value = 0.0;
  /// set by an array: one value for each cell of the box, i fastest; NaN keeps what is there. Empty: `value` for all.
  std::vector<double> values;
  ComputedArray source = ComputedArray::transmissibility_x;  ///< copy: what is copied
};

struct ConnectionEdits {
  std::vector<Fault> faults;  ///< in the order of their first records
  /// MULTX-, MULTX, MULTY-, MULTY, MULTZ-, MULTZ, indexed by FaceDirection: nx ny nz each, empty where not given. MULTX
  /// of a cell multiplies the connection to the cell at i + 1. Given in GRID and in EDIT: their product.
  std::array<std::vector<double>, 6> face_multiplier;
  std::vector<double> pore_volume_multiplier;       ///< MULTPV of GRID; nx ny nz, or empty
  std::vector<double> pore_volume_multiplier_edit;  ///< MULTPV of EDIT, times that of GRID; over PORV of EDIT by itself
  std::vector<RegionMultiplier> region_multipliers;
  std::vector<RegionPoreVolume> region_pore_volumes;
  std::vector<CellPairValue> non_neighbours;                    ///< NNC: m3; several of one pair add up
  std::vector<CellPairValue> non_neighbour_multipliers;         ///< EDITNNC
  std::vector<CellPairValue> non_neighbour_transmissibilities;  ///< EDITNNCR: m3
  std::optional<PinchOptions> pinch;                            ///< PINCH
  bool pinchout = false;                          ///< PINCHOUT: only cells without any thickness pinch out
  std::optional<double> least_pore_volume;        ///< MINPV or MINPORV: m3; cells below it are inactive
  std::vector<double> least_pore_volume_by_cell;  ///< MINPVV: m3, in place of MINPV; nx ny nz, or empty
  TransmissibilityMethod method = TransmissibilityMethod::by_geometry;
  std::vector<ArrayEdit> array_edits;
};

/// Throws InvalidInput when an array's length is not the number of cells, a cell does not exist, or block-centred
/// transmissibilities are asked for.
void validate(const ConnectionEdits& edits, const std::array<std::int64_t, 3>& dimensions);

/// "MULTX", "MULTX-" …
std::string multiplier_keyword(FaceDirection face);
/// "MULTNUM" …
std::string keyword_of(RegionSet regions);
/// "TRANX", "PORV" …
std::string keyword_of(ComputedArray array);

}  // namespace wellknit
