// The only access from a public handle to its Impl, for the parts of the library and its tests.
#pragma once

namespace medial_vk {

/// A friend of every public handle; callers include the header that defines the handle's Impl.
struct Internals {
  template <class Handle>
  static auto& of(Handle& handle) {
    return *handle.impl_;
  }
};

}  // namespace medial_vk
