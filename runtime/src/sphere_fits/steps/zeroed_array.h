// Arrays whose elements are zero until they are written.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <type_traits>

namespace medial_vk {

/// As the system gives pages of zeros when they are first written, a large array of which a small part is used costs
/// the time and the memory of that part.
template <class T>
class ZeroedArray {
  static_assert(std::is_integral_v<T>);

 public:
  /// As many elements, all zero. Throws std::bad_alloc.
  void assign(std::size_t size) {
    elements_.reset();
    elements_.reset(static_cast<T*>(std::calloc(size > 0 ? size : 1, sizeof(T))));
    if (!elements_) throw std::bad_alloc();
  }
  T* data() { return elements_.get(); }
  T& operator[](std::size_t i) { return elements_.get()[i]; }
  const T& operator[](std::size_t i) const { return elements_.get()[i]; }

 private:
  struct Free {
    void operator()(T* elements) const { std::free(elements); }
  };
  std::unique_ptr<T[], Free> elements_;
};

}  // namespace medial_vk
