// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "tests/support/simulator_output.h"

#include <fmt/format.h>
#include <fmt/os.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <vector>

#include "model/units.h"

namespace wellknit {

namespace {

template <class Values>
void write_keyword(fmt::ostream& out, const char* name, const Values& values, double unit) {
  out.print("{}\n", name);
  for (std::size_t v = 0; v < values.size(); ++v)
    out.print("{:.17g}{}", static_cast<double>(values[v]) / unit, v % 6 == 5 ? '\n' : ' ');
  out.print("/\n");
}

void write_deck(const CornerPointGrid& grid, const std::string& path) {
  fmt::ostream out = fmt::output_file(path);
  const auto [nx, ny, nz] = grid.dimensions;
  out.print("RUNSPEC\nDIMENS\n{} {} {} /\nWATER\nMETRIC\nSTART\n1 JAN 2020 /\nEQLDIMS\n/\nTABDIMS\n/\nUNIFOUT\n", nx,
            ny, nz);
  out.print("GRID\nINIT\nNEWTRAN\nGRIDFILE\n0 1 /\n{}", grid.connects_across_pinch ? "PINCH\n/\n" : "");
  write_keyword(out, "COORD", grid.coord, 1.0);
  write_keyword(out, "ZCORN", grid.zcorn, 1.0);
  write_keyword(out, "ACTNUM", grid.active, 1.0);
  write_keyword(out, "PORO", grid.porosity, 1.0);
  if (!grid.net_to_gross.empty()) write_keyword(out, "NTG", grid.net_to_gross, 1.0);
  for (std::size_t axis = 0; axis < 3; ++axis)
    write_keyword(out, std::array{"PERMX", "PERMY", "PERMZ"}[axis], grid.permeability[axis], m2_per_millidarcy);
  out.print("PROPS\nPVTW\n100 1 1e-5 1 0 /\nROCK\n100 1e-5 /\nDENSITY\n800 1000 1 /\n");
  out.print("SOLUTION\nEQUIL\n1000 100 0 0 0 0 /\nSCHEDULE\nTSTEP\n1 /\nEND\n");
}

/// Arrays of an unformatted simulator file: big-endian Fortran records, a header of name, count and type before each
/// array.
class OutputFile {
 public:
  explicit OutputFile(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    bytes_.assign(std::istreambuf_iterator<char>(in), {});
    while (at_ < bytes_.size()) read_array();
  }
  [[nodiscard]] std::vector<double> values(const std::string& name) const {
    const auto found = arrays_.find(name);
    return found == arrays_.end() ? std::vector<double>{} : found->second;
  }

 private:
  std::uint32_t word(std::size_t at) const {
    if (at + 4 > bytes_.size()) throw std::runtime_error("a simulator file is cut");
    std::uint32_t value = 0;
    for (std::size_t b = 0; b < 4; ++b) value = (value << 8U) | static_cast<unsigned char>(bytes_[at + b]);
    return value;
  }
  void read_array() {
    const std::string name(bytes_.data() + at_ + 4, 8);
    const std::uint32_t count = word(at_ + 12);
    const std::string type(bytes_.data() + at_ + 16, 4);
    at_ += 24;
    std::vector<double> values;
    for (std::uint32_t read = 0; read < count;) {
      const std::uint32_t length = word(at_);
      const std::uint32_t size = type == "DOUB" || type == "CHAR" ? 8 : 4;
      if (length == 0 || length % size != 0) throw std::runtime_error("a simulator file has an odd record");
      for (std::uint32_t byte = 0; byte < length; byte += size) values.push_back(value(at_ + 4 + byte, type));
      read += length / size;
      at_ += 8 + length;
    }
    arrays_[name.substr(0, name.find(' '))] = values;
  }
  double value(std::size_t at, const std::string& type) const {
    if (type == "REAL") return static_cast<double>(std::bit_cast<float>(word(at)));
    if (type == "INTE") return static_cast<double>(static_cast<std::int32_t>(word(at)));
    if (type == "DOUB") return std::bit_cast<double>((std::uint64_t{word(at)} << 32U) | word(at + 4));
    return 0.0;  // text and logicals are not wanted here
  }

  std::string bytes_;
  std::size_t at_ = 0;
  std::map<std::string, std::vector<double>> arrays_;
};

}  // namespace

bool has_flow() { return std::system("command -v flow > /dev/null 2>&1") == 0; }

std::map<std::pair<HostCellId, HostCellId>, double> flow_transmissibilities(const CornerPointGrid& grid,
                                                                            const std::string& folder) {
  write_deck(grid, folder + "/GRID.DATA");
  const std::string command = fmt::format("cd '{}' && flow --enable-dry-run=true GRID.DATA > flow.log 2>&1", folder);
  if (std::system(command.c_str()) != 0) throw std::runtime_error("flow failed; see " + folder + "/flow.log");
  const OutputFile init(folder + "/GRID.INIT");
  const OutputFile egrid(folder + "/GRID.EGRID");

  std::vector<std::int64_t> active;  // INIT holds active cells only; EGRID has no ACTNUM when all are
  const auto flags = egrid.values("ACTNUM");
  const auto is_active = [&](std::int64_t c) { return flags.empty() || flags[static_cast<std::size_t>(c)] > 0.0; };
  for (std::int64_t c = 0; c < grid.cell_count(); ++c)
    if (is_active(c)) active.push_back(c);
  std::map<std::pair<HostCellId, HostCellId>, double> out;
  const double unit = m3_per_transmissibility_unit(UnitSystem::metric);
  const auto add = [&](std::int64_t a, std::int64_t b, double value) {
    if (value > 0.0) out[{HostCellId(std::min(a, b)), HostCellId(std::max(a, b))}] += value * unit;
  };
  const std::array<std::int64_t, 3> step{1, grid.dimensions[0], grid.dimensions[0] * grid.dimensions[1]};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto values = init.values(std::array{"TRANX", "TRANY", "TRANZ"}[axis]);
    if (values.size() != active.size())
      throw std::runtime_error("flow wrote transmissibilities of another number of cells");
    for (std::size_t c = 0; c < active.size(); ++c) {
      std::int64_t next = active[c] + step[axis];
      // Flow writes a connection across a pinch-out in the place of the one to the next layer.
      while (axis == 2 && next < grid.cell_count() && !is_active(next)) next += step[axis];
      add(active[c], next, values[c]);
    }
  }
  const auto first = egrid.values("NNC1");
  const auto second = egrid.values("NNC2");
  const auto value = init.values("TRANNNC");
  for (std::size_t n = 0; n < value.size(); ++n)
    add(static_cast<std::int64_t>(first.at(n)) - 1, static_cast<std::int64_t>(second.at(n)) - 1, value[n]);
  return out;
}

}  // namespace wellknit
