// Archives, by libzip.
#include <zip.h>

#include <sstream>

#include "support/scenes/scene_files.h"

namespace medial_vk::test {

std::string to_zip(const std::vector<std::pair<std::string, std::string>>& files) {
  zip_source_t* source = ::zip_source_buffer_create(nullptr, 0, 0, nullptr);
  ::zip_source_keep(source);
  zip_t* zip = ::zip_open_from_source(source, ZIP_TRUNCATE, nullptr);
  for (const auto& [name, bytes] : files) {
    ::zip_file_add(zip, name.c_str(), ::zip_source_buffer(zip, bytes.data(), bytes.size(), 0), 0);
  }
  ::zip_close(zip);
  zip_stat_t status;
  ::zip_source_stat(source, &status);
  std::string out(status.size, '\0');
  ::zip_source_open(source);
  ::zip_source_read(source, out.data(), out.size());
  ::zip_source_close(source);
  ::zip_source_free(source);
  return out;
}

std::string to_3mf(const std::vector<std::pair<Mesh, std::string>>& items, const std::string& unit) {
  std::ostringstream model, build;
  model.precision(17);
  model << "<?xml version=\"1.0\"?>\n<model unit=\"" << unit
        << "\" xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\"><resources>";
  for (std::size_t i = 0; i < items.size(); ++i) {
    model << "<object id=\"" << i + 1 << "\" name=\"item " << i + 1 << "\" type=\"model\"><mesh><vertices>";
    for (const Point& p : items[i].first.vertices) {
      model << "<vertex x=\"" << p[0] << "\" y=\"" << p[1] << "\" z=\"" << p[2] << "\"/>";
    }
    model << "</vertices><triangles>";
    for (const Triangle& t : items[i].first.triangles) {
      model << "<triangle v1=\"" << t[0] << "\" v2=\"" << t[1] << "\" v3=\"" << t[2] << "\"/>";
    }
    model << "</triangles></mesh></object>";
    build << "<item objectid=\"" << i + 1 << "\"";
    if (!items[i].second.empty()) build << " transform=\"" << items[i].second << "\"";
    build << "/>";
  }
  model << "</resources><build>" << build.str() << "</build></model>";
  const std::string types =
      "<?xml version=\"1.0\"?><Types xmlns=\"http://schemas.openxmlformats.org/package/2006/content-types\"><Default "
      "Extension=\"rels\" ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/><Default "
      "Extension=\"model\" ContentType=\"application/vnd.ms-package.3dmanufacturing-3dmodel+xml\"/></Types>";
  const std::string links =
      "<?xml version=\"1.0\"?><Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">"
      "<Relationship Target=\"/3D/3dmodel.model\" Id=\"rel0\" "
      "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>";
  return to_zip({{"[Content_Types].xml", types}, {"_rels/.rels", links}, {"3D/3dmodel.model", model.str()}});
}

}  // namespace medial_vk::test
