// A shared library that is no module of placegraph.
extern "C" [[gnu::visibility("default")]] int something_else() { return 1; }
