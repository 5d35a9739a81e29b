// What a ray costs, counted only where a program writes it (twin of accel/counters.h).
#ifdef ENCORE_OUTPUT_COUNTERS
uint counted_steps = 0u;
uint counted_box_tests = 0u;
uint counted_triangle_tests = 0u;
#define ENCORE_COUNT_STEP ++counted_steps
#define ENCORE_COUNT_BOX_TESTS(n) counted_box_tests += (n)
#define ENCORE_COUNT_TRIANGLE_TESTS(n) counted_triangle_tests += (n)
#else
#define ENCORE_COUNT_STEP
#define ENCORE_COUNT_BOX_TESTS(n)
#define ENCORE_COUNT_TRIANGLE_TESTS(n)
#endif
