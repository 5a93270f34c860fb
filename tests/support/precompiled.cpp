// Of the target test_headers, which lends its precompiled headers to the tests.
int main() { return 0; }
