/* Sanitized builds only: keeps libraries loaded until the process ends. The Vulkan loader closes drivers and layers with
   the last instance; a leak that is found after that has frames without names, so that tests/lsan.supp could not
   distinguish leaks of a driver from those of the project. */
int dlclose(void* library);
int dlclose(void* library) {
  (void)library;
  return 0;
}
