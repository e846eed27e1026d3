// A list that keeps its elements, and what they own, when it gets shorter: filling it again takes no memory.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace scene {

template <class T>
class Reused {
 public:
  // New elements are as they were left, or made by default.
  void resize(std::size_t count) {
    if (count > all_.size()) all_.resize(count);
    count_ = count;
  }
  // Makes elements beforehand: prepare(element) takes the memory that they own.
  template <class Prepare>
  void reserve(std::size_t count, Prepare&& prepare) {
    if (count > all_.size()) all_.resize(count);
    for (T& element : all_) prepare(element);
  }
  void assign(std::span<const T> values) {
    resize(values.size());
    for (std::size_t i = 0; i < count_; ++i) all_[i] = values[i];
  }

  std::size_t size() const { return count_; }
  bool empty() const { return count_ == 0; }
  T& operator[](std::size_t i) { return all_[i]; }
  const T& operator[](std::size_t i) const { return all_[i]; }
  T* begin() { return all_.data(); }
  T* end() { return all_.data() + count_; }
  const T* begin() const { return all_.data(); }
  const T* end() const { return all_.data() + count_; }
  T& back() { return all_[count_ - 1]; }
  const T& back() const { return all_[count_ - 1]; }
  operator std::span<const T>() const { return {all_.data(), count_}; }  // NOLINT: it is one

 private:
  std::vector<T> all_;
  std::size_t count_ = 0;
};

}  // namespace scene
