// The access from a public handle to its Impl, for the library and its tests only.
#pragma once

namespace medial_vk {

/// A friend of every public handle; callers include the header that defines the handle's Impl.
struct Internals {
  template <class Handle>
  static auto& of(Handle& handle) {
    return *handle.impl_;
  }

  template <class Tree>
  static auto refined(const Tree& tree, unsigned leaf_size) {
    return tree.refined(leaf_size);
  }

  /// The type of the Impl, whose name is private.
  template <class Handle>
  struct ImplOf {
    using Type = typename Handle::Impl;
  };
};

}  // namespace medial_vk
