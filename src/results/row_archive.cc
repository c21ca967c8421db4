#include "results/row_archive.h"

namespace sprag
{
  void visit(Archive &archive, Row &row)
  {
    auto &[sensor_forces, values, of_second] = row;
    archive(sensor_forces, values, of_second);
  }

  void visit(Archive &archive, FaceState &face)
  {
    auto &[time, x, pressure, traction, pressure_2, traction_2] = face;
    archive(time, x, pressure, traction, pressure_2, traction_2);
  }
} // namespace sprag
