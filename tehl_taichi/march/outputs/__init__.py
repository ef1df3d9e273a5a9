"""Fields and numbers of a step, one entry each (:class:`tehl_taichi.march.step_output.Field`, `Scalar`): a new entry in any
file here is a new output.

May import `march.step_output` and rooms without taichi; an entry receives the solved state.
"""
