"""Scene profiles and the profiling and benchmark suites that use them."""
