#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <vector>

#include "sim/record/spool.hpp"

namespace drycut::sim::record {

/// Reads a container that gives its elements by value, one index after the other.
template <typename Container>
class IndexIterator {
 public:
  using iterator_category = std::random_access_iterator_tag;
  using value_type = typename Container::value_type;
  using difference_type = std::ptrdiff_t;
  using pointer = const value_type*;
  using reference = value_type;

  IndexIterator() = default;
  IndexIterator(const Container* of, std::size_t at) : of_(of), at_(static_cast<std::ptrdiff_t>(at)) {}
  value_type operator*() const { return (*of_)[static_cast<std::size_t>(at_)]; }
  value_type operator[](std::ptrdiff_t by) const { return *(*this + by); }
  IndexIterator& operator+=(std::ptrdiff_t by) {
    at_ += by;
    return *this;
  }
  IndexIterator& operator-=(std::ptrdiff_t by) { return *this += -by; }
  IndexIterator& operator++() { return *this += 1; }
  IndexIterator& operator--() { return *this += -1; }
  IndexIterator operator++(int) {
    const auto old = *this;
    ++at_;
    return old;
  }
  IndexIterator operator--(int) {
    const auto old = *this;
    --at_;
    return old;
  }
  friend IndexIterator operator+(IndexIterator a, std::ptrdiff_t by) { return a += by; }
  friend IndexIterator operator+(std::ptrdiff_t by, IndexIterator a) { return a += by; }
  friend IndexIterator operator-(IndexIterator a, std::ptrdiff_t by) { return a -= by; }
  friend std::ptrdiff_t operator-(const IndexIterator& a, const IndexIterator& b) { return a.at_ - b.at_; }
  friend bool operator==(const IndexIterator& a, const IndexIterator& b) { return a.at_ == b.at_; }
  friend bool operator!=(const IndexIterator& a, const IndexIterator& b) { return a.at_ != b.at_; }
  friend bool operator<(const IndexIterator& a, const IndexIterator& b) { return a.at_ < b.at_; }
  friend bool operator>(const IndexIterator& a, const IndexIterator& b) { return a.at_ > b.at_; }
  friend bool operator<=(const IndexIterator& a, const IndexIterator& b) { return a.at_ <= b.at_; }
  friend bool operator>=(const IndexIterator& a, const IndexIterator& b) { return a.at_ >= b.at_; }

 private:
  const Container* of_ = nullptr;
  std::ptrdiff_t at_ = 0;
};

/// A column that only grows, of any length: full blocks go to a spool, one of them is held at a time. Made
/// to be read from one end to the other; not by two threads at once.
template <typename Number>
class Series {
 public:
  using value_type = Number;
  using const_iterator = IndexIterator<Series>;
  using iterator = const_iterator;
  static constexpr std::size_t block = 1U << 15U;  ///< numbers; a column shorter than this needs no file

  explicit Series(std::shared_ptr<Spool> spool = std::make_shared<Spool>()) : spool_(std::move(spool)) {}

  void push_back(Number number) {
    if (tail_.size() == block) put_away();
    tail_.push_back(number);
  }
  [[nodiscard]] std::size_t size() const { return places_.size() * block + tail_.size(); }
  [[nodiscard]] bool empty() const { return size() == 0; }
  [[nodiscard]] Number operator[](std::size_t i) const {
    const auto number = i / block;
    if (number == places_.size()) return tail_[i % block];
    if (number != held_number_ || held_.empty()) fetch(number);
    return held_[i % block];
  }
  [[nodiscard]] Number front() const { return (*this)[0]; }
  [[nodiscard]] Number back() const { return tail_.back(); }
  [[nodiscard]] const_iterator begin() const { return {this, 0}; }
  [[nodiscard]] const_iterator end() const { return {this, size()}; }
  friend bool operator==(const Series& a, const Series& b) {
    return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin());
  }
  friend bool operator==(const std::vector<Number>& a, const Series& b) {
    return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin());
  }

 private:
  void put_away() {
    places_.push_back(spool_->write(tail_.data(), block * sizeof(Number)));
    tail_.clear();
  }
  void fetch(std::size_t number) const {
    held_.resize(block);
    spool_->read(places_[number], held_.data(), block * sizeof(Number));
    held_number_ = number;
  }

  std::shared_ptr<Spool> spool_;
  std::vector<std::int64_t> places_;  ///< of the full blocks in the spool
  std::vector<Number> tail_;          ///< what comes after them
  mutable std::vector<Number> held_;  ///< the block read last
  mutable std::size_t held_number_ = 0;
};

}  // namespace drycut::sim::record
