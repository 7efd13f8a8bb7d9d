// Loaded before medial-vk (LD_PRELOAD): a mesh whose name says so ends the process that opens it, takes memory without
// end, or never ends. The tests of workflows/ need meshes that do this at every try.
#include <dlfcn.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstring>
#include <vector>

namespace {

constexpr std::size_t kBlock = std::size_t{1} << 22;
constexpr useconds_t kMicrosecondsBetweenBlocks = 10000;

void take_memory() {
  std::vector<std::vector<char>> blocks;
  for (;;) {
    blocks.emplace_back(kBlock, 'x');
    ::usleep(kMicrosecondsBetweenBlocks);
  }
}

}  // namespace

extern "C" std::FILE* fopen(const char* path, const char* mode) {
  using Fopen = std::FILE* (*)(const char*, const char*);
  static const Fopen next = reinterpret_cast<Fopen>(::dlsym(RTLD_NEXT, "fopen"));
  if (std::strstr(path, "kills-crash") != nullptr) std::raise(SIGSEGV);
  if (std::strstr(path, "kills-memory") != nullptr) take_memory();
  if (std::strstr(path, "kills-time") != nullptr) {
    std::signal(SIGTERM, SIG_DFL);
    for (;;) ::pause();
  }
  return next(path, mode);
}
