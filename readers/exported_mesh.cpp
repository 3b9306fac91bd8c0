// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/exported_mesh.h"

#include <array>
#include <charconv>
#include <string>
#include <vector>

namespace wellknit {

namespace {

constexpr std::size_t most_numbers = 8;

using Count = std::optional<std::int64_t>;

std::string_view line_at(std::string_view text, std::size_t start) {
  if (start >= text.size()) return {};
  const std::string_view rest = text.substr(start);
  return rest.substr(0, rest.find('\n'));
}

/// Line number `n`, from 0.
std::string_view line(std::string_view text, int n) {
  std::size_t start = 0;
  for (; n > 0; --n) {
    const std::size_t end = text.find('\n', start);
    if (end == std::string_view::npos) return {};
    start = end + 1;
  }
  return line_at(text, start);
}

/// The whole numbers of a line; empty when anything else is in it, or more than any head has.
std::vector<std::int64_t> whole_numbers(std::string_view line) {
  std::vector<std::int64_t> out;
  const char* at = line.data();
  const char* const end = at + line.size();
  while (at != end) {
    if (*at == ' ' || *at == '\r') {
      ++at;
      continue;
    }
    std::int64_t value = 0;
    const auto [stop, error] = std::from_chars(at, end, value);
    if (out.size() == most_numbers || error != std::errc() || (stop != end && *stop != ' ' && *stop != '\r')) return {};
    out.push_back(value);
    at = stop;
  }
  return out;
}

/// The number after a keyword that begins a line.
Count number_after(std::string_view text, std::string_view keyword) {
  std::size_t at = text.starts_with(keyword) ? 0 : text.find(std::string("\n") + std::string(keyword));
  if (at == std::string_view::npos) return {};
  at += keyword.size() + (at == 0 ? 0 : 1);
  const std::vector<std::int64_t> numbers = whole_numbers(line_at(text, at));
  return numbers.size() == 1 ? Count(numbers[0]) : Count();
}

/// Lines that follow the one that begins with `head`, up to an empty line, a line of `#`, or the end.
Count lines_after(std::string_view text, std::string_view head) {
  std::size_t at = text.starts_with(head) ? 0 : text.find(std::string("\n") + std::string(head));
  if (at == std::string_view::npos) return {};
  at = text.find('\n', at + 1);
  std::int64_t count = 0;
  while (at != std::string_view::npos && ++at < text.size()) {
    const char first = text[at];
    if (first == '\n' || first == '\r' || first == '#') break;
    ++count;
    at = text.find('\n', at);
  }
  return count;
}

ExportedCounts count_opm_grid(std::string_view text) {
  const std::vector<std::int64_t> sizes = whole_numbers(line(text, 0));
  return {sizes[1], sizes[2], sizes[3], {}};
}

ExportedCounts count_stor(std::string_view text) {
  const std::vector<std::int64_t> sizes = whole_numbers(line(text, 2));
  if (sizes.size() != 5) return {};
  // Entries of the matrix are the rest of the graph after n + 1 pointers: n diagonals and two for each connection.
  return {sizes[1], {}, {}, (sizes[2] - 2 * sizes[1] - 1) / 2};
}

Count single_number(std::string_view text) {
  const std::vector<std::int64_t> numbers = whole_numbers(text);
  return numbers.size() == 1 ? Count(numbers[0]) : Count();
}

/// The length of an array in a ZIP file that is not compressed: numpy's head follows the name.
Count length_of_npy(std::string_view text, std::string_view name) {
  constexpr std::size_t looked_at = 256;
  const std::size_t at = text.find(name);
  if (at == std::string_view::npos) return {};
  const std::string_view head = text.substr(at, looked_at);
  const std::size_t shape = head.find("'shape': (");
  if (shape == std::string_view::npos) return {};
  const std::string_view rest = head.substr(shape + 10);
  return single_number(rest.substr(0, rest.find(',')));
}

/// The whole number between the quotes after `name="` in the head of a VTK file.
Count xml_number(std::string_view text, std::string_view name) {
  constexpr std::size_t looked_at = 2000;
  const std::string_view head = text.substr(0, looked_at);
  const std::string wanted = std::string(name) + "=\"";
  const std::size_t at = head.find(wanted);
  if (at == std::string_view::npos) return {};
  const std::string_view rest = head.substr(at + wanted.size());
  return single_number(rest.substr(0, rest.find('"')));
}

bool is_vtk_of(std::string_view text, std::string_view kind) {
  constexpr std::size_t looked_at = 500;
  const std::string_view head = text.substr(0, looked_at);
  return head.find("<VTKFile") != std::string_view::npos &&
         head.find("type=\"" + std::string(kind) + "\"") != std::string_view::npos;
}

/// The number after `name:` in the note of an OpenFOAM file.
Count note_number(std::string_view text, std::string_view name) {
  constexpr std::size_t looked_at = 2000;
  const std::string_view head = text.substr(0, looked_at);
  const std::size_t at = head.find(name);
  if (at == std::string_view::npos) return {};
  const std::string_view rest = head.substr(at + name.size());
  return single_number(rest.substr(0, rest.find_first_of("nN\"")));
}

}  // namespace

bool looks_like_opm_grid(std::string_view text) {
  const std::vector<std::int64_t> sizes = whole_numbers(line(text, 0));
  if (sizes.size() != 6 || sizes[0] != 3) return false;
  const std::vector<std::int64_t> flags = whole_numbers(line(text, 1));
  return flags.size() == 2 && flags[0] >= 0 && flags[0] <= 1 && flags[1] >= 0 && flags[1] <= 1;
}

bool looks_like_mat_file(std::string_view text) { return text.starts_with("MATLAB 5.0 MAT-file"); }
bool looks_like_pflotran_grid(std::string_view text) {
  return text.starts_with("CELLS ") && whole_numbers(line(text, 0).substr(6)).size() == 1;
}
bool looks_like_tough_mesh(std::string_view text) { return text.starts_with("ELEME"); }
bool looks_like_darts_arrays(std::string_view text) {
  return text.starts_with("PK\x03\x04") && text.substr(0, 41).ends_with("block_m.npy");
}
bool looks_like_adgprs_connections(std::string_view text) { return text.starts_with("TPFACONNS"); }
bool looks_like_cell_table(std::string_view text) { return text.starts_with("cell,kind,x,y,depth,"); }
bool looks_like_connection_table(std::string_view text) { return text.starts_with("first,second,kind,"); }
bool looks_like_fehm_stor(std::string_view text) { return text.starts_with("fehmstor "); }
bool looks_like_dgf(std::string_view text) { return text.starts_with("DGF\n") || text.starts_with("DGF\r\n"); }

bool looks_like_vtk_grid(std::string_view text) { return is_vtk_of(text, "UnstructuredGrid"); }
bool looks_like_vtk_lines(std::string_view text) { return is_vtk_of(text, "PolyData"); }
bool looks_like_foam_labels(std::string_view text) {
  return text.starts_with("FoamFile") && text.substr(0, 500).find("labelList") != std::string_view::npos;
}

std::span<const std::string_view> counted_files_of_folders() {
  static constexpr std::array<std::string_view, 8> names{"mesh.uge",
                                                         "mesh.h5",
                                                         "MESH",
                                                         "mesh.stor",
                                                         "cells.csv",
                                                         "connections.csv",
                                                         "connections.txt",
                                                         "constant/polyMesh/owner"};
  return names;
}

ExportedCounts count_exported_mesh(std::string_view text) {
  if (looks_like_opm_grid(text)) return count_opm_grid(text);
  if (looks_like_pflotran_grid(text)) return {number_after(text, "CELLS "), {}, {}, number_after(text, "CONNECTIONS ")};
  if (looks_like_tough_mesh(text)) return {lines_after(text, "ELEME"), {}, {}, lines_after(text, "CONNE")};
  if (looks_like_darts_arrays(text))
    return {length_of_npy(text, "volume.npy"), {}, {}, length_of_npy(text, "block_m.npy")};
  if (looks_like_vtk_grid(text)) return {xml_number(text, "NumberOfCells"), {}, xml_number(text, "NumberOfPoints"), {}};
  if (looks_like_vtk_lines(text))
    return {xml_number(text, "NumberOfLines"), {}, xml_number(text, "NumberOfPoints"), {}};
  if (looks_like_foam_labels(text))
    return {note_number(text, "nCells:"), note_number(text, "nFaces:"), note_number(text, "nPoints:"), {}};
  if (looks_like_adgprs_connections(text)) {
    const std::vector<std::int64_t> count = whole_numbers(line(text, 1));
    return {{}, {}, {}, count.size() == 1 ? Count(count[0]) : Count()};
  }
  if (looks_like_cell_table(text)) return {lines_after(text, "cell,"), {}, {}, {}};
  if (looks_like_connection_table(text)) return {{}, {}, {}, lines_after(text, "first,")};
  if (looks_like_fehm_stor(text)) return count_stor(text);
  if (looks_like_dgf(text))
    return {lines_after(text, "Polyhedron\n"), lines_after(text, "Polygon\n"), lines_after(text, "Vertex\n"), {}};
  return {};
}

}  // namespace wellknit
