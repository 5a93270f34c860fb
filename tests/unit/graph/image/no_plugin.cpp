// A shared library that is no module of placegraph.
extern "C" int something_else() { return 1; }
