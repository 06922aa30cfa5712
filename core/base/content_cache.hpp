// SPDX-License-Identifier: BSD-3-Clause
/// Values kept from one growth cycle to the next, and found again by what they were made from.
#pragma once

#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <unordered_map>
#include <utility>

namespace cdca {

/// A hash over the bits of everything that a value depends on.
class Signature {
 public:
  void add(double value) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    add_bits(bits);
  }
  void add(std::span<const double> values) {
    for (const double value : values) add(value);
  }
  void add_bits(std::uint64_t bits) {
    hash_ = (hash_ ^ bits) * 0x9e3779b97f4a7c15ULL;
    hash_ ^= hash_ >> 32;
  }
  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 1469598103934665603ULL;
};

/// A growth step is tried twice and taken back each time before it is taken: what it does not touch
/// is found again after so many cycles.
inline constexpr int cycles_of_a_step = 5;

/// What an increment touches has another signature; only that is made anew.
template <class Value>
class ContentCache {
 public:
  /// kept: so many cycles a value is kept in which nobody asks for it.
  explicit ContentCache(int kept = 1) : kept_(kept) {}

  /// Starts a new cycle: what has not been asked for lately is forgotten.
  void begin_cycle() {
    ++cycle_;
    std::erase_if(store_,
                  [this](const auto& entry) { return entry.second.asked < cycle_ - kept_; });
    made_ = reused_ = 0;
  }
  /// The value of a signature; make() returns it as a unique_ptr where it is not known. It stays
  /// where it is for as long as it is kept.
  template <class Make>
  const Value& of(std::uint64_t signature, Make&& make) {
    Entry& entry = store_[signature];
    if (!entry.value) {
      entry.value = make();
      ++made_;
    } else if (entry.asked < cycle_) {
      ++reused_;
    }
    entry.asked = cycle_;
    return *entry.value;
  }

  /// A value known from earlier cycles stays, as if it had been asked for.
  void keep(std::uint64_t signature) {
    Entry& entry = store_.at(signature);
    if (entry.asked < cycle_) ++reused_;
    entry.asked = cycle_;
  }

  /// Values made and values of earlier cycles found again since begin_cycle().
  std::int64_t made() const { return made_; }
  std::int64_t reused() const { return reused_; }

 private:
  struct Entry {
    std::unique_ptr<const Value> value;
    std::int64_t asked = 0;
  };
  std::unordered_map<std::uint64_t, Entry> store_;
  int kept_;
  std::int64_t cycle_ = 0;
  std::int64_t made_ = 0;
  std::int64_t reused_ = 0;
};

}  // namespace cdca
