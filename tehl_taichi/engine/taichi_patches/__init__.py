"""Changes of Taichi 1.7.4 at run time. Each file checks that it finds what it knows and otherwise changes nothing.

`fast_tracing`: kernels are traced faster, without source lines in messages (`TEHL_DEBUG=1` keeps them).
`rolled_loops`: loops inside kernels stay rolled, which compiles several times faster.
`prebound`: launches of kernels with fixed arguments, a few microseconds in place of 40 per array.
"""
