// A program with this file behaves like one whose build had no npm: it precedes the library's definitions.
#include "output/motion_page/embedded_motion.h"
#include "output/page/embedded_page.h"
#include "output/plane_page/embedded_plane.h"
#include "output/site_page/embedded_sites.h"

namespace medial_vk::page {

std::string_view embedded_page() { return {}; }
std::string_view embedded_motion() { return {}; }
std::string_view embedded_plane() { return {}; }
std::string_view embedded_sites() { return {}; }

}  // namespace medial_vk::page
