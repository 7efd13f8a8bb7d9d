/* The host's own volk. Not called volk.c, since this folder is searched first. */
#include <volk.c>
