"""The fields and numbers of a step, an entry each (:class:`tehl_taichi.march.step_output.Field`, `Scalar`): a new one is a new
entry here, in any file. May import `march.output` and what needs no taichi: what they compute from is given to them.
"""
