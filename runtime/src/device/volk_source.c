// The one place that compiles volk, which finds Vulkan's functions at run time (Debian ships its source alone). The
// file must not be called volk.c: this folder is searched before the system's.
#include <volk.c>
