// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace sprag
{
  /// Plain data as bytes, to the last bit, for the same build of the program to read again. What can be copied byte by byte
  /// (numbers, structures of numbers) is kept whole; any other type says what there is to keep in one function, which serves
  /// writing and reading alike, see SPRAG_SERIALISE:
  ///   void serialise(Archive &archive, Thing &thing) { archive(thing.name, thing.values); }
  class Archive
  {
  public:
    /// Begins without bytes and adds what it serialises.
    Archive() = default;

    /// Gives what it serialises the values in bytes that an archive was left with. They must be such bytes, see sealed().
    explicit Archive(std::string whole)
        : kept(std::move(whole))
        , reading(true)
    {
    }

    bool reads() const
    {
      return reading;
    }

    const std::string &bytes() const
    {
      return kept;
    }

    /// Forgets what was serialised, and keeps the memory for what follows.
    void clear()
    {
      kept.clear();
    }

    /// Returns whether all bytes have been read.
    bool at_end() const
    {
      return position == kept.size();
    }

    /// Serialises one after another. Throws AnalysisError where there are not enough bytes.
    template <class... Items>
    void operator()(Items &...items)
    {
      (item(items), ...);
    }

  private:
    std::string kept;
    bool reading         = false;
    std::size_t position = 0; ///< of the next byte to be read

    void raw(void *data, std::size_t size);

    /// Serialises the number of items; a number that the bytes left cannot hold is no such number.
    std::size_t transfer_size(std::size_t items);

    template <class Item>
    void item(Item &one)
    {
      if constexpr (std::is_trivially_copyable_v<Item>)
        raw(&one, sizeof(Item));
      else
        serialise(*this, one);
    }

    void item(std::string &text)
    {
      text.resize(transfer_size(text.size()));
      raw(text.data(), text.size());
    }

    template <class Item>
    void item(std::vector<Item> &items)
    {
      items.resize(transfer_size(items.size()));
      if constexpr (std::is_trivially_copyable_v<Item>)
        raw(items.data(), items.size() * sizeof(Item));
      else
        for (auto &one : items)
          item(one);
    }

    template <class First, class Second>
    void item(std::pair<First, Second> &both)
    {
      item(both.first);
      item(both.second);
    }

    /// Copies what several pointers share.
    template <class Item>
    void item(std::shared_ptr<Item> &pointer)
    {
      bool is_set = pointer != nullptr;
      auto copy   = is_set ? *pointer : std::remove_const_t<Item>();
      item(is_set);
      item(copy);
      if (reading)
        pointer = is_set ? std::make_shared<Item>(std::move(copy)) : nullptr;
    }

    template <class Key, class Value>
    void item(std::map<Key, Value> &entries)
    {
      std::vector<std::pair<Key, Value>> all(entries.begin(), entries.end());
      item(all);
      if (reading)
        entries = { all.begin(), all.end() };
    }
  };

  /// Returns bytes with their fingerprint behind them.
  std::string sealed(const std::string &bytes);

  /// Returns the bytes that were sealed; none where they are not as they were.
  std::optional<std::string> unsealed(const std::string &bytes);
} // namespace sprag

/// Defines serialise() of a structure by the names of all its members in their order; the compiler misses one that is left out.
#define SPRAG_SERIALISE(Structure, ...)                                                                                          \
  void serialise(Archive &archive, Structure &structure)                                                                         \
  {                                                                                                                              \
    auto &[__VA_ARGS__] = structure;                                                                                             \
    archive(__VA_ARGS__);                                                                                                        \
  }
