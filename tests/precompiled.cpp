// Source of the object library test_headers, which exists for its precompiled header: every test program uses
// that one.
