// A measured error over the position of an axis and, where the machine corrects it, over a value such as a
// voltage: rows of a table, linear between their points.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace dotek::sim {

class ErrorTable {
public:
  // Adds the points of a CSV text; a point that is there already gets the new error. The first column is the
  // position. The others are `value,error`, or `error` alone, or one for each value, whose header begins with
  // that number ("3V"); an empty cell is no point. Lengths are of the file's own unit. The answer is what is
  // wrong, with its line; "": nothing.
  std::string addCsv(std::string_view text);
  void add(double position, double value, double error) { rows_[position][value] = error; }

  bool isEmpty() const { return rows_.empty(); }
  // Linear in the value within the row at each side, then in the position between them. Beyond the first or
  // the last point the error is that of this point.
  double at(double position, double value) const;
  // Whether points lie at both sides.
  bool covers(double position, double value) const;
  // Position, value, error.
  const std::map<double, std::map<double, double>>& rows() const { return rows_; }

private:
  std::map<double, std::map<double, double>> rows_;
};

std::optional<double> leadingNumber(std::string_view text); // 3 of "3V"; nothing: no number is there

} // namespace dotek::sim
