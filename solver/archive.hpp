// Plain data to bytes and back, exactly: one function `keep(archive, x)`, or member `x.keep(archive)`, serves both ways. For files that the very same
// program reads again, on the same machine.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <array>
#include <cstring>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace palpate {

/// Stored as it is: numbers, and GCC's vectors of four of them.
template <class T>
constexpr bool is_plain = std::is_arithmetic_v<T> || std::is_enum_v<T> || std::is_same_v<T, double __attribute__((vector_size(32)))>;

class Archive {
 public:
  /// Writes.
  Archive() = default;
  /// Reads.
  explicit Archive(std::string bytes) : bytes_(std::move(bytes)), reading_(true) {}

  bool reading() const { return reading_; }
  const std::string& bytes() const { return bytes_; }

  /// Throws std::out_of_range when the bytes end too early.
  template <class... T>
  void operator()(T&... values) {
    (pass(values), ...);
  }

 private:
  void raw(void* data, std::size_t size) {
    if (!reading_) {
      bytes_.append(static_cast<const char*>(data), size);
      return;
    }
    if (size > bytes_.size() - at_) throw std::out_of_range("an archive ends too early");
    if (size > 0) std::memcpy(data, bytes_.data() + at_, size);
    at_ += size;
  }

  template <class T>
  void pass(T& value) {
    if constexpr (is_plain<T>) raw(&value, sizeof value);
    else if constexpr (requires { value.keep(*this); }) value.keep(*this);
    else keep(*this, value);
  }
  void pass(std::string& text) {
    resize(text);
    raw(text.data(), text.size());
  }
  template <class T>
  void pass(std::vector<T>& list) {
    resize(list);
    if constexpr (is_plain<T>) raw(list.data(), list.size() * sizeof(T));
    else for (auto& value : list) pass(value);
  }
  template <class T, std::size_t count>
  void pass(std::array<T, count>& list) {
    for (auto& value : list) pass(value);
  }
  template <int rows, int columns>
  void pass(Eigen::Matrix<double, rows, columns>& matrix) {
    long size[2] = {matrix.rows(), matrix.cols()};
    raw(size, sizeof size);
    if (reading_) matrix.resize(size[0], size[1]);
    raw(matrix.data(), matrix.size() * sizeof(double));
  }
  template <int columns>
  void pass(Eigen::Matrix<double, 1, columns, Eigen::RowMajor>& row) {
    raw(row.data(), row.size() * sizeof(double));
  }
  template <class List>
  void resize(List& list) {
    std::size_t size = list.size();
    raw(&size, sizeof size);
    if (!reading_) return;
    if (size > bytes_.size() - at_) throw std::out_of_range("an archive ends too early");
    list.resize(size);
  }

  std::string bytes_;
  std::size_t at_ = 0;
  bool reading_ = false;
};

}  // namespace palpate
