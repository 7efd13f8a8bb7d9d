// The one way from a public handle to what it owns, for the rooms of the library and for its tests.
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
