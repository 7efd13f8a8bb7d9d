#include "ball_files.h"

#include <cstdio>
#include <cstdlib>
#include <fstream>

namespace medial_vk::bench {

std::vector<Ball> read_balls(const std::string& file) {
  std::ifstream in(file);
  std::string line;
  std::vector<Ball> balls;
  bool good = std::getline(in, line) && line.starts_with("x,y,z,radius");
  while (good && std::getline(in, line)) {
    Ball ball;
    good = std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf", &ball.centre[0], &ball.centre[1], &ball.centre[2],
                       &ball.radius) == 4;
    balls.push_back(ball);
  }
  if (!good || balls.empty()) {
    std::fprintf(stderr, "%s: no balls as medial-vk writes them (-o FILE.csv)\n", file.c_str());
    std::exit(2);
  }
  return balls;
}

}  // namespace medial_vk::bench
