"""The only room with Taichi and FFTW: start, fields, kernels on blocks of rows (`simd`), transforms, tasks of one kernel.

Other rooms write kernels and laws with `language` and `pointwise`; `taichi_patches` changes Taichi itself. This room knows
nothing of contacts; no other room imports Taichi or FFTW. May import: errors.
"""
