// Mesh files in memory, for the tests of the readers: every format, in its plain form.
#pragma once

#include <string>

#include "medial_vk/mesh.h"

namespace medial_vk::test {

std::string to_obj(const Mesh& mesh);
std::string to_off(const Mesh& mesh);
std::string to_ascii_ply(const Mesh& mesh);
std::string to_binary_ply(const Mesh& mesh, bool big_endian);
std::string to_ascii_stl(const Mesh& mesh);
std::string to_binary_stl(const Mesh& mesh);  // coordinates rounded to float

/// The bytes of a number in either order.
template <class T>
std::string bytes_of(T value, bool big_endian);

}  // namespace medial_vk::test
