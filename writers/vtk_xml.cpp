// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "writers/vtk_xml.h"

#include <bit>

namespace wellknit {

void write_vtk_file(OutputStream& out, std::string_view kind, const std::string& pieces, const AppendedArrays& arrays) {
  const std::string_view order = std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";
  out.stream() << fmt::format(
                      "<?xml version=\"1.0\"?>\n<VTKFile type=\"{}\" version=\"1.0\" byte_order=\"{}\" "
                      "header_type=\"UInt64\">\n<{}>\n",
                      kind, order, kind)
               << pieces << fmt::format("</{}>\n<AppendedData encoding=\"raw\">\n_", kind);
  out.stream().write(arrays.block().data(), static_cast<std::streamsize>(arrays.block().size()));
  out.stream() << "\n</AppendedData>\n</VTKFile>\n";
}

}  // namespace wellknit
