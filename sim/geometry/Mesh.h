// A closed mesh of triangles: exact signed distance, and reading of STL. Private to the part.
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace dotek::sim {

class Mesh {
public:
  static constexpr std::size_t kMostTriangles = 500'000;

  // What is wrong with the file; empty: the mesh is read. Coordinates are multiplied by `scale`. Memory is in
  // proportion to `bytes`.
  std::string readStl(std::string_view bytes, double scale);
  // For tests and programs: triangles counterclockwise as seen from outside.
  std::string set(std::vector<Eigen::Vector3d> vertices, std::vector<std::array<std::uint32_t, 3>> triangles);
  // Turns, then shifts.
  void place(const Eigen::Matrix3d& turn, const Eigen::Vector3d& shift);

  // Negative inside. `point` is the nearest one, `normal` points away from the material; either may be null.
  double distance(const Eigen::Vector3d& p, Eigen::Vector3d* point = nullptr,
                  Eigen::Vector3d* normal = nullptr) const;
  // From the segment to the surface, not negative: inside is as far as outside.
  double segmentDistance(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const;
  std::size_t triangleCount() const { return triangles_.size(); }

private:
  struct Box {
    Eigen::Vector3d least, most;
    double squaredDistance(const Eigen::Vector3d& p) const { return squaredDistance(p, p); }
    // From a box.
    double squaredDistance(const Eigen::Vector3d& low, const Eigen::Vector3d& high) const;
  };
  struct Branch {
    Box box;
    std::uint32_t begin = 0, end = 0; // triangles of a leaf
    std::uint32_t right = 0;          // the left one follows; 0: a leaf
  };

  std::string readBinary(std::string_view bytes, double scale);
  std::string readText(std::string_view bytes, double scale);
  std::string addCorners(std::vector<Eigen::Vector3d>& corners);
  std::string finish();
  std::string checkClosed();
  void makeNormals();
  void makeTree();
  void split(std::uint32_t begin, std::uint32_t end, std::vector<Eigen::Vector3d>& centres,
             std::vector<std::uint32_t>& order);

  std::vector<Eigen::Vector3d> vertices_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
  // By triangle: of the face, of the three edges (0 1, 1 2, 2 0); by vertex. Weighted by angles, so that
  // their side tells inside from outside wherever they are nearest.
  std::vector<std::array<Eigen::Vector3d, 4>> normals_;
  std::vector<Eigen::Vector3d> vertexNormals_;
  std::vector<Branch> tree_;
};

} // namespace dotek::sim
