"""All that is Taichi or FFTW: its start, fields, launches, lanes, elementary functions, transforms.

Nothing of contacts is known here, and nobody else looks into Taichi's internals: a change of the engine is a change of this
folder. It may import `errors`.
"""
