/// Vectors for large arrays that are written before they are read.
#pragma once
#include <sys/mman.h>

#include <cstddef>
#include <memory>
#include <new>
#include <utility>
#include <vector>

namespace importon {

/// Leaves new elements uninitialised where the type allows it, and asks for huge pages where an array spans
/// some: filling half a gigabyte takes less time than the system needs to hand it out in small ones.
template <class T>
struct LargeAllocator {
  using value_type = T;
  LargeAllocator() = default;
  template <class U>
  LargeAllocator(const LargeAllocator<U>&) {}

  [[nodiscard]] T* allocate(std::size_t count) {
    if (count * sizeof(T) < kHugePage) return std::allocator<T>().allocate(count);
    const std::size_t bytes = count * sizeof(T);
    void* const memory = ::operator new (bytes, std::align_val_t{kHugePage});
    (void)madvise(memory, bytes, MADV_HUGEPAGE);  // a wish: without it the array is as good
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t count) {
    if (count * sizeof(T) < kHugePage) return std::allocator<T>().deallocate(memory, count);
    ::operator delete (memory, std::align_val_t{kHugePage});
  }
  template <class U>
  void construct(U* place) {
    ::new (static_cast<void*>(place)) U;
  }
  template <class U, class... Arguments>
  void construct(U* place, Arguments&&... arguments) {
    std::construct_at(place, std::forward<Arguments>(arguments)...);
  }
  template <class U>
  [[nodiscard]] bool operator==(const LargeAllocator<U>&) const {
    return true;
  }

 private:
  static constexpr std::size_t kHugePage = 2u << 20;  // bytes
};

template <class T>
using LargeVector = std::vector<T, LargeAllocator<T>>;

}  // namespace importon
