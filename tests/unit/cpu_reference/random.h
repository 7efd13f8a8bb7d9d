// Random numbers, points and directions, the same in every run.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <random>

namespace medial_vk {

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  double operator()(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  std::size_t below(std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(engine_); }

  Eigen::Vector3d point(double size) { return {(*this)(-size, size), (*this)(-size, size), (*this)(-size, size)}; }
  Eigen::Vector3d point(const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
    return {(*this)(low.x(), high.x()), (*this)(low.y(), high.y()), (*this)(low.z(), high.z())};
  }
  Eigen::Vector3d direction() {
    return Eigen::Vector3d(normal_(engine_), normal_(engine_), normal_(engine_)).normalized();
  }

 private:
  std::mt19937_64 engine_;
  std::normal_distribution<double> normal_;
};

}  // namespace medial_vk
