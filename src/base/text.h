#pragma once

#include <deal.II/base/utilities.h>

#include <optional>
#include <string>
#include <vector>

namespace sprag
{
  using dealii::Utilities::trim; // takes off white space at both ends

  /// The shortest decimal form that reads back as the same number.
  std::string number_text(double value);

  /// At most six significant digits, for a reader's eye.
  std::string rounded_text(double value);

  /// "12.5 mm", rounded.
  std::string mm(double length);

  /// A number at the beginning of a text and what stands behind it.
  struct LeadingNumber
  {
    double value;
    std::string rest; ///< without white space at its ends; empty where the text is a number alone
  };

  /// None where the text does not begin with a finite decimal number.
  std::optional<LeadingNumber> leading_number(const std::string &text);

  /// The number that a text begins with where it has a comma for its decimal point, with a point; none otherwise.
  std::optional<std::string> with_decimal_point(const std::string &text);

  /// The candidate with the smallest edit distance (Levenshtein, capitals ignored); none where even that would change more than
  /// half of the name.
  std::optional<std::string> nearest(const std::string &name, const std::vector<std::string> &candidates);

  /// "; did you mean 'X'?" with the nearest candidate, or nothing.
  std::string did_you_mean(const std::optional<std::string> &candidate);
} // namespace sprag
