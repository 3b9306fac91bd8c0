// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "readers/formats.h"

#include <fmt/format.h>

#include <algorithm>

#include "model/errors.h"
#include "readers/deck_keywords.h"
#include "readers/deck_tokens.h"
#include "readers/ecl_records.h"
#include "readers/exported_mesh.h"
#include "readers/file_content.h"
#include "readers/read_binary_grdecl.h"
#include "readers/read_egrid.h"
#include "readers/read_grid_file.h"
#include "readers/read_init.h"
#include "readers/read_roff.h"
#include "readers/read_trajectory_csv.h"
#include "readers/read_trajectory_dev.h"
#include "readers/read_trajectory_json.h"
#include "readers/read_trajectory_las.h"
#include "readers/read_trajectory_petrel.h"
#include "readers/read_trajectory_rms.h"
#include "readers/read_trajectory_witsml.h"
#include "readers/text.h"

namespace wellknit {

namespace {

bool starts_with(std::string_view text, std::string_view start) { return text.substr(0, start.size()) == start; }

bool is_hdf5(std::string_view text) { return starts_with(text, "\x89HDF\r\n\x1a\n"); }
bool is_zip(std::string_view text) { return starts_with(text, "PK\x03\x04"); }
bool is_restart(std::string_view text) { return begins_with_ecl_header(text, {"SEQNUM"}); }
bool is_summary(std::string_view text) { return begins_with_ecl_header(text, {"SEQHDR", "RESTART"}); }

bool is_deck(std::string_view text) {
  DeckTokens tokens(text);
  const DeckToken token = tokens.next();
  return token.kind == DeckToken::Kind::word && upper_case(token.text) == "RUNSPEC";
}

bool is_grdecl(std::string_view text) {
  DeckTokens tokens(text);
  const DeckToken token = tokens.next();
  return token.kind == DeckToken::Kind::word && find_deck_keyword(upper_case(token.text), DeckSection::bare) != nullptr;
}

std::string extension_of(const std::string& path) {
  const auto slash = path.find_last_of('/');
  const auto dot = path.find_last_of('.');
  if (dot == std::string::npos || (slash != std::string::npos && dot < slash)) return {};
  std::string out = path.substr(dot);
  std::transform(out.begin(), out.end(), out.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return out;
}

// clang-format off
std::vector<ReaderFormat> make_table() {
  using K = FormatKind;
  constexpr bool read = true, unread = false, binary = true, text = false;
  return {
      {"wellknit mesh", K::mesh, {".h5"}, "HDF5 signature",
       "hybrid mesh with connections and wells", read, binary, is_hdf5},
      {"EGRID", K::grid, {".egrid", ".fegrid"}, "record FILEHEAD",
       "Eclipse grid, binary or formatted", read, binary, looks_like_egrid, nullptr, parse_egrid},
      {"Eclipse GRID", K::grid, {".grid", ".fgrid"}, "record DIMENS",
       "older Eclipse grid, corners of each cell", read, binary, looks_like_grid_file, nullptr, parse_grid_file},
      {"Eclipse INIT", K::grid, {".init", ".finit"}, "record INTEHEAD",
       "properties that a simulator wrote; beside an EGRID", read, binary, looks_like_init, nullptr, parse_init},
      {"Eclipse restart", K::grid, {".unrst"}, "record SEQNUM",
       "results of a simulator", unread, binary, is_restart},
      {"Eclipse summary", K::grid, {".unsmry", ".smspec"}, "record SEQHDR or RESTART",
       "curves of a simulator", unread, binary, is_summary},
      {"binary GRDECL", K::grid, {".bgrdecl"}, "record with a GRDECL keyword",
       "GRDECL keywords in binary records", read, binary, looks_like_binary_grdecl, nullptr, parse_binary_grdecl},
      {"ROFF", K::grid, {".roff", ".roffasc"}, "'roff-bin' or 'roff-asc'",
       "RMS grid and parameters, binary or ASCII", read, binary, looks_like_roff, nullptr, parse_roff},
      {"open-DARTS arrays", K::mesh, {".npz"}, "ZIP with block_m.npy first",
       "connection list for open-DARTS", unread, binary, looks_like_darts_arrays},
      {"MATLAB file", K::mesh, {".mat"}, "'MATLAB 5.0 MAT-file'",
       "grid for MRST and JutulDarcy", unread, binary, looks_like_mat_file},
      {"OPM grid text", K::mesh, {".opmgrid"}, "six sizes, then two flags",
       "UnstructuredGrid of OPM", unread, text, looks_like_opm_grid},
      {"PFLOTRAN grid", K::mesh, {".uge"}, "CELLS and a number",
       "explicit unstructured grid", unread, text, looks_like_pflotran_grid},
      {"TOUGH mesh", K::mesh, {".mesh"}, "ELEME",
       "elements and connections", unread, text, looks_like_tough_mesh},
      {"AD-GPRS connections", K::mesh, {}, "TPFACONNS",
       "connection list", unread, text, looks_like_adgprs_connections},
      {"cell table", K::mesh, {}, "header cell,kind,x,y,depth",
       "cells of a mesh as CSV", unread, text, looks_like_cell_table},
      {"connection table", K::mesh, {}, "header first,second,kind",
       "connections of a mesh as CSV", unread, text, looks_like_connection_table},
      {"FEHM coefficients", K::mesh, {".stor"}, "fehmstor",
       "sparse matrix of connections", unread, text, looks_like_fehm_stor},
      {"DGF", K::mesh, {".dgf"}, "DGF",
       "polyhedra in the Dune grid format", unread, text, looks_like_dgf},
      {"VTU", K::mesh, {".vtu"}, "VTKFile of type UnstructuredGrid",
       "cells for ParaView, VTK and GEOS", unread, text, looks_like_vtk_grid},
      {"VTP", K::mesh, {".vtp"}, "VTKFile of type PolyData",
       "wells' trajectories for ParaView, VTK and GEOS", unread, text, looks_like_vtk_lines},
      {"OpenFOAM labels", K::mesh, {}, "FoamFile of class labelList",
       "owner or neighbour of a polyMesh", unread, text, looks_like_foam_labels},
      {"RESQML", K::grid, {".epc"}, "ZIP signature",
       "RESQML package", unread, binary, is_zip},
      {"Petrel well trace", K::wells, {".wellpath"}, "'WELL TRACE FROM PETREL'",
       "well path: MD X Y Z with head and datum", read, text, looks_like_petrel_trace, parse_petrel_trace},
      {"LAS deviation", K::wells, {".las"}, "section ~V",
       "well path: DEPT, DEVI, AZIM or X, Y, TVD among the curves", read, text, looks_like_las, parse_las},
      {"WITSML trajectory", K::wells, {".xml"}, "XML with a trajectory",
       "survey: WITSML 2.x and 1.4.1.1", read, text, looks_like_witsml, parse_witsml},
      {"ResInsight JSON", K::wells, {".json"}, "JSON with \"path\"",
       "well paths: east, north, tvd, md", read, text, looks_like_json_wells, parse_json_wells},
      {"RMS well", K::wells, {".w", ".rmswell"}, "version line 1.0 and a number of logs",
       "well paths with logs and perforations, several a file", read, text, looks_like_rms_well, parse_rms_well},
      {"trajectory CSV", K::wells, {".csv"}, "header with X, Y, TVD or MD, INC, AZI",
       "well paths: positions or a survey, metres or feet", read, text, looks_like_trajectory_csv, parse_trajectory_csv},
      {"ResInsight .dev", K::wells, {".dev"}, "rows X Y TVD MD, name lines, -999",
       "well paths, several a file", read, text, looks_like_dev_wells, parse_dev_wells},
      {"Eclipse deck", K::grid, {".data"}, "RUNSPEC",
       "whole deck: grid, properties, wells", read, text, is_deck},
      {"GRDECL", K::grid, {".grdecl", ".inc", ".grd"}, "keywords such as SPECGRID",
       "corner-point grid and properties as text", read, text, is_grdecl},
  };
}
// clang-format on

}  // namespace

const std::vector<ReaderFormat>& reader_formats() {
  static const std::vector<ReaderFormat> table = make_table();
  return table;
}

const ReaderFormat* recognise_binary(std::string_view text) {
  for (const ReaderFormat& format : reader_formats())
    if (format.is_binary && format.recognises(text)) return &format;
  return nullptr;
}

const ReaderFormat* recognise(const std::string& path, std::string_view text) {
  for (const ReaderFormat& format : reader_formats())
    if (format.recognises(text)) return &format;
  const std::string extension = extension_of(path);
  for (const ReaderFormat& format : reader_formats()) {
    const bool same =
        std::find(format.extensions.begin(), format.extensions.end(), extension) != format.extensions.end();
    if (same && !format.is_binary) return &format;
  }
  return nullptr;
}

std::string not_read_advice(const ReaderFormat& format) {
  if (format.is_read && format.read_grid != nullptr)
    return "INCLUDE takes text; give this file by itself, as CASE or with --grid-include";
  if (format.kind == FormatKind::mesh) return "a mesh is the result of a run; give the deck or the GRDECL file";
  if (format.kind == FormatKind::wells) return "not read yet; write the path as CSV with MD,X,Y,TVD";
  if (format.name == "Eclipse restart" || format.name == "Eclipse summary")
    return "it holds no grid; give the EGRID file of the same run";
  return "not read yet; export the grid as EGRID, ROFF or GRDECL";
}

const ReaderFormat& recognise_content(const FileContent& content) {
  const std::string& path = content.path;
  const auto* format = recognise(path, content.text);
  if (format == nullptr) {
    throw ParseError({path, 0, ""},
                     {"a deck, a grid, a well path or a mesh file",
                      content.text.empty() ? "an empty file" : "none that is known", "see wellknit formats"});
  }
  return *format;
}

const ReaderFormat& recognise_file(const std::string& path) {
  const ReaderFormat& format = recognise_content(load_file(path));
  if (!format.is_read) {
    throw ParseError({path, 0, ""}, {"a format that is read", fmt::format("a file in the format {}", format.name),
                                     not_read_advice(format)});
  }
  return format;
}

}  // namespace wellknit
