#include "support/scenes/scene_files.h"

#include <cstring>
#include <nlohmann/json.hpp>
#include <sstream>

#include "support/scenes/gltf_writer.h"
#include "support/solids/mesh_files.h"

namespace medial_vk::test {
namespace {

using nlohmann::json;

std::string little(std::uint32_t value) { return bytes_of(value, false); }

// ---- FBX: a tree of nodes, each with its end in the file.

struct FbxNode {
  std::string name;
  std::string properties = {};
  std::uint32_t count = 0;
  std::vector<FbxNode> children = {};

  FbxNode& text(const std::string& value) {
    return add("S" + little(static_cast<std::uint32_t>(value.size())) + value);
  }
  FbxNode& whole(std::int32_t value) { return add("I" + bytes_of(value, false)); }
  FbxNode& id(std::int32_t value) { return add("L" + bytes_of(value, false) + std::string(4, '\0')); }
  FbxNode& real(double value) { return add("D" + bytes_of(value, false)); }
  FbxNode& array(char type, std::size_t size, const std::string& values) {
    return add(type + little(static_cast<std::uint32_t>(size)) + little(0) +
               little(static_cast<std::uint32_t>(values.size())) + values);
  }
  FbxNode& add(const std::string& property) {
    properties += property;
    ++count;
    return *this;
  }

  std::string bytes(std::size_t at) const {
    const std::size_t body = at + 13 + name.size() + properties.size();
    std::string inner;
    for (const FbxNode& child : children) inner += child.bytes(body + inner.size());
    if (!children.empty()) inner += std::string(13, '\0');
    return little(static_cast<std::uint32_t>(body + inner.size())) + little(count) +
           little(static_cast<std::uint32_t>(properties.size())) + static_cast<char>(name.size()) + name + properties +
           inner;
  }
};

FbxNode fbx_vector(const char* name, const Point& value) {
  FbxNode node{"P"};
  node.text(name).text(name).text("").text("A").real(value[0]).real(value[1]).real(value[2]);
  return node;
}

FbxNode fbx_link(std::int32_t from, std::int32_t to) {
  FbxNode node{"C"};
  node.text("OO").id(from).id(to);
  return node;
}

}  // namespace

GltfFile to_gltf(const std::vector<SceneMesh>& meshes, const std::vector<SceneNode>& nodes, GltfBuffer where,
                 const std::string& uri) {
  GltfWriter writer;
  json& document = writer.document;
  bool is_skinned = false;
  for (const SceneNode& node : nodes) is_skinned = is_skinned || node.skin >= 0;
  for (const SceneMesh& mesh : meshes) {
    json primitives = json::array();
    for (const Mesh& part : mesh.primitives) primitives.push_back(writer.primitive_of(part, mesh.mode, is_skinned));
    document["meshes"].push_back({{"primitives", primitives}});
  }
  json roots = json::array();
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const SceneNode& node = nodes[i];
    json out = {{"translation", node.translation}, {"rotation", node.rotation}, {"scale", node.scale}};
    if (!node.name.empty()) out["name"] = node.name;
    if (node.mesh >= 0) out["mesh"] = node.mesh;
    if (node.skin >= 0) {
      json skin = {{"joints", {node.skin}}};
      std::string identity;
      for (int k = 0; k < 16; ++k) identity += bytes_of(k % 5 == 0 ? 1.f : 0.f, false);
      if (node.has_bind_matrices) skin["inverseBindMatrices"] = writer.add_accessor(identity, 5126, "MAT4", 1);
      document["skins"].push_back(skin);
      out["skin"] = document["skins"].size() - 1;
    }
    document["nodes"].push_back(out);
    if (node.parent < 0) roots.push_back(i);
    if (node.parent >= 0) document["nodes"][static_cast<std::size_t>(node.parent)]["children"].push_back(i);
  }
  document["scenes"] = json::array({{{"nodes", roots}}});
  if (where == GltfBuffer::kGlb) return {writer.glb(), ""};
  if (where == GltfBuffer::kInside) return {writer.gltf(), ""};
  document["buffers"] = json::array({{{"byteLength", writer.buffer.size()}, {"uri", uri}}});
  return {document.dump(), writer.buffer};
}

std::string to_collada(const std::vector<Point>& vertices, const std::vector<std::vector<int>>& polygons,
                       const std::string& metres, const std::string& up) {
  std::ostringstream out, counts, corners;
  out.precision(17);
  for (const std::vector<int>& polygon : polygons) {
    counts << polygon.size() << ' ';
    for (const int corner : polygon) corners << corner << ' ';
  }
  out << "<?xml version=\"1.0\"?>\n<COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\">"
      << "<asset><unit name=\"u\" meter=\"" << metres << "\"/><up_axis>" << up << "</up_axis></asset>"
      << "<library_geometries><geometry id=\"g\"><mesh><source id=\"p\"><float_array id=\"a\" count=\""
      << 3 * vertices.size() << "\">";
  for (const Point& p : vertices) out << p[0] << ' ' << p[1] << ' ' << p[2] << ' ';
  out << "</float_array><technique_common><accessor source=\"#a\" count=\"" << vertices.size()
      << "\" stride=\"3\"><param name=\"X\" type=\"float\"/><param name=\"Y\" type=\"float\"/><param name=\"Z\" "
         "type=\"float\"/></accessor></technique_common></source><vertices id=\"v\"><input semantic=\"POSITION\" "
         "source=\"#p\"/></vertices><polylist count=\""
      << polygons.size() << "\"><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><vcount>" << counts.str()
      << "</vcount><p>" << corners.str()
      << "</p></polylist></mesh></geometry></library_geometries><library_visual_scenes><visual_scene id=\"s\"><node "
         "id=\"part\" name=\"part\"><instance_geometry "
         "url=\"#g\"/></node></visual_scene></library_visual_scenes><scene>"
         "<instance_visual_scene url=\"#s\"/></scene></COLLADA>\n";
  return out.str();
}

std::string to_fbx(const Mesh& mesh, const std::string& name, const Point& translation, const Point& scale) {
  std::string vertices, corners;
  for (const Point& p : mesh.vertices) {
    for (const double x : p) vertices += bytes_of(x, false);
  }
  for (const Triangle& t : mesh.triangles) {
    const auto corner = [](std::uint32_t v) { return static_cast<std::int32_t>(v); };
    corners += bytes_of(corner(t[0]), false) + bytes_of(corner(t[1]), false) + bytes_of(~corner(t[2]), false);
  }
  FbxNode header{"FBXHeaderExtension"}, version{"FBXVersion"}, objects{"Objects"}, links{"Connections"};
  header.children.push_back(version.whole(7400));
  FbxNode geometry{"Geometry"}, model{"Model"}, positions{"Vertices"}, indices{"PolygonVertexIndex"},
      moved{"Properties70"};
  geometry.id(100).text(std::string("g\0\1Geometry", 11)).text("Mesh");
  geometry.children = {positions.array('d', 3 * mesh.vertices.size(), vertices),
                       indices.array('i', 3 * mesh.triangles.size(), corners)};
  moved.children = {fbx_vector("Lcl Translation", translation), fbx_vector("Lcl Scaling", scale)};
  model.id(200).text(name + std::string("\0\1Model", 7)).text("Mesh");
  model.children = {moved};
  objects.children = {geometry, model};
  links.children = {fbx_link(100, 200), fbx_link(200, 0)};
  std::string bytes = std::string("Kaydara FBX Binary  \0\x1a\0", 23) + little(7400);
  for (const FbxNode& node : {header, objects, links}) bytes += node.bytes(bytes.size());
  return bytes + std::string(13, '\0');
}

}  // namespace medial_vk::test
