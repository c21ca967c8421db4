// SPDX-License-Identifier: GPL-3.0-only
#pragma once

#include <cstdint>
#include <string>

namespace sprag
{
  /// Hash over numbers and texts (64 bits, after FNV-1a): for keys and checksums, not against an adversary.
  class Fingerprint
  {
  public:
    void add(double value);
    void add(const std::string &text);
    void add(const void *bytes, std::size_t count);
    std::uint64_t value() const
    {
      return hash;
    }

    std::string text() const; ///< 16 hexadecimal digits

  private:
    std::uint64_t hash = 14695981039346656037u;
  };

  /// Returns the fingerprint of texts one after another, as text.
  template <class... Texts>
  std::string fingerprint(const Texts &...texts)
  {
    Fingerprint key;
    (key.add(texts), ...);
    return key.text();
  }

  /// Returns the fingerprint of a file's content, independent of its name and time. What a script of gmsh (.geo) includes or
  /// merges by a quoted name, relative to its folder, belongs to its content. A file that cannot be read has the fingerprint
  /// "unreadable".
  std::string content_fingerprint(const std::string &file);

  /// Returns the fingerprint of the running program, another one for each build that differs in an instruction: for keys of what
  /// only the same build may take over.
  const std::string &program_fingerprint();
} // namespace sprag
