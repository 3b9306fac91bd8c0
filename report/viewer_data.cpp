// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "report/viewer_data.h"

#include <fmt/format.h>
#include <openssl/evp.h>
#include <tbb/parallel_for.h>
#include <zlib.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <functional>
#include <new>
#include <nlohmann/json.hpp>
#include <span>

#include "model/errors.h"
#include "model/quality.h"
#include "model/units.h"
#include "report/html.h"

namespace wellknit {

namespace {

static_assert(std::endian::native == std::endian::little, "the page reads little-endian numbers");

using Json = nlohmann::ordered_json;

/// An array of the page: integers as differences to the one before, or floats.
struct PageArray {
  std::string name;
  bool is_integer = false;
  std::vector<std::uint32_t> words;
};

PageArray integers(std::string name, std::size_t count, const std::function<std::int64_t(std::size_t)>& value) {
  PageArray out{std::move(name), true, std::vector<std::uint32_t>(count)};
  std::int64_t last = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::int64_t now = value(i);
    const auto step = static_cast<std::int32_t>(now - last);
    // Small steps of either sign have few bits: 0, -1, 1, -2 … as 0, 1, 2, 3 …
    out.words[i] = (static_cast<std::uint32_t>(step) << 1U) ^ static_cast<std::uint32_t>(step >> 31);
    last = now;
  }
  return out;
}

PageArray floats(std::string name, std::size_t count, const std::function<double(std::size_t)>& value) {
  PageArray out{std::move(name), false, std::vector<std::uint32_t>(count)};
  for (std::size_t i = 0; i < count; ++i) out.words[i] = std::bit_cast<std::uint32_t>(static_cast<float>(value(i)));
  return out;
}

/// First bytes of all words, then second bytes …: equal exponents and high bytes lie together.
std::vector<unsigned char> shuffled(const std::vector<std::uint32_t>& words) {
  std::vector<unsigned char> out(4 * words.size());
  for (std::size_t i = 0; i < words.size(); ++i)
    for (std::size_t byte = 0; byte < 4; ++byte)
      out[byte * words.size() + i] = static_cast<unsigned char>(words[i] >> (8 * byte));
  return out;
}

std::vector<unsigned char> deflated(const std::vector<unsigned char>& bytes) {
  constexpr int level = 4;  // level 6 takes twice the time for 3 % less
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::vector<unsigned char> out(size);
  if (compress2(out.data(), &size, bytes.data(), static_cast<uLong>(bytes.size()), level) != Z_OK)
    throw std::bad_alloc();  // with so large an output nothing else can fail
  out.resize(size);
  return out;
}

std::string base64(const std::vector<unsigned char>& bytes) {
  // OpenSSL counts in int: blocks of a whole number of threes join without padding between.
  constexpr std::size_t block = 3U << 20U;
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  std::vector<unsigned char> text(block / 3 * 4 + 1);
  for (std::size_t begin = 0; begin < bytes.size(); begin += block) {
    const auto count = static_cast<int>(std::min(block, bytes.size() - begin));
    const int written = EVP_EncodeBlock(text.data(), bytes.data() + begin, count);
    out.append(text.begin(), text.begin() + written);
  }
  return out;
}

/// Middle of the vertices' box, so that 32 bits a coordinate give millimetres.
Vec3 origin_of(const Mesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Vec3& vertex : mesh.vertices)
    if (vertex.allFinite()) box.extend(vertex);
  return box.isEmpty() ? Vec3(Vec3::Zero()) : Vec3(box.center());
}

void add_geometry(const Mesh& mesh, const Vec3& origin, std::vector<PageArray>& out) {
  const std::size_t vertices = mesh.vertices.size();
  out.push_back(floats("vertices", 3 * vertices, [&](std::size_t i) {
    const auto axis = static_cast<Eigen::Index>(i / vertices);
    return mesh.vertices[VertexId(i % vertices)][axis] - origin[axis];
  }));
  const Faces& faces = mesh.faces;
  out.push_back(integers("face_size", faces.size(),
                         [&](std::size_t f) { return faces.vertex_start[f + 1] - faces.vertex_start[f]; }));
  out.push_back(
      integers("face_vertices", faces.vertices.size(), [&](std::size_t i) { return faces.vertices[i].value(); }));
  out.push_back(integers("face_first", faces.size(), [&](std::size_t f) { return faces.cells[FaceId(f)][0].value(); }));
  out.push_back(
      integers("face_second", faces.size(), [&](std::size_t f) { return faces.cells[FaceId(f)][1].value(); }));
}

/// Arrays of the cells that the picture can be coloured by, in the order of its list.
class CellArrays {
 public:
  CellArrays(const Mesh& mesh, std::size_t budget) : mesh_(mesh), budget_(budget) {}

  void add(const std::string& name, const std::string& title, const std::function<double(CellId)>& value,
           bool is_whole = false) {
    const std::size_t count = mesh_.cells.size();
    if (bytes_ + 4 * count > budget_) {
      left_out_.push_back(title);
      return;
    }
    bytes_ += 4 * count;
    const auto of = [&](std::size_t i) { return value(CellId(i)); };
    if (is_whole)
      arrays_.push_back(integers(name, count, [&](std::size_t i) { return static_cast<std::int64_t>(of(i)); }));
    else
      arrays_.push_back(floats(name, count, of));
    list_.push_back({{"name", name}, {"title", title}});
  }

  std::vector<PageArray>& arrays() { return arrays_; }
  [[nodiscard]] const Json& list() const { return list_; }
  [[nodiscard]] const std::vector<std::string>& left_out() const { return left_out_; }

 private:
  const Mesh& mesh_;
  std::size_t budget_;
  std::size_t bytes_ = 0;
  std::vector<PageArray> arrays_;
  Json list_ = Json::array();
  std::vector<std::string> left_out_;
};

void add_quality(const CellQuality& quality, CellArrays& out) {
  out.add("nonorth", "non-orthogonality, worst face, °", [&](CellId c) { return quality.max_non_orthogonality[c]; });
  out.add("knonorth", "K-orthogonality, worst face, °", [&](CellId c) { return quality.max_k_non_orthogonality[c]; });
  out.add("planarity", "planarity, worst face", [&](CellId c) { return quality.max_planarity[c]; });
  out.add("skewness", "centring (skewness), worst face", [&](CellId c) { return quality.max_skewness[c]; });
  out.add("centring", "nearest face over size", [&](CellId c) { return quality.centring[c]; });
}

void add_cells(const Mesh& mesh, CellArrays& out) {
  const Cells& cells = mesh.cells;
  if (mesh.flow && mesh.flow->pressure.size() == cells.size())
    out.add("pressure", "pressure of solve, bar", [&](CellId c) { return mesh.flow->pressure[c] / pascal_per_bar; });
  out.add("volume", "bulk volume, m³", [&](CellId c) { return cells.volume[c]; });
  out.add("pore_volume", "pore volume, m³", [&](CellId c) { return cells.pore_volume[c]; });
  out.add("porosity", "porosity", [&](CellId c) { return cells.porosity[c]; });
  constexpr std::array<const char*, 3> axes{"x", "y", "depth"};
  for (int axis = 0; axis < 3; ++axis)
    out.add(fmt::format("permeability_{}", axis),
            fmt::format("permeability along {}, mD", axes[static_cast<std::size_t>(axis)]),
            [&cells, axis](CellId c) { return cells.permeability[c][axis] / m2_per_millidarcy; });
  out.add("depth", "depth, m", [&](CellId c) { return cells.depth[c]; });
  const auto whole = [&](const char* name, const char* title, const std::function<std::int64_t(CellId)>& value) {
    out.add(
        name, title, [&](CellId c) { return static_cast<double>(value(c)); }, true);
  };
  whole("well", "well, by its number", [&](CellId c) { return cells.well[c].value(); });
  whole("ring", "ring of the radial mesh", [&](CellId c) { return cells.radial_index[c].ring; });
  whole("source_cell", "source cell", [&](CellId c) { return cells.source_cell[c].value(); });
  for (const auto& [keyword, values] : cells.properties) {
    const std::string name = "property_" + keyword;
    if (const auto* numbers = std::get_if<std::vector<double>>(&values))
      out.add(name, keyword, [numbers](CellId c) { return (*numbers)[c.index()]; });
    else if (const auto* counts = std::get_if<std::vector<std::int32_t>>(&values))
      out.add(
          name, keyword, [counts](CellId c) { return (*counts)[c.index()]; }, true);
  }
}

Json wells_of(const Mesh& mesh, const Vec3& origin) {
  Json out = Json::array();
  for (const MeshWell& well : mesh.wells) {
    Json path = Json::array();
    for (const Vec3& point : well.trajectory.points)
      for (int axis = 0; axis < 3 && point.allFinite(); ++axis)
        path.push_back(std::round((point[axis] - origin[axis]) * 1e3) / 1e3);
    out.push_back({{"name", well.name}, {"radius", well.drainage_radius}, {"path", std::move(path)}});
  }
  return out;
}

std::string element_of(const PageArray& array) {
  return fmt::format("<script type=\"text/plain\" data-array=\"{}\" data-type=\"{}\" data-count=\"{}\">{}</script>\n",
                     escaped(array.name), array.is_integer ? "integer" : "float", array.words.size(),
                     base64(deflated(shuffled(array.words))));
}

}  // namespace

ViewerData viewer_data(const Mesh& mesh, std::size_t budget) {
  const Vec3 origin = origin_of(mesh);
  const CellQuality quality = cell_quality(mesh);
  CellArrays cells(mesh, budget);
  cells.add(
      "kind", "kind", [&](CellId c) { return static_cast<double>(mesh.cells.kind[c]); }, true);
  add_quality(quality, cells);
  add_cells(mesh, cells);
  std::vector<PageArray> arrays;
  add_geometry(mesh, origin, arrays);
  std::ranges::move(cells.arrays(), std::back_inserter(arrays));

  std::vector<std::string> elements(arrays.size());
  tbb::parallel_for(std::size_t{0}, arrays.size(), [&](std::size_t i) { elements[i] = element_of(arrays[i]); });
  ViewerData out;
  for (const std::string& element : elements) out.html += element;
  const Json list{{"cells", mesh.cells.size()},
                  {"origin", {origin.x(), origin.y(), origin.z()}},
                  {"arrays", cells.list()},
                  {"wells", wells_of(mesh, origin)}};
  out.html += "<script type=\"application/json\" id=\"picture\">" +
              inside_script(list.dump(-1, ' ', false, Json::error_handler_t::replace)) + "</script>\n";
  out.left_out = cells.left_out();
  return out;
}

}  // namespace wellknit
