"""Other methods that put balls in the place of a solid, for bench/run_spheres: fits in C++, their runs and their table."""
