/* Only in sanitized builds: libraries stay loaded until the process ends. The Vulkan loader closes drivers and layers
   when the last instance goes; a leak found after that would have nameless frames, and tests/lsan.supp could not tell
   theirs from ours. */
int dlclose(void* library);
int dlclose(void* library) {
  (void)library;
  return 0;
}
