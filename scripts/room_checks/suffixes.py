"""The suffixes of sources."""

CODE = {".h", ".cpp", ".c", ".glsl", ".comp", ".vert", ".frag"}  # these have includes
CPP = {".h", ".cpp", ".c"}
SOURCE = CODE | {".py", ".js", ".mjs", ".css", ".html"}
# Other suffixes of C and C++, which nothing here would examine. Capitals count as small letters: .H is one of them.
OTHER_CPP = {".h", ".cpp", ".c", ".inc", ".inl", ".ipp", ".tpp", ".txx", ".hh", ".hpp", ".hxx", ".h++", ".cc", ".cp",
             ".cxx", ".c++", ".cppm", ".ixx", ".cu", ".cuh"}
