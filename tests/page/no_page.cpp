// A program with this in it is one whose build had no npm: it comes before the library's.
#include "output/page/embedded_page.h"

namespace medial_vk::page {

std::string_view embedded_page() { return {}; }

}  // namespace medial_vk::page
