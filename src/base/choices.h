// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include "base/ranges.h"
#include "base/text.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sprag
{
  /// The words for values of an enumeration, as files and reports have them. No word and no value occurs twice.
  template <class T>
  using Choices = std::vector<std::pair<std::string, T>>;

  /// Returns all words.
  template <class T>
  std::vector<std::string> words_in(const Choices<T> &choices)
  {
    return mapped(choices, &std::pair<std::string, T>::first);
  }

  /// Returns the word for a value; throws std::out_of_range where it has none.
  template <class T>
  std::string word_for(const Choices<T> &choices, const T &value)
  {
    const auto *const found = find_by(choices, &std::pair<std::string, T>::second, value);
    if (found == nullptr)
      throw std::out_of_range("a value without a word");
    return found->first;
  }

  /// Returns the value that a word stands for; throws std::out_of_range for another word.
  template <class T>
  const T &value_for(const Choices<T> &choices, const std::string &word)
  {
    const auto *const found = find_by(choices, &std::pair<std::string, T>::first, word);
    if (found == nullptr)
      throw std::out_of_range("'" + word + "' is none of the choices");
    return found->second;
  }

  /// Returns the names of an enumeration of SPRAG_ENUMERATION with their values.
  template <class T>
  Choices<T> enumerators()
  {
    Choices<T> result;
    for (const auto &name : split(enumerator_list(T()), ','))
      result.emplace_back(name, static_cast<T>(result.size()));
    return result;
  }

  /// Returns the values of an enumeration by its names as words, with blanks for underscores.
  template <class T>
  Choices<T> enumerator_words()
  {
    Choices<T> words = enumerators<T>();
    for (auto &[word, value] : words)
      std::replace(word.begin(), word.end(), '_', ' ');
    return words;
  }

  /// Returns the name of a value as words.
  template <class T>
  std::string enumerator_name(const T value)
  {
    return word_for(enumerator_words<T>(), value);
  }
} // namespace sprag

/// Defines an enumeration, and enumerator_list(Enumeration()), which returns its names with commas between. Files that do not ask
/// for enumerators() compile no more than that.
#define SPRAG_ENUMERATION(Enumeration, ...)                                                                                      \
  enum class Enumeration : std::size_t                                                                                           \
  {                                                                                                                              \
    __VA_ARGS__                                                                                                                  \
  };                                                                                                                             \
  constexpr const char *enumerator_list(Enumeration)                                                                             \
  {                                                                                                                              \
    return #__VA_ARGS__;                                                                                                         \
  }
