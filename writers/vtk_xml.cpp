// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "writers/vtk_xml.h"

#include <fmt/format.h>

#include <bit>

namespace wellknit {

std::string AppendedArrays::add(std::string_view name, std::string_view type, int components, std::uint64_t bytes,
                                WriteData data) {
  std::string escaped;
  for (const char c : name) escaped += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '"' ? "&quot;" : std::string(1, c);
  std::string xml =
      fmt::format("<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" offset=\"{}\"/>\n",
                  type, escaped, components, size_);
  size_ += sizeof bytes + bytes;
  entries_.push_back({bytes, std::move(data)});
  return xml;
}

void AppendedArrays::write(std::ostream& out) const {
  for (const Entry& entry : entries_) {
    out.write(reinterpret_cast<const char*>(&entry.bytes), sizeof entry.bytes);
    entry.write(out);
  }
}

void write_vtk_file(OutputStream& out, std::string_view kind, const std::string& pieces, const AppendedArrays& arrays) {
  const std::string_view order = std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";
  out.stream() << fmt::format(
                      "<?xml version=\"1.0\"?>\n<VTKFile type=\"{}\" version=\"1.0\" byte_order=\"{}\" "
                      "header_type=\"UInt64\">\n<{}>\n",
                      kind, order, kind)
               << pieces << fmt::format("</{}>\n<AppendedData encoding=\"raw\">\n_", kind);
  arrays.write(out.stream());
  out.stream() << "\n</AppendedData>\n</VTKFile>\n";
}

}  // namespace wellknit
