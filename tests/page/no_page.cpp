// A program with this file behaves like one whose build had no npm: it precedes the library's definition.
#include "output/page/embedded_page.h"

namespace medial_vk::page {

std::string_view embedded_page() { return {}; }

}  // namespace medial_vk::page
