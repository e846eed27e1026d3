// A file of its own, so that the compiler does not see through the replaced functions.
//
// malloc itself, on which operator new and Eigen's own allocation stand; under the address sanitizer, whose malloc
// must stay, operator new.
#include "allocation_counter.h"

#include <cstdlib>
#include <new>

// Of each thread: others may allocate meanwhile.
static thread_local std::size_t allocations = 0;

std::size_t allocation_count() {
  return allocations;
}

#ifndef __SANITIZE_ADDRESS__

extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_realloc(void* memory, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

void* malloc(std::size_t size) noexcept {
  ++allocations;
  return __libc_malloc(size);
}
void* realloc(void* memory, std::size_t size) noexcept {
  ++allocations;
  return __libc_realloc(memory, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
  ++allocations;
  return __libc_memalign(alignment, size);
}
}

#else

void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  ++allocations;
  return std::malloc(size);
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}

#endif
