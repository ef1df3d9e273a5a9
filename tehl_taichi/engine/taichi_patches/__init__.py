"""Changes of Taichi 1.7.4 at run time. Each file checks Taichi's internals and changes nothing if they differ.

`fast_tracing`: kernels are traced faster, without source lines in messages (`TEHL_DEBUG=1` keeps them). `rolled_loops`: loops
inside kernels stay rolled, which compiles several times faster. `prebound`: launches of kernels with fixed arguments take a few
microseconds, not 40 per array. `fast_calls`: other launches take a third less.
"""
