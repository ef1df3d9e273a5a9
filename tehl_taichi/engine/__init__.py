"""Everything that is Taichi or FFTW: start, fields, kernels on blocks of rows (`simd`), transforms, tasks of one kernel.

`language` and `pointwise` are what other rooms write kernels and laws with; `taichi_patches` changes Taichi itself.
Nothing here knows of contacts; no other room imports Taichi or FFTW.
May import: errors.
"""
